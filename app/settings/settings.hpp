// What the viewer remembers from one run to the next: a TOML file in the user's configuration
// folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/settings/falcon_settings.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/video/depth_cleaning.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Least width and height of a window; on the command line, in the settings and by hand.
inline constexpr int kSmallestWindow = 160;
inline constexpr int kLargestWindow = 16384;

/// Which panels stand open.
struct PanelsOpen {
    bool video{true};
    bool surface{false};
    bool touch{true};
    bool device{true};
    bool session{false};
    bool loop{false};

    bool operator==(const PanelsOpen&) const = default;
};

/// Everything that lasts. A value that the command line gives beats it, and does not get into the
/// file.
struct Settings {
    int width{1280};  ///< of the window [screen units]
    int height{800};
    PanelsOpen panels{};
    bool panels_visible{true};
    TouchParameters touch{};
    CleaningOptions cleaning{};
    ReliefLook look{};
    bool straight_view{false};
    double max_force_newton{SafetyLimits{}.max_force_newton};  ///< 0 .. 8
    FalconSettings falcon{};
};

/// $XDG_CONFIG_HOME/dibhr/settings.toml, or ~/.config/dibhr/settings.toml.
[[nodiscard]] std::filesystem::path settings_path();

/// The defaults when the file does not exist. An unknown or out-of-range setting keeps its default
/// and is told once on stderr with file and line; a file that cannot be read or understood throws
/// InputError.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file);

/// As load_settings, the warnings (one line each) given back instead of told.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file,
                                     std::vector<std::string>& warnings);

/// Writes the file whole or not at all. Throws InputError.
void save_settings(const Settings& settings, const std::filesystem::path& file);

}  // namespace dibhr
