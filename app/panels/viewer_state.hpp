// What the window shows and what a person changes in it: plain data that every panel reads and
// edits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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
#include "core/haptics/explanation.hpp"
#include "core/haptics/words.hpp"

namespace dibhr {

/// A row of the Open dialog, opened: depth alone finds its colour.
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
    TextField material{};  ///< the name to keep one under
    TextField firmware{};
    TextField depth_scale{};                  ///< "0.001"
    TextField depth_range{};                  ///< "480:4210"
    TextField no_data{};                      ///< "0,65535"
    TextField intrinsics{};                   ///< "525,525,319.5,239.5" or "60deg"
    std::array<double, 2> colour_shift_px{};  ///< right and down, in depth pixels
    std::array<double, 1> colour_size{1.0};   ///< times
};

/// A recording before it is opened.
struct Preview {
    std::filesystem::path of{};
    std::uintptr_t texture{0};  ///< name of an OpenGL texture; 0: nothing to see
    int columns{0}, rows{0};
    std::string words{};
};

/// What Tab makes of what is typed.
struct Completion {
    std::string typed{}, whole{};
};

/// The window's own dialog for opening files.
struct OpenDialog {
    static constexpr int kPicturesToFocus = 30;  ///< it takes two

    /// The folder's entries that are listed, and what that depends on.
    struct Rows {
        std::vector<std::size_t> entries{};
        std::string typed{};
        bool all_files{false};
        int of_reading{-1};
    };

    bool shown{false};
    bool in_front{false};  ///< none of the panels' fields has the keyboard
    Folder folder{};       ///< its entries are still being read, while `reads`
    bool reads{false};
    int reading{0};  ///< another number with every change of `folder`
    Rows rows{};
    std::filesystem::path chosen{};  ///< an entry of the folder; empty: none
    TextField typed{};               ///< narrows the entries, or is a path
    Completion completion{};         ///< of what is typed, when it is known
    bool all_files{false};           ///< also those that cannot be opened
    Preview preview{};
    std::filesystem::path sample_folder{};
    int line{0};               ///< another one has nothing typed into it yet
    int asks_for_keyboard{0};  ///< pictures left in which the line asks for it
    int move{0};               ///< the choice, by so many entries
    bool enter{false};         ///< opens the choice
    bool bring_into_sight{false};
};

/// Whether Enter and the arrows are meant for it; from the moment it is asked for on.
[[nodiscard]] inline bool takes_keys(const OpenDialog& dialog) {
    return dialog.shown && (dialog.in_front || dialog.asks_for_keyboard > 0);
}

/// What a picture or a clip of the window is of.
enum class PictureOf { window, relief };

/// What the window shows of a clip that is made of it.
struct ClipNews {
    std::filesystem::path file{};
    double time_s{0.0};     ///< since its first picture
    bool finishing{false};  ///< it has ended, its file is on its way
};

/// The pictures above the relief.
struct PanesShown {
    std::uintptr_t colour{0};  ///< names of OpenGL textures; 0: nothing to see
    std::uintptr_t depth{0};
};

/// Depth for a video of colour alone: to be made, being made, or made.
struct DepthOffer {
    std::filesystem::path colour{};
    std::string words{};  ///< why it cannot be opened as it is, or what went wrong; empty: neither
    std::vector<std::string> estimators{};  ///< names to choose from; none: it cannot be made
    int chosen{0};                          ///< of them
    std::string asks{};  ///< its command, escaped: it runs when a person agrees; empty: not asked
    std::optional<EstimateProgress> progress{};  ///< nothing: it is not being made
    bool ending{false};                          ///< it was cancelled, and is on its way
    std::filesystem::path depth{};  ///< made, while something else was opened; empty: not yet
};

/// A pixel of the depth that is drawn, and what it holds.
struct PixelShown {
    int column{0}, row{0};
    double nearness{0.0};      ///< 0: the farthest, 1: the nearest
    double elevation_px{0.0};  ///< of the surface, with its roughness
    bool unseen{false};        ///< no surface was ever seen there
};

/// Two points on the relief, whose distance is shown.
struct Ruler {
    std::vector<Vec3> places{};      ///< up to two; grid space, the elevation means nothing
    bool pressed{false};             ///< the mouse's button was, a picture ago
    std::vector<PixelShown> ends{};  ///< the places, now

