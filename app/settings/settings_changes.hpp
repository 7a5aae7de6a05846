// What one state of the settings has that another has not.
#pragma once

#include "app/settings/settings.hpp"

namespace dibhr {

/// `in_file`, with every value that differs between `started` and `now` taken from `now`.
[[nodiscard]] Settings changes_kept(const Settings& in_file, const Settings& started,
                                    const Settings& now);

[[nodiscard]] bool same_settings(const Settings& a, const Settings& b);

}  // namespace dibhr
