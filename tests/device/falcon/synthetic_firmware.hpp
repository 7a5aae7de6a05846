// An image in the container format of the Falcon's firmware, without a byte of anyone's program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dibhr::test {

/// A boot stream of three blocks that hold `words` random words together, 4 .. 30000; the same
/// words and seed give the same bytes. Laid out as nvent_firmware.bin: entry point 3F8002 at the
/// start of the first block, a small block at 0093A2, the last one at 3F8000.
[[nodiscard]] std::vector<std::uint8_t> synthetic_firmware(std::size_t words = 3600,
                                                           std::uint32_t seed = 1);

struct SyntheticBlock {
    std::size_t words{0};
    std::uint32_t address{0};
};

/// A boot stream of these blocks, with random words; entry point 3F8002.
[[nodiscard]] std::vector<std::uint8_t> synthetic_firmware(std::span<const SyntheticBlock> blocks,
                                                           std::uint32_t seed = 1);

}  // namespace dibhr::test