    /// A click sets a point; a third one begins anew. `under`: nothing: it is beside the relief.
    void press(bool down, const std::optional<Vec3>& under);
};

/// What a brush lays on the relief, in the order of the panel.
enum class BrushLays { material, stiffness, friction, height, nothing };
inline constexpr std::array<Word<BrushLays>, 5> kBrushWords{
    {{BrushLays::material, "material", "Material"},
     {BrushLays::stiffness, "stiffness", "Stiffness"},
     {BrushLays::friction, "friction", "Friction"},
     {BrushLays::height, "height", "Height"},
     {BrushLays::nothing, "nothing", "Nothing: erase"}}};
static_assert(has_all_in_order(kBrushWords, BrushLays::nothing));

struct Brush {
    bool on{false};
    BrushLays lays{BrushLays::material};
    std::string material{"bark"};
    double stiffness_newton_per_mm{1.0};
    double friction{0.8};
    double height_px{8.0};
    double width{0.08};        ///< of the picture's width
    double strength{1.0};      ///< 0 .. 1
    int scrolls{0};            ///< pictures in which the panel still comes into sight
    std::vector<Vec3> ring{};  ///< its edge on the relief; empty: the pointer is beside it
    std::string refusal{};     ///< why nothing can be painted; empty: it can
    bool can_undo{false}, can_redo{false};
    bool has_paint{false};             ///< there are maps
    std::filesystem::path saved_as{};  ///< "cup_stiffness.png" and its like; empty: not kept
};

/// One update, looked at step by step.
struct ExplainedNews {
    ExplainedUpdate update{};
    bool held{false};      ///< the goal stays: a first step was taken, or it is a replay's
    std::size_t taken{0};  ///< steps, of update.steps
    bool runs{false};      ///< takes them by itself, slowly
    bool waits{false};     ///< for the replay's next tick: nothing is known of it yet
};

/// The window's own.
struct UiState {
    std::vector<Doubt> doubts{};                ///< of the settings file; a person is asked
    MaterialNames materials{};                  ///< to choose from
    std::optional<PixelShown> under_hand{};     ///< nothing: the hand is beside the picture
    std::optional<PixelShown> under_pointer{};  ///< nothing: it presses, or is beside the relief
    PanesShown panes{};
    std::optional<Ruler> ruler{};  ///< nothing: it is off
    Brush brush{};
    std::optional<ExplainedNews> explained{};
    bool statistics{false};                     ///< are shown over the relief
    std::optional<ClipNews> clip{};             ///< nothing: no clip is made
    std::optional<DepthOffer> depth_offer{};    ///< nothing: no video lacks depth
    std::optional<StripHistory> held_strips{};  ///< the charts stand still
    float strips_end_y{0.0F};                   ///< where they ended in the last picture [px]
    double pictures_per_s{0.0};
    bool touched{false};  ///< there has been a contact: the first hint has done its work

    bool show_paint{false};    ///< the brush was taken by key: the Paint panel comes into sight
    bool show_session{false};  ///< recording began by key: the Session panel comes into sight
    bool help_open{false};
    std::string message{};        ///< shown in a box until it is closed
    std::string notice{};         ///< shown for a while at the bottom
    bool notice_of_place{false};  ///< instead: where playing is, as long as it is shown
    double notice_until_s{0.0};
    OpenDialog dialog{};
    TextFields fields{};
    Fonts fonts{};
    float scale{1.0F};         ///< screen pixels of a layout pixel
    float window_width{1.0F};  ///< [px]
    float window_height{1.0F};
};

struct ViewerState {
    Settings settings{};  ///< live: panels write here, the next tick and picture use it
    KeyTable keys{};      ///< with those of the settings
    TouchState touch{};
    MediaState media{};
    UiState ui{};
    CommandQueue commands{};

    /// As TouchState::shape().
    [[nodiscard]] const SurfaceShape& shape() const noexcept { return touch.shape(settings.touch); }
    /// Of what plays: the session, in a replay, or the video.
    [[nodiscard]] Course course() const {
        return touch.replay ? Course(touch.replay->playback) : media.playback.course();
    }
};

}  // namespace dibhr
