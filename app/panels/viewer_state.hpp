// The state of the window: plain data that every panel shows and edits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/commands.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/folder.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/material.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "app/window/gui.hpp"
#include "core/estimate/estimate_watch.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/haptics/explanation.hpp"
#include "core/video/guide/regions.hpp"

namespace dibhr {

/// The request to open a row of the Open dialog; for depth alone, its colour is searched.
[[nodiscard]] inline OpenRequest request_for(const FolderEntry& entry) {
    OpenRequest request{entry.file, entry.depth};
    request.in_any_order = entry.depth.empty();
    return request;
}

/// Text fields of the panels.
struct TextFields {
    TextField colour{};
    TextField depth{};
    TextField bump{};
    TextField material{};  ///< the name to save one as
    TextField firmware{};
    TextField depth_scale{};                  ///< "0.001"
    TextField depth_range{};                  ///< "480:4210"
    TextField no_data{};                      ///< "0,65535"
    TextField intrinsics{};                   ///< "525,525,319.5,239.5" or "60deg"
    TextField depth_offset{};                 ///< "-0.05" [s]
    TextField depth_rate{};                   ///< "29.97" [1/s]
    std::array<double, 2> colour_shift_px{};  ///< right and down, in depth pixels
    std::array<double, 1> colour_size{1.0};   ///< a factor
};

/// The preview of a recording that is not open.
struct Preview {
    std::filesystem::path file{};
    std::uintptr_t colour{0};  ///< names of OpenGL textures; 0: none
    std::uintptr_t depth{0};
    int columns{0}, rows{0};  ///< of the colour
    int depth_columns{0}, depth_rows{0};
    std::string text{};  ///< lines: its length, its size; empty: it is still being read
};

/// The completion of a typed text by Tab.
struct Completion {
    std::string typed{}, whole{};
};

/// A file that is being opened, for longer than a person takes for at once.
struct OpeningShown {
    std::string name{};
    std::string step{};  ///< what is done now
};

/// The window's own dialog for opening files.
struct OpenDialog {
    static constexpr int kPicturesToFocus = 30;  ///< at most; usually it takes two

    /// The listed entries of the folder, and the inputs they were selected by.
    struct Rows {
        std::vector<std::size_t> entries{};
        std::string typed{};
        bool all_files{false};
        int reading_number{-1};
    };

    bool shown{false};
    bool in_front{false};  ///< the dialog has the keyboard, not a panel
    Folder folder{};       ///< its entries are still being read while `is_reading`
    bool is_reading{false};
    int reading_number{0};  ///< a new number with every change of `folder`
    Rows rows{};
    std::filesystem::path chosen{};  ///< an entry of the folder; empty: none
    TextField typed{};               ///< narrows the entries, or is a path
    std::string refused{};           ///< what was typed and entered, and is no file
    Completion completion{};         ///< of the typed text, once it is known
    bool all_files{false};           ///< also list files that cannot be opened
    Preview preview{};
    std::filesystem::path sample_folder{};
    int line{0};               ///< ID of the text line; a new ID makes a new, empty line
    int pictures_to_focus{0};  ///< pictures left in which the line requests the keyboard
    int move{0};               ///< move the choice by so many entries
    bool enter{false};         ///< open the choice
    bool scroll_pending{false};
};

/// Whether it was requested and does not have the keyboard yet.
[[nodiscard]] inline bool is_opening(const OpenDialog& dialog) {
    return dialog.shown && dialog.pictures_to_focus > 0;
}

/// Whether Enter and the arrow keys go to the dialog, also before it has the keyboard.
[[nodiscard]] inline bool takes_keys(const OpenDialog& dialog) {
    return (dialog.shown && dialog.in_front) || is_opening(dialog);
}

/// What a picture or clip of the window contains.
enum class PictureOf { window, relief };

/// The state of a clip that is being made of the window.
struct ClipInfo {
    std::filesystem::path file{};
    double time_s{0.0};     ///< since its first picture
    bool finishing{false};  ///< ended; its file is not complete yet
};

/// The recording that is being prepared.
struct PreparingShown {
    double share{0.0};   ///< that is done
    std::string file{};  ///< its name, where it is not the shown one; else empty
};

/// The report of a session.
struct ReportShown {
    std::filesystem::path session{};
    bool being_made{false};
    std::filesystem::path page{};  ///< empty: not made yet
};

/// The panes: pictures above the relief.
struct PanesShown {
    std::uintptr_t colour{0};  ///< names of OpenGL textures; 0: none
    std::uintptr_t depth{0};
};

/// The offer of depth for a video of colour alone: before, during and after its making.
struct DepthOffer {
    std::filesystem::path colour{};
    std::string text{};  ///< why the video cannot be opened, or an error; empty: neither
    std::vector<std::string> estimators{};  ///< names to choose from; none: it cannot be made
    int chosen{0};                          ///< index in `estimators`
    std::string
        unconfirmed_command{};  ///< the command, escaped, that a person must agree to; empty: none
    std::optional<EstimateProgress> progress{};  ///< nothing: it is not being made
    bool ending{false};                          ///< cancelled, but not yet ended
    std::filesystem::path depth{};  ///< finished while something else was open; empty: not yet
};

/// The question which meaning of the open depth is right.
struct DepthQuestion {
    std::vector<DepthAlternative> alternatives{};  ///< two to four; the first one is in use
    std::vector<std::uintptr_t> reliefs{};         ///< names of their textures, once they are drawn
    std::string doubt{};     ///< why it may be no depth; empty: nothing says so
    std::string folder{};    ///< the name of the file's folder; empty: no answer for all its files
    bool for_folder{false};  ///< the answer holds for the other files of the folder, too
    bool answered{false};    ///< the files are being opened by the answer
};

/// A pixel of the drawn depth, and its values.
struct PixelShown {
    int column{0}, row{0};
    double nearness{0.0};      ///< 0: the farthest, 1: the nearest
    double elevation_px{0.0};  ///< of the surface, with its roughness
    bool unseen{false};        ///< no surface was ever seen there
};

/// Two points on the relief, whose distance is shown.
struct Ruler {
    std::vector<Vec3> places{};      ///< up to two; grid space, elevation unused
    bool pressed{false};             ///< the mouse button, in the last picture
    std::vector<PixelShown> ends{};  ///< the current pixels at `places`

