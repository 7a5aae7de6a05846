// Packed floats: every bit comes back, also from the numbers before.
#include "core/files/float_code.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

using Values = std::vector<float>;

std::vector<std::uint32_t> bits_of(const Values& values) {
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}

std::vector<std::uint8_t> packed(const Values& values, std::size_t columns,
                                 const Values& before = {}) {
    FloatPacker packer;
    const auto bytes = packer.pack(values, columns, before);
    return {bytes.begin(), bytes.end()};
}

/// Levels of a sensor, some of them no ordinary numbers.
Values levels(std::size_t count, unsigned seed, bool whole) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 2.0);
    Values values;
    for (std::size_t k = 0; k < count; ++k) {
        const double level = 100.0 + 0.3 * static_cast<double>(k % 50) + noise(random);
        values.push_back(static_cast<float>(whole ? std::round(level) : level));
    }
    if (!whole && count > 3) {
        values[0] = -0.0F;
        values[1] = std::nanf("7");
        values[2] = -std::numeric_limits<float>::infinity();
    }
    return values;
}

}  // namespace

TEST_CASE("packed floats come back bit by bit for any size with and without numbers before",
          "[float-code]") {
    const std::size_t columns = GENERATE(1U, 7U, 64U, 200U);
    const std::size_t rows = GENERATE(1U, 2U, 33U);
    const bool whole = GENERATE(false, true);
    const bool before_whole = GENERATE(false, true);
    const Values values = levels(columns * rows, 1, whole);
    const Values before = levels(columns * rows, 2, before_whole);
    FloatUnpacker unpacker;
    for (const Values& first : {Values(), before, values}) {
        const auto bytes = packed(values, columns, first);
        Values back = first.empty() ? Values(values.size()) : first;
        REQUIRE(unpacker.unpack(bytes, columns, back));
        CHECK(bits_of(back) == bits_of(values));
        CHECK(packed(values, columns, first) == bytes);
    }
}

TEST_CASE("numbers that hardly change take less room with the ones before", "[float-code]") {
    const Values before = levels(64 * 64, 3, false);
    Values now = before;
    for (std::size_t k = 0; k < now.size(); k += 97) now[k] += 1.0F;
    const auto alone = packed(now, 64);
    const auto after = packed(now, 64, before);
    CHECK(after.size() * 4 < alone.size());
    CHECK(needs_before(after));
    CHECK_FALSE(needs_before(alone));
}

TEST_CASE("bytes that are no packed floats of that number are refused", "[float-code]") {
    const Values values = levels(64 * 16, 4, false);
    auto bytes = packed(values, 64);
    FloatUnpacker unpacker;
    Values back(values.size());
    Values shorter(values.size() - 64);
    CHECK_FALSE(unpacker.unpack(bytes, 64, shorter));
    CHECK_FALSE(unpacker.unpack({}, 64, back));
    bytes.resize(bytes.size() / 2);
    CHECK_FALSE(unpacker.unpack(bytes, 64, back));
    bytes[0] = 9;
    CHECK_FALSE(unpacker.unpack(bytes, 64, back));
}
