// The window that leads a participant through a study: pages, intervals, questions, breaks.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "app/panels/picture_hook.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/settings.hpp"
#include "app/study/study_pages.hpp"
#include "app/study/study_surface.hpp"
#include "app/touching/pointer.hpp"
#include "app/window/gui.hpp"
#include "app/window/shutdown_watchdog.hpp"
#include "app/window/window.hpp"
#include "core/realtime/heartbeat.hpp"
#include "core/study/study_file.hpp"
#include "core/study/study_run.hpp"
#include "device/hand_device.hpp"
#include "render/camera.hpp"
#include "render/gl_objects.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

struct StudyWindowOptions {
    std::optional<std::pair<int, int>> size{};  ///< nothing: the whole screen
    Settings settings{};                        ///< used: device, force limit, loudness, appearance
    std::vector<UnsafeSetting>
        unsafe_settings{};  ///< of the study: consent is asked before it begins
    PictureHook after_picture{};
};

/// Shows no number and no name of a condition, file or parameter. Force only
/// in intervals. Each answer is in the file, with its trial's session, before the next page shows.
class StudyWindow {
  public:
    /// Opens the window. `run` and `file` belong to the same study. All references must outlive the
    /// object. Throws Error.
    StudyWindow(const StudyWindowOptions& options, StudyRun& run, StudyFile& file, HandDevice hand,
                ShutdownWatchdog& shutdown);
    ~StudyWindow();
    StudyWindow(const StudyWindow&) = delete;
    StudyWindow& operator=(const StudyWindow&) = delete;

    /// Runs until the study is finished or left; an unanswered trial is then dropped. Throws
    /// InputError when a file cannot be opened or written.
    void lead();

  private:
    using Clock = std::chrono::steady_clock;

    void show_one_picture();
    void enter_step();
    void leave_step();
    void enter_interval();
    void enter_page();
    void note_on_screen();
    void apply_time_limit(Clock::time_point now);
    void begin_interval_if_ready();
    void take(const WindowInput& input);
    void take_buttons();
    void take_button(StudyButton button, Clock::time_point at);
    void take_keys(const WindowInput& input);
    void take_click(const StudyPress& press);
    void agree_to_study();
    void act(const StudyPress& press, Clock::time_point at);
    void act_at_question(const StudyPress& press, Clock::time_point at);
    void act_at_adjustment(const StudyPress& press, Clock::time_point at);
    void answer(const StudyAnswer& answer, Clock::time_point at);
    void draw(const WindowInput& input);
    void draw_relief();
    void point(const Camera::Ray& ray, PointerUse use);
    void show_hand_only(TouchMarkers& markers) const;
    void load_picture(const StudyPage& page);
    void beat();
    void report_picture() const;
    void leave_without_display();
    [[nodiscard]] DepthSurface seen_surface() const;
    [[nodiscard]] bool touching() const noexcept;
    [[nodiscard]] bool over() const;
    [[nodiscard]] bool is_early(Clock::time_point press) const noexcept;

    const PictureHook after_picture_;
    const std::vector<UnsafeSetting> unsafe_settings_;
    StudyRun& run_;
    StudyFile& file_;
    ShutdownWatchdog& shutdown_;
    Heartbeat heart_{};  // of the window's thread and the display
    Window window_;
    Gui gui_;
    SceneView scene_{};
    bool software_;
    PicturePace pace_;
    Camera camera_{};
    ReliefMouse mouse_{};
    HandPointer pointer_{};   // over the drawn surface
    MouseTarget mouse_at_{};  // where pointer_ points
    ColourTexture page_picture_{};
    StudyShown view_{};
    StudySurface surface_;
    std::optional<Clock::time_point> entered_{};  // begin of the current step
    /// Since when the current question is on the screen; earlier presses do not answer it.
    std::optional<Clock::time_point> seen_since_{};
    Clock::time_point clicked_at_{};   // last press of the mouse's button
    int early_{0};                     // presses before their question was on the screen
    bool in_trial_{false};             // the trial's session has begun,
    std::filesystem::path session_{};  // in this file
    bool left_{false};
    std::optional<glm::dvec2> pointer_before_px_{};  // on the page's first picture; nothing: moved
    bool hand_seen_{false};                          // false: the mouse is beside the relief
    double turned_{0.0};                             // current value of an adjustment
    std::optional<Clock::time_point> since_{};       // begin of the time limit
    Clock::time_point paused_at_{};  // when the question about leaving stopped that time
    std::optional<Clock::time_point> first_felt_at_{};  // begin of an adjustment's first interval
    LongPress long_press_{};
};

}  // namespace dibhr
