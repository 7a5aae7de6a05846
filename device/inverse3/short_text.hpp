// A short text stored in the object itself, without allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dibhr::inverse3 {

/// At most N bytes.
template <std::size_t N>
class ShortText {
    static_assert(N < 256);

  public:
    constexpr ShortText() = default;
    /// Cuts off what does not fit.
    constexpr ShortText(std::string_view text) noexcept { assign(text); }

    /// Cuts off what does not fit; false: some was cut off.
    constexpr bool assign(std::string_view text) noexcept {
        size_ = static_cast<std::uint8_t>(std::min(text.size(), N));
        std::copy_n(text.begin(), size_, bytes_.begin());
        return text.size() <= N;
    }
    [[nodiscard]] constexpr std::string_view view() const noexcept {
        return {bytes_.data(), size_};
    }
    [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
    friend constexpr bool operator==(const ShortText& a, const ShortText& b) noexcept {
        return a.view() == b.view();
    }

  private:
    std::array<char, N> bytes_{};
    std::uint8_t size_{0};
};

}  // namespace dibhr::inverse3
