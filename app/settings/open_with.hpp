// Which dialog opens files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/words.hpp"

namespace dibhr {

enum class OpenWith : std::uint8_t {
    automatic,  ///< the desktop's where there is a desktop, else the window's own
    desktop,    ///< the desktop's, also by what is found without one
    window      ///< the window's own, with pairs and previews
};

inline constexpr std::array<Word<OpenWith>, 3> kOpenWithWords{
    {{OpenWith::automatic, "auto", "The desktop's, where there is one"},
     {OpenWith::desktop, "desktop", "The desktop's"},
     {OpenWith::window, "window", "In this window"}}};
static_assert(has_all_in_order(kOpenWithWords, OpenWith::window));

[[nodiscard]] constexpr const auto& words_of(OpenWith) noexcept {
    return kOpenWithWords;
}

}  // namespace dibhr