    /// A click sets a point; a third click starts again. `under` empty: outside the relief.
    void press(bool down, const std::optional<Vec3>& under);
};

/// What a brush paints on the relief, in the order of the panel.
enum class BrushLayer { material, stiffness, friction, height, region, nothing };
inline constexpr std::array<NamedValue<BrushLayer>, 6> kBrushLayerNames{
    {{BrushLayer::material, "material", "Material"},
     {BrushLayer::stiffness, "stiffness", "Stiffness"},
     {BrushLayer::friction, "friction", "Friction"},
     {BrushLayer::height, "height", "Height"},
     {BrushLayer::region, "region", "Region: a name"},
     {BrushLayer::nothing, "nothing", "Nothing: erase"}}};
static_assert(has_all_in_order(kBrushLayerNames, BrushLayer::nothing));

struct Brush {
    bool on{false};
    BrushLayer layer{BrushLayer::material};
    std::string material{"bark"};
    double stiffness_newton_per_mm{1.0};
    double friction{0.8};
    double height_px{8.0};
    TextField region_name{}, region_text{};    ///< of the one that is painted
    std::shared_ptr<const Regions> regions{};  ///< of the recording; null: none
    double width{0.08};                        ///< of the picture's width
    double strength{1.0};                      ///< 0 .. 1
    int scrolls{0};            ///< pictures left in which the panel scrolls into view
    std::vector<Vec3> ring{};  ///< its edge on the relief; empty: the pointer is elsewhere
    std::string refusal{};     ///< why painting is not possible; empty: it is
    bool can_undo{false}, can_redo{false};
    bool has_paint{false};             ///< there are maps
    std::filesystem::path saved_as{};  ///< "cup_stiffness.png" and its like; empty: not kept
};

/// One update of the algorithm, explained step by step.
struct ExplainedInfo {
    ExplainedUpdate update{};
    bool held{false};      ///< the goal is fixed: after the first step, or in a replay
    std::size_t taken{0};  ///< steps shown, of update.steps
    bool runs{false};      ///< slow motion: the steps advance by themselves
    bool waits{false};     ///< for the replay's next tick, which is not read yet
};

/// The named region under the finger, or the last one for a moment.
struct RegionShown {
    std::string name{};  ///< empty: none
    std::string text{};  ///< may be empty
    bool rests{false};   ///< the finger rested on it: its text is shown, too
};

/// What the first start shows a person to do.
enum class LeadStep {
    press,   ///< on one place of the relief
    stroke,  ///< along a way on it
    choose   ///< a material on the Touch panel
};

struct LeadShown {
    LeadStep step{LeadStep::press};
    std::vector<Vec3> places{};     ///< on the relief: the place, or the way
    std::array<float, 4> button{};  ///< on the panel: left, top, right, bottom [px]; 0: not drawn
    double time_s{0.0};             ///< since the step's begin, ten times a second
    bool done{false};               ///< the person has done it
    std::string words{};            ///< spoken, as the marks are pictures
};

/// The window stands where visitors touch it: no panels, two large buttons.
struct KioskShown {
    bool has_next{false};    ///< there are several recordings
    bool can_repeat{false};  ///< what was spoken can be said again
};

/// The state of the window itself.
struct UiState {
    ItemWords focus{};           ///< the item that has the keyboard; empty: none has it
    bool keys_move_hand{false};  ///< the arrow keys move it, in place of the mouse
    std::vector<UnsafeSetting> unsafe_settings{};  ///< of the settings file, to be agreed to
    MaterialNames materials{};                     ///< to choose from
    std::optional<PixelShown> under_hand{};        ///< nothing: the hand is outside the picture
    std::optional<PixelShown> under_pointer{};     ///< nothing: pressed, or outside the relief
    std::size_t regions{0};                        ///< named ones of the recording
    RegionShown region{};
    std::optional<KioskShown> kiosk{};  ///< nothing: the window is as usual
    std::string caption{};              ///< of the recording at the shown moment; empty: none
    std::optional<LeadShown> lead{};    ///< nothing: nobody is led
    PanesShown panes{};
    std::optional<Ruler> ruler{};  ///< nothing: off
    Brush brush{};
    std::optional<ExplainedInfo> explained{};
    bool statistics{false};                         ///< shown over the relief
    ReportShown report{};                           ///< the last one of this window
    std::optional<ClipInfo> clip{};                 ///< nothing: no clip is made
    std::optional<PreparingShown> preparing{};      ///< nothing: none is prepared
    std::string speech_trouble{};                   ///< why nothing is spoken; empty: it is
    std::optional<DepthOffer> depth_offer{};        ///< nothing: no video lacks depth
    std::optional<DepthQuestion> depth_question{};  ///< nothing: the depth is sure, or answered
    std::optional<StripHistory> paused_strips{};    ///< the values of paused charts
    float strips_end_y{0.0F};  ///< the charts' lower end in the last picture [px]
    WindowCost cost{};
    bool touched{false};  ///< there was a contact: the first hint is not needed any more

