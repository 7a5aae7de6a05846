// Reads the options of a kiosk.
#include "app/commands/kiosk.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "app/settings/command_options.hpp"

namespace dibhr {

namespace {

constexpr double kShortest_s = 1.0;
constexpr double kLongest_s = 3600.0;

KioskOptions& begun(std::optional<KioskOptions>& kiosk) {
    return kiosk ? *kiosk : kiosk.emplace();
}

}  // namespace

void add_kiosk_options(CLI::App& app, std::optional<KioskOptions>& kiosk) {
    CLI::Option* const on = app.add_flag_function(
        "--kiosk", [&kiosk](std::int64_t) { begun(kiosk); },
        "For visitors: full screen, no panels, 40 % of the force limit; Enter: next, Space: say "
        "again, Ctrl+Shift+Q: leave");
    app.add_option_function<std::vector<std::string>>(
           "--next",
           [&kiosk](const std::vector<std::string>& files) {
               begun(kiosk).next.assign(files.begin(), files.end());
           },
           "A further recording of the kiosk; may be given several times")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->needs(on);
    add_number_option(app, "--return-after", kShortest_s, kLongest_s,
                      "A kiosk that nobody uses goes back to its start after so many seconds",
                      [&kiosk](double seconds) { begun(kiosk).return_s = seconds; })
        ->type_name("S")
        ->default_str("60")
        ->needs(on);
}

void apply_kiosk(ViewOptions& options, Settings& settings) {
    if (!options.kiosk) return;
    options.full_screen = true;
    options.stays = !options.kiosk->next.empty();  // to open the next one
    options.unsafe_settings.clear();               // no visitor agrees to them
    settings.panels_visible = false;
    settings.panes = false;
    settings.max_force_newton *= KioskOptions::kForceShare;
}

}  // namespace dibhr
