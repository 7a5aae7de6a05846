// Options of a window for visitors, and of flags that switch a setting on.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "app/viewer/viewer.hpp"

namespace dibhr {

/// --kiosk, --next and --return-after; `kiosk` is nothing without the first.
void add_kiosk_options(CLI::App& app, std::optional<KioskOptions>& kiosk);

/// With --kiosk: full screen, no panels, and a low force. None of it is kept in the settings file.
void apply_kiosk(ViewOptions& options, Settings& settings);

/// An option without a value that switches a setting on.
template <typename Give>
void add_flag_of(CLI::App& app, const char* name, const Give& give, const char* help) {
    app.add_flag_function(
        name, [give](std::int64_t times) { give(times > 0); }, help);
}

}  // namespace dibhr
