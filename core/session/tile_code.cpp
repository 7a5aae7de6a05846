// Each number less what its neighbours let expect, in planes of bytes, through zstd.
#include "core/session/tile_code.hpp"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <new>

namespace dibhr {

namespace {

/// The first byte of a packed tile, and how its numbers become words.
enum class Words : std::uint8_t {
    whole,   ///< whole numbers of 0 to 65535, in 16 bits
    floats,  ///< the bits of each float, in an order in which greater floats are greater words
};

using WordTile = std::array<std::uint32_t, kTilePixels>;

constexpr float kMostWhole = 65535.0F;
constexpr std::uint32_t kSign = 0x80000000U;
constexpr int kLevel = 3;  // of zstd: the next ones save 2 % more in twice the time
constexpr std::size_t kMostPlanes = 4;

constexpr std::size_t planes_of(Words words) noexcept {
    return words == Words::whole ? 2 : kMostPlanes;
}

constexpr std::uint32_t mask_of(Words words) noexcept {
    return words == Words::whole ? 0xFFFFU : 0xFFFFFFFFU;
}

std::uint32_t whole_word(float value) noexcept {
    return static_cast<std::uint32_t>(value);
}

bool is_whole(float value) noexcept {
    return value >= 0.0F && value <= kMostWhole &&
           std::bit_cast<std::uint32_t>(static_cast<float>(whole_word(value))) ==
               std::bit_cast<std::uint32_t>(value);
}

std::uint32_t float_word(float value) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

float float_of(std::uint32_t word) noexcept {
    return std::bit_cast<float>((word & kSign) != 0 ? word & ~kSign : ~word);
}

/// What the words to the left, above and above that let expect at pixel k: the plane through them,
/// held between the first two (the median of JPEG-LS). Where there is no such pixel, the other one;
/// 0 for the first.
std::uint32_t expected(const WordTile& words, std::size_t k) noexcept {
    const bool has_left = k % kTileSide != 0;
    const bool has_above = k >= kTileSide;
    if (!has_left && !has_above) return 0;
    if (!has_above) return words[k - 1];
    const std::uint32_t above = words[k - kTileSide];
    if (!has_left) return above;
    const std::uint32_t left = words[k - 1];
    const std::uint32_t corner = words[k - kTileSide - 1];
    const auto [least, most] = std::minmax(left, above);
    if (corner >= most) return least;
    if (corner <= least) return most;
    return left + above - corner;
}

/// A small difference of either sign becomes a small word.
std::uint32_t folded(std::uint32_t difference, Words words) noexcept {
    const std::uint32_t mask = mask_of(words);
    const bool negative = (difference & (mask / 2 + 1)) != 0;
    return (negative ? ~(difference << 1U) : difference << 1U) & mask;
}

std::uint32_t unfolded(std::uint32_t word) noexcept {
    return (word & 1U) != 0 ? ~(word >> 1U) : word >> 1U;
}

}  // namespace

void TilePacker::Free::operator()(ZSTD_CCtx_s* context) const noexcept {
    ZSTD_freeCCtx(context);
}

void TileUnpacker::Free::operator()(ZSTD_DCtx_s* context) const noexcept {
    ZSTD_freeDCtx(context);
}

TilePacker::TilePacker() : context_(ZSTD_createCCtx()) {
    if (!context_) throw std::bad_alloc();
    bytes_.resize(1 + ZSTD_compressBound(kMostPlanes * kTilePixels));
}

std::span<const std::uint8_t> TilePacker::pack(const Tile& tile) {
    const Words kind = std::ranges::all_of(tile, is_whole) ? Words::whole : Words::floats;
    WordTile words;
    std::ranges::transform(tile, words.begin(), kind == Words::whole ? whole_word : float_word);
    std::array<std::uint8_t, kMostPlanes * kTilePixels> planes;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        std::uint32_t word = folded((words[k] - expected(words, k)) & mask_of(kind), kind);
        for (std::size_t plane = 0; plane < planes_of(kind); ++plane, word >>= 8U)
            planes[plane * kTilePixels + k] = static_cast<std::uint8_t>(word);
    }
    bytes_[0] = static_cast<std::uint8_t>(kind);
    const std::size_t packed =
        ZSTD_compressCCtx(context_.get(), bytes_.data() + 1, bytes_.size() - 1, planes.data(),
                          planes_of(kind) * kTilePixels, kLevel);
    if (ZSTD_isError(packed) != 0) throw std::bad_alloc();  // nothing else can fail here
    return {bytes_.data(), 1 + packed};
}

TileUnpacker::TileUnpacker() : context_(ZSTD_createDCtx()) {
    if (!context_) throw std::bad_alloc();
}

std::optional<Tile> TileUnpacker::unpack(std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || bytes[0] > static_cast<std::uint8_t>(Words::floats)) return std::nullopt;
    const auto kind = static_cast<Words>(bytes[0]);
    const std::size_t count = planes_of(kind) * kTilePixels;
    std::array<std::uint8_t, kMostPlanes * kTilePixels> planes;
    if (ZSTD_decompressDCtx(context_.get(), planes.data(), count, bytes.data() + 1,
                            bytes.size() - 1) != count)
        return std::nullopt;
    WordTile words;
    Tile tile;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        std::uint32_t word = 0;
        for (std::size_t plane = planes_of(kind); plane-- > 0;)
            word = word << 8U | planes[plane * kTilePixels + k];
        words[k] = (expected(words, k) + unfolded(word)) & mask_of(kind);
        tile[k] = kind == Words::whole ? static_cast<float>(words[k]) : float_of(words[k]);
    }
    return tile;
}

}  // namespace dibhr
