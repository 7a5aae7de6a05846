// The viewer's settings: a TOML file in the user's configuration folder; and the one list of all
// settings, which reading, writing and comparing share.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/settings/button_action_names.hpp"
#include "app/settings/estimators.hpp"
#include "app/settings/keys.hpp"
#include "app/settings/name_pattern.hpp"
#include "app/settings/theme.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/sound/touch_sound.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/motion/motion_request.hpp"
#include "core/video/sources/media.hpp"
#include "device/force_devices.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Bounds of a window's width and height, by command line, settings and hand [screen units].
inline constexpr int kSmallestWindow = 160;
inline constexpr int kLargestWindow = 16384;

/// Bounds of the scale of text and panels; 0 means the display's scale.
inline constexpr double kSmallestUi = 0.5;
inline constexpr double kLargestUi = 4.0;

/// Which dialog opens files.
enum class OpenWith : std::uint8_t {
    automatic,  ///< the desktop's where there is a desktop, else the window's own
    desktop,    ///< the desktop's, also where no desktop is detected
    window      ///< the window's own, with pairs and previews
};

inline constexpr std::array<NamedValue<OpenWith>, 3> kOpenWithNames{
    {{OpenWith::automatic, "auto", "The desktop's, where there is one"},
     {OpenWith::desktop, "desktop", "The desktop's"},
     {OpenWith::window, "window", "In this window"}}};
static_assert(has_all_in_order(kOpenWithNames, OpenWith::window));

[[nodiscard]] constexpr const auto& name_table(OpenWith) noexcept {
    return kOpenWithNames;
}

/// Which panels are open.
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

/// All values of the settings file. The command line's values override them and are not saved.
struct Settings {
    int width{1280};  ///< of the window [screen units]
    int height{800};
    double ui_scale{0.0};  ///< of text and panels; 0: the display's scale
    Theme theme{Theme::dark};
    PanelsOpen panels{};
    bool panels_visible{true};
    ChartsShown charts{};
    TouchParameters touch{};
    std::string material{};        ///< for material_named(); empty: as recorded
    bool stability{true};          ///< stability control: removes energy that rendering creates
    bool damping_as_needed{true};  ///< with stability: the device's need, not `touch`
    CleaningOptions cleaning{};    ///< without the fingertip
    double finger_mm{0.0};         ///< radius of the fingertip
    InBetweens in_betweens{};
    ReliefStyle relief_style{};
    bool straight_view{false};
    bool others{false};             ///< show the proxies of the other algorithms
    bool panes{false};              ///< show colour and depth above the relief
    NamePattern screenshot_name{};  ///< of pictures and clips
    OpenWith open_with{OpenWith::automatic};
    bool outlines{false};   ///< those of named regions are felt as ridges
    bool resume{false};     ///< a video begins where it was left
    bool fit_relief{true};  ///< fit the relief to each opened media
    bool fit_pitch{true};
    double max_force_newton{SafetyLimits{}.max_force_newton};  ///< 0 .. 8
    bool force_in_front_only{true};             ///< no force while another window is in front
    double sound_volume{SoundChoice{}.volume};  ///< 0 .. 1
    bool mute{false};                           ///< sound off
    bool speak{false};                          ///< what is touched, and messages, are spoken
    bool game_pad{true};                        ///< game pads rumble
    AllDeviceSettings devices{};
    std::vector<OwnKeys> keys{};          ///< as written, in that order, also invalid ones
    std::vector<Estimator> estimators{};  ///< as written, in that order
};

/// $XDG_CONFIG_HOME/dibhr/settings.toml, or ~/.config/dibhr/settings.toml.
[[nodiscard]] std::filesystem::path settings_path();

/// The folder depth/ beside it: the panel's depth choices of each file.
[[nodiscard]] std::filesystem::path depth_choices_path();

/// $XDG_CACHE_HOME/dibhr/prepared, or ~/.cache/dibhr/prepared: the surfaces that dibhr prepare
/// keeps.
[[nodiscard]] std::filesystem::path prepared_cache_path();
/// The most that they take together; those used longest ago go first.
inline constexpr std::uintmax_t kMostPreparedBytes = 20'000'000'000;

/// Unknown facts of depth are guessed; saved choices of the panel apply.
[[nodiscard]] DepthRequest usual_depth_request();

/// The defaults when the file does not exist. An unknown or out-of-range setting keeps its default,
/// with a warning on stderr that names file and line; likewise an invalid key. Throws InputError
/// for a file that cannot be read or parsed.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file);

/// The same, but returns the warnings (one line each) instead of printing them.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file,
                                     std::vector<std::string>& warnings);

/// Writes the file whole or not at all. Throws InputError.
void save_settings(const Settings& settings, const std::filesystem::path& file);

/// `type` is a variant with the alternatives of `Variant` and of `More`.
template <typename Variant, typename... More>
struct Widened;
template <typename... Some, typename... More>
struct Widened<std::variant<Some...>, More...> {
    using type = std::variant<Some..., More...>;
};

/// One value of the settings file, and the place of the value in Settings.
struct Setting {
    std::string_view table;
    std::string_view name;
    Widened<TouchChoiceTarget, bool*, int*, double*, std::string*, NamePattern*, CleaningPreset*,
            ButtonAction*, ReliefPaint*, Theme*, OpenWith*, DeviceEnum, InBetweens*>::type value;
    double lowest{0.0};  ///< of a number
    double highest{0.0};
    std::optional<Protection> protection{};  ///< set where the value protects the hand
};

/// All values except keys and estimators, in the file's order, to read or change `settings`.
[[nodiscard]] std::vector<Setting> all_settings(Settings& settings);

[[nodiscard]] bool same(const Setting& a, const Setting& b);
/// For values at the same place of two lists.
void assign(const Setting& to, const Setting& from);
/// The value as written in the file.
[[nodiscard]] std::string text_of(const Setting& setting);

/// `in_file`, with every value that differs between `started` and `now` taken from `now`.
[[nodiscard]] Settings merge_changes(Settings in_file, Settings started, Settings now);

[[nodiscard]] bool same_settings(Settings a, Settings b);

}  // namespace dibhr
