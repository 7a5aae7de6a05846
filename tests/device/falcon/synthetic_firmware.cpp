// Writes a boot stream of random words.
#include "tests/device/falcon/synthetic_firmware.hpp"

#include <array>
#include <cassert>
#include <random>

namespace dibhr::test {

namespace {

constexpr std::uint32_t kKey = 0x08AA;
constexpr int kReservedWords = 8;
constexpr std::uint32_t kEntryPoint = 0x3F8002;

class BootStream {
  public:
    explicit BootStream(std::uint32_t seed) : random_(seed) {}

    void word(std::uint32_t value) {
        bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
        bytes.push_back(static_cast<std::uint8_t>((value >> 8U) & 0xFFU));
    }

    void address(std::uint32_t value) {
        word(value >> 16U);
        word(value & 0xFFFFU);
    }

    void block(std::size_t words, std::uint32_t start) {
        word(static_cast<std::uint32_t>(words));
        address(start);
        for (std::size_t k = 0; k < words; ++k) word(random_() & 0xFFFFU);
    }

    std::vector<std::uint8_t> bytes{};

  private:
    std::mt19937 random_;
};

}  // namespace

std::vector<std::uint8_t> synthetic_firmware(std::size_t words, std::uint32_t seed) {
    assert(words >= 4 && words <= 30000);
    constexpr std::size_t kLastWords = 2;
    const std::size_t table_words = 1 + words / 20;
    const std::array blocks{SyntheticBlock{words - table_words - kLastWords, kEntryPoint},
                            SyntheticBlock{table_words, 0x0093A2},
                            SyntheticBlock{kLastWords, 0x3F8000}};
    return synthetic_firmware(blocks, seed);
}

std::vector<std::uint8_t> synthetic_firmware(std::span<const SyntheticBlock> blocks,
                                             std::uint32_t seed) {
    BootStream stream(seed);
    stream.word(kKey);
    for (int k = 0; k < kReservedWords; ++k) stream.word(0);
    stream.address(kEntryPoint);
    for (const SyntheticBlock& block : blocks) stream.block(block.words, block.address);
    stream.word(0);
    return stream.bytes;
}

}  // namespace dibhr::test
