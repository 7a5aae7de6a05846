// The viewer: one window, one player, one hand, one haptic loop.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/panels/picture_hook.hpp"
#include "app/panels/viewer_state.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/file_memory.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/pointer.hpp"
#include "app/touching/touch_session.hpp"
#include "app/viewer/asking.hpp"
#include "app/viewer/browsing/browsing.hpp"
#include "app/viewer/clip.hpp"
#include "app/viewer/desktop_dialog.hpp"
#include "app/viewer/estimating.hpp"
#include "app/viewer/explaining.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/guide/guide.hpp"
#include "app/viewer/guide/lead.hpp"
#include "app/viewer/guide/speaking.hpp"
#include "app/viewer/input.hpp"
#include "app/viewer/key_hand.hpp"
#include "app/viewer/message_log.hpp"
#include "app/viewer/opening_window.hpp"
#include "app/viewer/painting/painting.hpp"
#include "app/viewer/panes.hpp"
#include "app/viewer/picture_change.hpp"
#include "app/viewer/preparing.hpp"
#include "app/viewer/replay.hpp"
#include "app/viewer/reporting.hpp"
#include "app/viewer/service_settings.hpp"
#include "app/viewer/task_group.hpp"
#include "app/viewer/trace.hpp"
#include "app/window/gui.hpp"
#include "app/window/shutdown_watchdog.hpp"
#include "app/window/window.hpp"
#include "core/error.hpp"
#include "core/realtime/heartbeat.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/hand_device.hpp"
#include "render/camera.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Of a window for visitors.
struct KioskOptions {
    static constexpr double kForceShare = 0.4;  ///< of the force limit that is sent
    static constexpr float kTextTimes = 1.6F;   ///< larger than usual: read while standing

    std::vector<std::filesystem::path> next{};  ///< recordings after the first one
    double return_s{60.0};                      ///< without touch: back to the start
};

/// The options of `dibhr view`.
struct ViewOptions {
    OpenRequest open{};                ///< its colour may be a session; empty: the built-in sample
    std::string device{"auto"};        ///< as make_hand_device() has it
    std::filesystem::path firmware{};  ///< for a Falcon that has none; empty: the kept one
    std::filesystem::path record{};
    std::filesystem::path screenshot{};        ///< the last picture, as PNG
    std::filesystem::path clip{};              ///< of all pictures, as MP4
    PictureOf pictures_of{PictureOf::window};  ///< of screenshot and clip; --no-panels: the relief
    std::optional<double> seconds{};           ///< end the program after so long
    bool sync{true};                           ///< --no-sync: do not wait for the display
    std::optional<double> speed{};             ///< kSlowestSpeed .. kFastestSpeed
    std::optional<bool> looping{};             ///< default: a video loops, a session stops
    std::optional<double> end_s{};             ///< end of playing, from the media's begin
    bool start_given{false};                   ///< by --start: the saved position is not used
    bool full_screen{false};
    std::optional<KioskOptions> kiosk{};
    bool stays{false};       ///< also where the named files cannot be opened
    bool size_given{false};  ///< by --size: the window has exactly this size
    bool any_media{false};   ///< replay: also over files that have changed
    SurfacesFrom surfaces{SurfacesFrom::automatic};            ///< of a replay
    SurfaceRecording record_surface{SurfaceRecording::tiles};  ///< of recordings
    bool record_preview{true};                                 ///< in them
    bool must_be_sure{false};                                  ///< --sure
    TouchRequest touch{};  ///< the command line's; it overrides a session's
    std::filesystem::path settings_file{settings_path()};  ///< where settings are saved
    Settings in_file{};  ///< as read; the window saves only changes of it
    std::vector<UnsafeSetting>
        unsafe_settings{};  ///< of it: defaults are used until the user agrees
    Settings settings{};    ///< in_file with the command line's values
    PictureHook after_picture{};

    /// Whether nobody may be there who knows the files: the program ends by itself, or fills the
    /// screen for visitors.
    [[nodiscard]] bool asks_nobody() const {
        return full_screen || seconds.has_value() || (!clip.empty() && !looping.value_or(true));
    }
    /// Whether a person may be shown at the first start what the mouse does: nothing else is asked
    /// for, and no force device is named.
    [[nodiscard]] bool may_lead() const {
        return !asks_nobody() && !kiosk && screenshot.empty() && clip.empty() && record.empty() &&
               (device == "auto" || device == "mouse");
    }
};

/// The files of the command line.
struct OpenedFiles {
    std::unique_ptr<Media> media{};
    FileMemory memory{};                       ///< of the media
    FoundMaps maps{};                          ///< likewise
    FoundGuide guide{};                        ///< likewise
    std::unique_ptr<OpenedSession> session{};  ///< to be replayed, in place of media
    std::string trouble{};                     ///< why there is neither media nor session
    bool lacks_depth{false};                   ///< the trouble is that the file has colour only
    std::string doubt{};                       ///< on what the depth means; printed already
    std::vector<std::string> warnings{};
};

