// What `dibhr view` was asked for on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "core/haptics/parameters.hpp"

namespace dibhr {

/// `command_view` first reads the settings file: `settings = load_settings(settings_path())`, then
/// `parameters = settings.touch`, `width = settings.width`, `height = settings.height`; the command
/// line's values come on top. The window saves only what a person changed in it.
struct ViewOptions {
    std::filesystem::path colour{};    ///< or a session; empty: the built-in sample
    std::filesystem::path depth{};     ///< empty: found beside the colour file
    std::string device{"auto"};        ///< auto | falcon | falcon:SERIAL | mouse | goals:FILE
    std::filesystem::path firmware{};  ///< for a Falcon that has none; empty: the kept one
    std::filesystem::path record{};
    std::filesystem::path screenshot{};  ///< the last picture, as PNG
    std::optional<double> seconds{};     ///< leave after so long
    bool sync{true};                     ///< --no-sync: do not wait for the display
    int width{1280};
    int height{800};
    std::filesystem::path bump{};
    bool raw_depth{false};         ///< no cleaning
    bool any_media{false};         ///< replay: also over files that have changed
    TouchParameters parameters{};  ///< settings file first, then the command line
    GivenParameters given{};       ///< the command line's alone: they beat a session's
    Settings settings{};           ///< as the file holds them
};

/// Opens the window and runs until it is closed. The exit code; throws Error before the window is
/// open.
int run_viewer(const ViewOptions& options);

}  // namespace dibhr
