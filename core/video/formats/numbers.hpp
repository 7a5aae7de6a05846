// Numbers as other machines write them; inside the room.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dibhr {

/// Turns the byte order of each number of so many bytes.
inline void swap_bytes(std::span<std::uint8_t> numbers, std::size_t bytes) {
    for (; numbers.size() >= bytes; numbers = numbers.subspan(bytes))
        std::reverse(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(bytes));
}

}  // namespace dibhr
