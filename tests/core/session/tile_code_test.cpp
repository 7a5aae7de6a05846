// Tiles of a surface: every bit comes back, and bytes that are no tile's are refused.
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/session/tile_code.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

template <typename Value>
Tile tile_of(Value&& value) {
    Tile tile{};
    for (std::size_t k = 0; k < kTilePixels; ++k)
        tile[k] = value(static_cast<double>(k % kTileSide), static_cast<double>(k / kTileSide));
    return tile;
}

using Bits = std::array<std::uint32_t, kTilePixels>;

Bits bits_of(const Tile& tile) {
    Bits bits{};
    for (std::size_t k = 0; k < kTilePixels; ++k) bits[k] = std::bit_cast<std::uint32_t>(tile[k]);
    return bits;
}

std::vector<std::uint8_t> packed(const Tile& tile) {
    TilePacker packer;
    const auto bytes = packer.pack(tile);
    return {bytes.begin(), bytes.end()};
}

/// Levels of a sensor: a slope, waves and noise, whole or not.
std::vector<Tile> many_tiles() {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 3.0);
    std::uniform_int_distribution<std::uint32_t> any;
    std::vector<Tile> tiles;
    for (const double height : {0.0, 100.0, 40000.0}) {
        tiles.push_back(tile_of([&](double x, double y) {
            return static_cast<float>(std::round(height + std::abs(3.0 * x - y + noise(random))));
        }));
        tiles.push_back(tile_of([&](double x, double y) {
            return static_cast<float>(height + std::sin(0.3 * x) * y);
        }));
        tiles.push_back(tile_of([&](double, double) { return static_cast<float>(height); }));
    }
    for (int k = 0; k < 200; ++k)
        tiles.push_back(tile_of([&](double, double) { return std::bit_cast<float>(any(random)); }));
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::array<float, 10> edges{
        0.0F,  -0.0F,     65535.0F,   65536.0F,       65535.5F,
        -1.0F, kInfinity, -kInfinity, std::nanf("7"), std::numeric_limits<float>::denorm_min()};
    for (const float first : edges) {
        for (const float then : edges)
            tiles.push_back(tile_of([&](double x, double) { return x < 7.0 ? first : then; }));
    }
    return tiles;
}

}  // namespace

TEST_CASE("a packed tile gives every bit of its numbers again", "[session]") {
    TilePacker packer;
    TileUnpacker unpacker;
    for (const Tile& tile : many_tiles()) {
        const auto again = unpacker.unpack(packer.pack(tile));
        REQUIRE(again);
        REQUIRE(bits_of(*again) == bits_of(tile));
    }
}

TEST_CASE("the same tile gives the same bytes, whatever was packed before it", "[session]") {
    TilePacker packer;
    for (const Tile& tile : many_tiles()) {
        const auto bytes = packer.pack(tile);
        REQUIRE(std::vector<std::uint8_t>(bytes.begin(), bytes.end()) == packed(tile));
    }
}

TEST_CASE(
    "a flat tile takes a few bytes, and one of smooth whole levels a small part of its floats",
    "[session]") {
    CHECK(packed(tile_of([](double, double) { return 1234.0F; })).size() < 32);
    const auto smooth = tile_of([](double x, double y) {
        return static_cast<float>(std::round(200.0 + 20.0 * std::sin(0.1 * x) + 3.0 * y));
    });
    CHECK(packed(smooth).size() < sizeof(Tile) / 8);
}

TEST_CASE("a damaged tile is refused or is another tile, and nothing is read beyond it",
          "[session]") {
    TileUnpacker unpacker;
    CHECK_FALSE(unpacker.unpack({}));
    for (const Tile& tile : many_tiles()) {
        const std::vector<std::uint8_t> bytes = packed(tile);
        for (std::size_t length = 0; length < bytes.size(); ++length)
            REQUIRE_FALSE(unpacker.unpack({bytes.data(), length}));
        std::vector<std::uint8_t> longer = bytes;
        longer.push_back(0);
        REQUIRE_FALSE(unpacker.unpack(longer));
        for (std::size_t at = 0; at < bytes.size(); at += 5) {
            std::vector<std::uint8_t> other = bytes;
            other[at] ^= static_cast<std::uint8_t>(1U << at % 8);
            (void)unpacker.unpack(other);  // the sanitizers watch
        }
    }
}