    bool show_paint{false};    ///< brush switched on by key: scroll the Paint panel into view
    bool show_touch{false};    ///< a material is to be chosen: scroll the Touch panel into view
    bool show_session{false};  ///< recording ended by key: scroll the Session panel into view
    bool help_open{false};
    std::string message{};              ///< shown in a box until a person closes it
    std::string notice{};               ///< shown at the bottom until notice_until_s
    bool notice_shows_position{false};  ///< shows the current playing position instead
    double notice_until_s{0.0};
    OpenDialog dialog{};
    TextFields fields{};
    Fonts fonts{};
    float scale{1.0F};         ///< screen pixels of a layout pixel
    float window_width{1.0F};  ///< [px]
    float window_height{1.0F};
};

/// Whether the question on the depth can be answered: nothing is in front of it.
[[nodiscard]] inline bool asks_depth(const UiState& ui) {
    return ui.depth_question && !ui.depth_question->answered && !ui.dialog.shown &&
           ui.message.empty() && ui.unsafe_settings.empty() && !ui.depth_offer && !ui.help_open;
}

struct ViewerState {
    Settings settings{};  ///< live: panels write here, the next tick and picture use it
    KeyTable keys{};      ///< with those of the settings
    TouchState touch{};
    MediaState media{};
    UiState ui{};
    CommandQueue commands{};

    /// As TouchState::shape().
    [[nodiscard]] const SurfaceShape& shape() const noexcept { return touch.shape(settings.touch); }
    /// The course of the session, in a replay, or else of the video.
    [[nodiscard]] PlayState play_state() const {
        return touch.replay ? PlayState(touch.replay->playback) : media.playback.play_state();
    }
};

}  // namespace dibhr
