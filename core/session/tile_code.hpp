// A tile: 16 x 16 numbers of an image, packed without loss. FORMAT.md states the code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace dibhr {

/// Pixels along a side of a tile.
inline constexpr int kTileSide = 16;
inline constexpr std::size_t kTilePixels = std::size_t{kTileSide} * kTileSide;

/// Row-major.
using Tile = std::array<float, kTilePixels>;

/// Packs tiles, every bit of every float. One thread at a time.
class TilePacker {
  public:
    TilePacker();  ///< throws std::bad_alloc

    /// The same tile gives the same bytes. Valid until the next call.
    [[nodiscard]] std::span<const std::uint8_t> pack(const Tile& tile);

  private:
    struct Free {
        void operator()(ZSTD_CCtx_s* context) const noexcept;
    };
    std::unique_ptr<ZSTD_CCtx_s, Free> context_;
    std::vector<std::uint8_t> bytes_{};
};

/// Unpacks them. One thread at a time.
class TileUnpacker {
  public:
    TileUnpacker();  ///< throws std::bad_alloc

    /// Nothing: the bytes are no tile's.
    [[nodiscard]] std::optional<Tile> unpack(std::span<const std::uint8_t> bytes);

  private:
    struct Free {
        void operator()(ZSTD_DCtx_s* context) const noexcept;
    };
    std::unique_ptr<ZSTD_DCtx_s, Free> context_;
};

}  // namespace dibhr
