// Each number less what its neighbours, or the number before, let expect, in planes of bytes,
// through zstd.
#include "core/files/float_code.hpp"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <new>

namespace dibhr {

namespace {

// The first byte of packed numbers: these bits.
constexpr std::uint8_t kFloats = 1;  ///< else whole numbers of 0 to 65535, in 16 bits
constexpr std::uint8_t kBefore = 2;  ///< expected is the number before, else the neighbours

constexpr float kMostWhole = 65535.0F;
constexpr std::uint32_t kSign = 0x80000000U;
constexpr int kLevel = 3;  // of zstd: the next ones save 2 % more in twice the time

constexpr std::size_t planes_of(std::uint8_t kind) noexcept {
    return (kind & kFloats) != 0 ? 4 : 2;
}

constexpr std::uint32_t mask_of(std::uint8_t kind) noexcept {
    return (kind & kFloats) != 0 ? 0xFFFFFFFFU : 0xFFFFU;
}

std::uint32_t whole_word(float value) noexcept {
    return static_cast<std::uint32_t>(value);
}

bool is_whole(float value) noexcept {
    return value >= 0.0F && value <= kMostWhole &&
           std::bit_cast<std::uint32_t>(static_cast<float>(whole_word(value))) ==
               std::bit_cast<std::uint32_t>(value);
}

/// The bits of a float, in an order in which greater floats are greater words.
std::uint32_t float_word(float value) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

float float_of(std::uint32_t word) noexcept {
    return std::bit_cast<float>((word & kSign) != 0 ? word & ~kSign : ~word);
}

std::uint32_t word_of(float value, std::uint8_t kind) noexcept {
    return (kind & kFloats) != 0 ? float_word(value) : whole_word(value);
}

/// The plane through the words to the left, above and above that, held between the first two (the
/// median of JPEG-LS).
std::uint32_t plane_through(std::uint32_t left, std::uint32_t above,
                            std::uint32_t corner) noexcept {
    const std::int64_t least = std::min(left, above);
    const std::int64_t most = std::max(left, above);
    // No branches: which case it is cannot be predicted.
    return static_cast<std::uint32_t>(std::clamp(least + most - corner, least, most));
}

/// Calls take(k, word) for each word in order, with what its neighbours before it let expect: where
/// there is no such neighbour, the other one; 0 for the first. take() may set word k.
template <typename Take>
void visit_expected(const std::vector<std::uint32_t>& words, std::size_t columns,
                    const Take& take) {
    for (std::size_t k = 0; k < std::min(columns, words.size()); ++k)
        take(k, k == 0 ? 0 : words[k - 1]);
    for (std::size_t row = columns; row < words.size(); row += columns) {
        take(row, words[row - columns]);
        for (std::size_t k = row + 1; k < row + columns; ++k)
            take(k, plane_through(words[k - 1], words[k - columns], words[k - columns - 1]));
    }
}

/// A small difference of either sign becomes a small word.
std::uint32_t folded(std::uint32_t difference, std::uint32_t mask) noexcept {
    const bool negative = (difference & (mask / 2 + 1)) != 0;
    return (negative ? ~(difference << 1U) : difference << 1U) & mask;
}

std::uint32_t unfolded(std::uint32_t word) noexcept {
    return (word & 1U) != 0 ? ~(word >> 1U) : word >> 1U;
}

/// The words of unfolded differences, whose bytes lie in planes.
template <std::uint8_t kKind>
void join_planes(const std::vector<std::uint8_t>& planes, std::vector<std::uint32_t>& words) {
    const std::size_t count = words.size();
    for (std::size_t k = 0; k < count; ++k) {
        std::uint32_t word = planes[k] | std::uint32_t{planes[count + k]} << 8U;
        if constexpr (planes_of(kKind) == 4)
            word |= std::uint32_t{planes[2 * count + k]} << 16U |
                    std::uint32_t{planes[3 * count + k]} << 24U;
        words[k] = unfolded(word);
    }
}

/// A loop for each kind, in which the compiler takes several numbers at once.
template <std::uint8_t kKind>
void add_expected(std::vector<std::uint32_t>& words, std::size_t columns, std::span<float> values) {
    constexpr std::uint32_t kMask = mask_of(kKind);
    if constexpr ((kKind & kBefore) != 0)
        for (std::size_t k = 0; k < words.size(); ++k)
            words[k] = (word_of(values[k], kKind) + words[k]) & kMask;
    else
        visit_expected(words, columns, [&words](std::size_t k, std::uint32_t expected) {
            words[k] = (expected + words[k]) & kMask;
        });
    for (std::size_t k = 0; k < words.size(); ++k)
        values[k] = (kKind & kFloats) != 0 ? float_of(words[k]) : static_cast<float>(words[k]);
}

template <std::uint8_t kKind>
void take_values(const std::vector<std::uint8_t>& planes, std::vector<std::uint32_t>& words,
                 std::size_t columns, std::span<float> values) {
    join_planes<kKind>(planes, words);
    add_expected<kKind>(words, columns, values);
}

/// About how many bits the words take.
std::size_t bits_of(const std::vector<std::uint32_t>& words) noexcept {
    std::size_t bits = 0;
    for (const std::uint32_t word : words) bits += static_cast<std::size_t>(std::bit_width(word));
    return bits;
}

}  // namespace

bool needs_before(std::span<const std::uint8_t> bytes) noexcept {
    return !bytes.empty() && (bytes[0] & kBefore) != 0;
}

void FloatPacker::Free::operator()(ZSTD_CCtx_s* context) const noexcept {
    ZSTD_freeCCtx(context);
}

void FloatUnpacker::Free::operator()(ZSTD_DCtx_s* context) const noexcept {
    ZSTD_freeDCtx(context);
}

FloatPacker::FloatPacker() : context_(ZSTD_createCCtx()) {
    if (!context_) throw std::bad_alloc();
}

std::span<const std::uint8_t> FloatPacker::pack(std::span<const float> values, std::size_t columns,
                                                std::span<const float> before) {
    const bool whole =
        std::ranges::all_of(values, is_whole) && std::ranges::all_of(before, is_whole);
    std::uint8_t kind = whole ? 0 : kFloats;
    const std::uint32_t mask = mask_of(kind);
    const std::size_t count = values.size();
    words_.resize(count);
    differences_.resize(count);
    for (std::size_t k = 0; k < count; ++k) words_[k] = word_of(values[k], kind);
    visit_expected(words_, columns, [&](std::size_t k, std::uint32_t expected) {
        differences_[k] = folded((words_[k] - expected) & mask, mask);
    });
    if (!before.empty()) {
        from_before_.resize(count);
        for (std::size_t k = 0; k < count; ++k)
            from_before_[k] = folded((words_[k] - word_of(before[k], kind)) & mask, mask);
        if (bits_of(from_before_) <= bits_of(differences_)) {
            differences_.swap(from_before_);
            kind |= kBefore;
        }
    }
    planes_.resize(planes_of(kind) * count);
    for (std::size_t plane = 0; plane < planes_of(kind); ++plane)
        for (std::size_t k = 0; k < count; ++k)
            planes_[plane * count + k] = static_cast<std::uint8_t>(differences_[k] >> (8U * plane));
    bytes_.resize(1 + ZSTD_compressBound(planes_.size()));
    bytes_[0] = kind;
    const std::size_t packed =
        ZSTD_compressCCtx(context_.get(), bytes_.data() + 1, bytes_.size() - 1, planes_.data(),
                          planes_.size(), kLevel);
    if (ZSTD_isError(packed) != 0) throw std::bad_alloc();  // nothing else can fail here
    return {bytes_.data(), 1 + packed};
}

FloatUnpacker::FloatUnpacker() : context_(ZSTD_createDCtx()) {
    if (!context_) throw std::bad_alloc();
}

bool FloatUnpacker::unpack(std::span<const std::uint8_t> bytes, std::size_t columns,
                           std::span<float> values) {
    if (bytes.empty() || bytes[0] > (kFloats | kBefore)) return false;
    const std::uint8_t kind = bytes[0];
    const std::size_t count = values.size();
    planes_.resize(planes_of(kind) * count);
    if (ZSTD_decompressDCtx(context_.get(), planes_.data(), planes_.size(), bytes.data() + 1,
                            bytes.size() - 1) != planes_.size())
        return false;
    words_.resize(count);
    switch (kind) {
        case 0:
            take_values<0>(planes_, words_, columns, values);
            break;
        case kFloats:
            take_values<kFloats>(planes_, words_, columns, values);
            break;
        case kBefore:
            take_values<kBefore>(planes_, words_, columns, values);
            break;
        default:
            take_values<kFloats | kBefore>(planes_, words_, columns, values);
    }
    return true;
}

}  // namespace dibhr
