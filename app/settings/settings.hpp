// What the viewer remembers from one run to the next: a TOML file in the user's configuration
// folder; and the one list of all settings, which reading, writing and comparing share.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/settings/estimators.hpp"
#include "app/settings/grip_buttons.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/name_pattern.hpp"
#include "app/settings/theme.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/words.hpp"
#include "core/sound/touch_sound.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/motion/motion_wanted.hpp"
#include "core/video/sources/media.hpp"
#include "device/force_devices.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Least width and height of a window; on the command line, in the settings and by hand.
inline constexpr int kSmallestWindow = 160;
inline constexpr int kLargestWindow = 16384;

/// Of text and panels; 0 stands for what the display says.
inline constexpr double kSmallestUi = 0.5;
inline constexpr double kLargestUi = 4.0;

/// Which dialog opens files.
enum class OpenWith : std::uint8_t {
    automatic,  ///< the desktop's where there is a desktop, else the window's own
    desktop,    ///< the desktop's, also by what is found without one
    window      ///< the window's own, with pairs and previews
};

inline constexpr std::array<Word<OpenWith>, 3> kOpenWithWords{
    {{OpenWith::automatic, "auto", "The desktop's, where there is one"},
     {OpenWith::desktop, "desktop", "The desktop's"},
     {OpenWith::window, "window", "In this window"}}};
static_assert(has_all_in_order(kOpenWithWords, OpenWith::window));

[[nodiscard]] constexpr const auto& words_of(OpenWith) noexcept {
    return kOpenWithWords;
}

/// Which panels stand open.
struct PanelsOpen {
    bool video{true};
    bool surface{false};
    bool touch{true};
    bool device{true};
    bool session{false};
    bool loop{false};
    bool paint{false};

    bool operator==(const PanelsOpen&) const = default;
};

/// Which strip charts are drawn.
struct ChartsShown {
    bool force{true};
    bool penetration{false};
    bool speed{false};
    bool energy{false};
    bool lateness{false};

    bool operator==(const ChartsShown&) const = default;
};

/// Everything that lasts. A value that the command line gives beats it, and does not get into the
/// file.
struct Settings {
    int width{1280};  ///< of the window [screen units]
    int height{800};
    double ui_scale{0.0};  ///< of text and panels; 0: as the display says
    Theme theme{Theme::dark};
    PanelsOpen panels{};
    bool panels_visible{true};
    ChartsShown charts{};
    TouchParameters touch{};
    std::string material{};        ///< what material_called() is asked for; empty: as recorded
    bool stability{true};          ///< energy that rendering creates is taken out
    bool damping_as_needed{true};  ///< with stability: not that of `touch`, but what the hand needs
    CleaningOptions cleaning{};    ///< but for the finger
    double finger_mm{0.0};         ///< radius of the fingertip
    InBetweens in_betweens{};
    ReliefLook look{};
    bool straight_view{false};
    bool others{false};             ///< the proxies of the algorithms that do not run are shown
    bool panes{false};              ///< the colour picture and the depth above the relief
    NamePattern screenshot_name{};  ///< of pictures and clips
    OpenWith open_with{OpenWith::automatic};
    bool resume{false};     ///< a video goes on where it was left
    bool fit_relief{true};  ///< to the media, whenever one is opened
    bool fit_pitch{true};
    double max_force_newton{SafetyLimits{}.max_force_newton};  ///< 0 .. 8
    bool force_in_front_only{true};  ///< of every device: none while people work in another window
    double sound_volume{SoundChoice{}.volume};  ///< 0 .. 1
    bool mute{false};                           ///< no sound of touch
    bool game_pad{true};                        ///< rumbles, when there is one
    AllDeviceSettings devices{};
    std::vector<OwnKeys> keys{};          ///< as written, in that order, also what cannot be
    std::vector<Estimator> estimators{};  ///< as written, in that order
};

/// $XDG_CONFIG_HOME/dibhr/settings.toml, or ~/.config/dibhr/settings.toml.
[[nodiscard]] std::filesystem::path settings_path();

/// The folder depth/ beside it, of what was chosen on the panel of each file's depth.
[[nodiscard]] std::filesystem::path depth_choices_path();

/// What nobody says of depth is found out, and what was chosen on the panel before is heard.
[[nodiscard]] DepthRequest usual_depth_request();

/// The defaults when the file does not exist. An unknown or out-of-range setting keeps its default
/// and is told once on stderr with file and line, and so is a key that cannot be; a file that
/// cannot be read or understood throws InputError.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file);

/// As load_settings, the warnings (one line each) given back instead of told.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file,
                                     std::vector<std::string>& warnings);

/// Writes the file whole or not at all. Throws InputError.
void save_settings(const Settings& settings, const std::filesystem::path& file);

/// `type` has the alternatives of a variant, and more.
template <typename Variant, typename... More>
struct Widened;
template <typename... Some, typename... More>
struct Widened<std::variant<Some...>, More...> {
    using type = std::variant<Some..., More...>;
};

/// One value of the settings file, and where it is held.
struct Setting {
    std::string_view table;
    std::string_view name;
    Widened<TouchWordPlace, bool*, int*, double*, std::string*, NamePattern*, CleaningPreset*,
            ButtonAction*, ReliefPaint*, Theme*, OpenWith*, DeviceWord, InBetweens*>::type value;
    double lowest{0.0};  ///< of a number
    double highest{0.0};
    std::optional<Protection> protection{};  ///< that it is of the hand
};

/// All of them but the keys, in the order of the file; to read or change what `settings` holds.
[[nodiscard]] std::vector<Setting> list_of(Settings& settings);

[[nodiscard]] bool same(const Setting& a, const Setting& b);
/// Of the same place in two lists.
void assign(const Setting& to, const Setting& from);
/// The value as the file has it.
[[nodiscard]] std::string text_of(const Setting& setting);

/// `in_file`, with every value that differs between `started` and `now` taken from `now`.
[[nodiscard]] Settings changes_kept(Settings in_file, Settings started, Settings now);

[[nodiscard]] bool same_settings(Settings a, Settings b);

}  // namespace dibhr
