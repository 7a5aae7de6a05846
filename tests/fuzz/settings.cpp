// settings.toml: every number in its range whatever the file holds, every warning one line, and
// what was read comes back from the file that the program writes, as do wishes for keys that cannot
// be, which a person is told of until he mends them.
#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/settings/consent.hpp"
#include "app/settings/settings.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

namespace {

void require_in_range(Settings settings) {
    for (const Setting& setting : all_settings(settings)) {
        std::visit(
            [&setting](const auto& value) {
                using Value = std::remove_cvref_t<decltype(*value)>;
                if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>) {
                    test::require_rule(*value >= setting.lowest && *value <= setting.highest,
                                       std::string(setting.name) + " is in its range");
                }
            },
            setting.value);
    }
}

/// Where nobody has agreed to anything.
void require_held(Settings settings) {
    const Consent nobody("/nonexistent/agreed");
    static_cast<void>(nobody.replace_unsafe(settings));
    const SafetyLimits usual;
    test::require_rule(settings.max_force_newton <= usual.max_force_newton && settings.stability &&
                           settings.force_in_front_only && nobody.replace_unsafe(settings).empty(),
                       "what protects the hand less is held");
    require_in_range(settings);
}

Settings load_with(const std::filesystem::path& file, std::vector<std::string>& warnings) {
    Settings settings = load_settings(file, warnings);
    for (const std::string& warning : warnings) test::require_one_line(warning);
    require_in_range(settings);
    require_held(settings);
    return settings;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("settings.toml");
    const auto& path = file.with({data, size});
    (void)test::is_taken([&path] {
        std::vector<std::string> warnings;
        const Settings settings = load_with(path, warnings);
        save_settings(settings, path);
        warnings.clear();
        const Settings again = load_with(path, warnings);
        const bool of_keys =
            std::all_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
                return warning.find(": keys.") != std::string::npos;
            });
        test::require_rule(of_keys && same_settings(settings, again),
                           "what the program wrote it reads as it was");
    });
    return 0;
}
