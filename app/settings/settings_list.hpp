// The one list of all settings, which reading, writing and comparing them share.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/settings/settings.hpp"

namespace dibhr {

/// One value of the settings file, and where it is held.
struct Setting {
    std::string_view table;
    std::string_view name;
    std::variant<bool*, int*, double*, std::string*, Algorithm*, ButtonAction*> value;
    double lowest{0.0};  ///< of a number
    double highest{0.0};
};

/// All of them, in the order of the file; to read or change what `settings` holds.
[[nodiscard]] std::vector<Setting> list_of(Settings& settings);

/// `in_file`, with every value that differs between `started` and `now` taken from `now`.
[[nodiscard]] Settings changes_kept(Settings in_file, Settings started, Settings now);

[[nodiscard]] bool same_settings(Settings a, Settings b);

}  // namespace dibhr