/// What a viewer begins with.
struct ViewerParts {
    OpenedFiles files{};
    std::string damage{};  ///< message about a damaged settings file
    HandDevice hand{};
    Material material{};  ///< of the settings or the command line
    std::shared_ptr<const BumpMap> bump{};
    std::filesystem::path bump_file{};
};

/// The relief settings of the open file.
struct OwnRelief {
    bool fits{true};
    double relief_px{0.0};

    bool operator==(const OwnRelief&) const = default;
};

/// What turning near and far has stated, and the request before.
struct TurnedDepth {
    DepthStatement panel{};
    DepthRequest before{};
};

class Viewer {
  public:
    /// Shows the window and starts the loop. All references must outlive the viewer. Throws Error.
    Viewer(const ViewOptions& options, OpeningWindow& opening, ViewerParts parts,
           ShutdownWatchdog& shutdown, TaskGroup& tasks, MessageLog& log);
    /// Removes the handler for a lost display.
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Runs until the window is closed or options.seconds are over. Throws InputError when the last
    /// picture or the settings cannot be written.
    void run();

  private:
    static constexpr double kNoticeTime_s = 4.0;

    /// What a turn of the loop has done.
    struct Turn {
        bool input{false};  ///< something happened in the window
        bool drawn{false};
    };

