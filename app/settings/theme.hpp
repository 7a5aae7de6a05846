// The window's colour theme.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/enum_names.hpp"

namespace dibhr {

enum class Theme : std::uint8_t { dark, light };

inline constexpr std::array<NamedValue<Theme>, 2> kThemeNames{
    {{Theme::dark, "dark", "Dark"}, {Theme::light, "light", "Light"}}};
static_assert(has_all_in_order(kThemeNames, Theme::light));

[[nodiscard]] constexpr const auto& name_table(Theme) noexcept {
    return kThemeNames;
}

}  // namespace dibhr
