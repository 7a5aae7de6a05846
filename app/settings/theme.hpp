// The window's colour theme.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/words.hpp"

namespace dibhr {

enum class Theme : std::uint8_t { dark, light };

inline constexpr std::array<Word<Theme>, 2> kThemeWords{
    {{Theme::dark, "dark", "Dark"}, {Theme::light, "light", "Light"}}};
static_assert(has_all_in_order(kThemeWords, Theme::light));

[[nodiscard]] constexpr const auto& words_of(Theme) noexcept {
    return kThemeWords;
}

}  // namespace dibhr