    Turn take_turn();
    void wait_for_turn(Turn last);
    void apply_style();
    void poll();
    void poll_touch();
    void show_recording_trouble();
    void take_opened();
    [[nodiscard]] std::optional<OpeningShown> opening_shown() const;
    void follow_live();
    [[nodiscard]] bool keys_are_text() const;
    [[nodiscard]] bool keys_are_taken() const;
    [[nodiscard]] bool quits(const TypedCharacter& typed) const;
    [[nodiscard]] bool text_opens() const;
    [[nodiscard]] HandKeys hand_keys() const;
    /// What has the keyboard before the keys of a turn are taken.
    struct KeyboardUse {
        bool typing{false}, in_list{false};
        bool asked{false};  ///< by the question on the depth alone, whose answers are digits
    };
    void take_keys(const WindowInput& input);
    void take_key(const KeyPress& press, KeyboardUse before);
    void take_character(const TypedCharacter& typed, KeyboardUse before);
    void perform_key(Action action, EventTimes::Time at, KeyboardUse before);
    void take_kiosk_keys(const WindowInput& input);
    void follow_kiosk(const WindowInput& input);
    void show_in_kiosk(std::size_t number);
    void show_next_in_kiosk();
    void pass_over_in_kiosk();
    void perform_in_kiosk(KioskCommand command);
    [[nodiscard]] bool take_dialog_key(const KeyPress& press);
    void close_topmost(bool in_list);
    [[nodiscard]] std::optional<Answer> perform_with_files(Action action);
    [[nodiscard]] std::optional<Answer> perform_with_view(Action action);
    [[nodiscard]] std::optional<Answer> perform_with_keyboard(Action action);
    [[nodiscard]] std::optional<Answer> perform_with_brush(Action action);
    void paint(const PointerUse& use);
    void perform(Action action);
    void take_dropped(const std::vector<std::filesystem::path>& files);
    [[nodiscard]] Answer open_by_dialog();
    void take_desktop_answer();
    void move_hand(const WindowInput& input);
    void follow_pointer();
    void use_clicks(std::span<const PointerClick> clicks, double wheel_steps);
    void use_pointer(const Pointer& now, double wheel_steps, EventTimes::Time at);
    [[nodiscard]] SceneContent prepare_scene();
    [[nodiscard]] SceneMark mark_scene(SceneContent content, glm::ivec2 viewport) const;
    [[nodiscard]] bool waits_for_surface(std::chrono::steady_clock::time_point now) const;
    [[nodiscard]] bool draw_if_changed(const WindowInput& input);
    void lay_out_panels(const WindowInput& input, const std::function<void()>& drawn);
    void hold_unseen_video();
    void draw_explained();
    void carry_out_commands();
    void perform_after_picture(Action action);
    void publish();
    void keep_settings();
    void answer_unsafe_settings(bool agreed);
    void show_media(std::unique_ptr<Media> media, const OpenRequest& request,
                    const FileMemory& memory, FoundMaps maps, const FoundGuide& guide);
    void keep_memory();
    void apply_memory(const FileMemory& memory, const OpenRequest& request);
    void forget_relief();
    void replay_session(std::unique_ptr<OpenedSession> session, const FoundGuide& guide);
    void keep_recent(const RecentFile& opened);
    void show_title(const std::filesystem::path& file);
    /// The user's choices, without values that media or a replay have set.
    [[nodiscard]] Settings settings_to_save() const;
    void fit_to_media();
    void keep_panel(const std::filesystem::path& depth_before);
    void open_again(const DepthStatement& panel);
    void open_again(DepthRequest request);
    void ask_depth(const OpenRequest& request);
    void answer_depth(const AnswerDepth& answer);
    [[nodiscard]] Answer turn_depth();
    std::string save_sidecar();
    void frame_relief();
    void forget_ruler();
    void load_bump(const std::filesystem::path& file);
    void leave_trace(TouchMarkers& markers);
    void use_material(const std::string& name);
    void keep_material(const std::string& name);
    void start_or_stop_recording();
    void begin_next_recording();
    void start_or_stop_clip(PictureOf of);
    [[nodiscard]] bool wants_picture(PictureOf of) const;
    [[nodiscard]] bool video_runs() const;
    [[nodiscard]] double most_pictures_per_s() const;
    [[nodiscard]] bool pictures_pass() const;
    void deliver_picture(PictureOf of, ColourImage picture);
    void beat();
    void finish();
    void close_without_display();
    template <typename Try>
    void save_all(const std::atomic<bool>& at_once, const Try& try_to);
    void write_last_picture();
    void take_last_screenshot();
    /// Shows a notice instead while the last files are still being opened.
    void open(const OpenRequest& request);
    void make_report(const std::filesystem::path& session);
    void take_report();
    void take_prepared();
    void show_notice(const std::string& notice, double time_s = kNoticeTime_s);
    void keep_notice(const std::string& notice);
    void end_notice(const std::string& begin);
    void log_messages();
    void speak();
    void log_lateness(const TickSchedule& schedule);
    /// Calls `step`; shows its error in the message box.
    template <typename Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (const Error& error) {
            state_.ui.message = error.what();
        }
    }
    /// The player of the replay, else of the media.
    [[nodiscard]] Transport& transport();
    [[nodiscard]] double now_s() const;
    [[nodiscard]] bool over();
    [[nodiscard]] bool played_to_the_end() const;
    [[nodiscard]] glm::ivec2 relief_viewport() const;
    /// The place of the drawn surface that the ray meets first; nothing: none.
    [[nodiscard]] std::optional<Vec3> relief_under(const Camera::Ray& ray) const;

    // touch_ is last: it is destroyed first, so that no force is sent while the rest is destroyed.
    ViewOptions options_;
    ShutdownWatchdog& shutdown_;
    MessageLog& log_;
    Heartbeat heart_{};  // of the window's thread and the display
    Window& window_;
    Gui& gui_;
    SceneView scene_{};
    bool software_;  // the processor draws
    PicturePace pace_;
    Camera camera_{};
    ReliefMouse mouse_{};
    KeyHand key_hand_{};
    std::optional<Vec3> pointed_at_{};  // on the drawn surface
    ViewerState state_{};
    ServiceSettings service_settings_;
    BackgroundTask<OpenResult> opening_;
    std::string opening_name_{};  // of the file that is opened, or was last
    std::chrono::steady_clock::time_point opening_since_;
    Screenshots screenshots_{};
    ViewerClip clip_;
    ViewerEstimating estimating_;
    ViewerPreparing preparing_;
    ViewerAsking asking_;
    std::optional<TurnedDepth> turned_{};  // by the last press of the key
    Reporting reporting_{};
    ViewerExplaining explaining_{};
    Browsing browsing_;
    DesktopDialog desktop_;
    ViewerPanes panes_{};
    ViewerPainting painting_;
    ViewerGuide guide_;
    ViewerLead lead_{};
    ViewerSpeaking speaking_{};
    TaskQueue save_queue_;  // writes settings, file memories, recent files
    SettingsSaver settings_saver_;
    DepthBlend shown_{};  // the frames of this turn
    PictureChange change_{};
    bool video_held_{false};       // by hold_unseen_video()
    bool record_next_{false};      // a recording begins once the last one is finished
    std::size_t kiosk_at_{0};      // the recording that was asked for last; 0: the first one
    std::size_t kiosk_passed_{0};  // recordings one after the other that could not be opened
    double kiosk_used_s_{0.0};     // when a person last did something
    bool kiosk_left_{false};       // by its key chord
    float hint_alpha_{1.0F};
    float wheel_hint_alpha_{1.0F};
    bool pressed_deeper_{false};  // the wheel was used so at least once
    TouchTrace trace_{};
    std::filesystem::path remembered_{};        // the shown file; empty: save nothing about it
    OwnRelief relief_shown_{};                  // when the file was opened
    std::optional<OwnRelief> relief_before_{};  // settings before, where the file has its own
    std::string playback_failure_{};            // last shown
    std::chrono::steady_clock::time_point start_{};
    ViewerReplay replay_{};
    TouchSession touch_;  // stopped in a replay: no device is read, no force is sent
};

}  // namespace dibhr
