// A tile: 16 x 16 numbers of an image, packed without loss. FORMAT.md states the code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/files/float_code.hpp"

namespace dibhr {

/// Pixels along a side of a tile.
inline constexpr int kTileSide = 16;
inline constexpr std::size_t kTilePixels = std::size_t{kTileSide} * kTileSide;

/// Row-major.
using Tile = std::array<float, kTilePixels>;

/// Packs tiles. One thread at a time.
class TilePacker {
  public:
    /// The same tile gives the same bytes. Valid until the next call.
    [[nodiscard]] std::span<const std::uint8_t> pack(const Tile& tile) {
        return packer_.pack(tile, kTileSide);
    }

  private:
    FloatPacker packer_{};
};

/// Unpacks them. One thread at a time.
class TileUnpacker {
  public:
    /// Nothing: the bytes are no tile's.
    [[nodiscard]] std::optional<Tile> unpack(std::span<const std::uint8_t> bytes) {
        Tile tile{};
        if (needs_before(bytes) || !unpacker_.unpack(bytes, kTileSide, tile)) return std::nullopt;
        return tile;
    }

  private:
    FloatUnpacker unpacker_{};
};

}  // namespace dibhr
