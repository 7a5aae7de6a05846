// Rows of floats, packed without loss.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace dibhr {

/// Packs every bit of every float. One thread at a time. core/session/FORMAT.md states the code of
/// numbers packed without `before`.
class FloatPacker {
  public:
    FloatPacker();  ///< throws std::bad_alloc

    /// Row-major, `columns` in a row. `before`: as many, from which these may differ little; empty:
    /// none. The same numbers give the same bytes. Valid until the next call.
    [[nodiscard]] std::span<const std::uint8_t> pack(std::span<const float> values,
                                                     std::size_t columns,
                                                     std::span<const float> before = {});

  private:
    struct Free {
        void operator()(ZSTD_CCtx_s* context) const noexcept;
    };
    std::unique_ptr<ZSTD_CCtx_s, Free> context_;
    std::vector<std::uint32_t> words_{}, differences_{}, from_before_{};
    std::vector<std::uint8_t> planes_{}, bytes_{};
};

/// Unpacks them. One thread at a time.
class FloatUnpacker {
  public:
    FloatUnpacker();  ///< throws std::bad_alloc

    /// Replaces `values`, which hold the numbers before. False: the bytes are not those of so many
    /// numbers, and `values` hold anything.
    [[nodiscard]] bool unpack(std::span<const std::uint8_t> bytes, std::size_t columns,
                              std::span<float> values);

  private:
    struct Free {
        void operator()(ZSTD_DCtx_s* context) const noexcept;
    };
    std::unique_ptr<ZSTD_DCtx_s, Free> context_;
    std::vector<std::uint32_t> words_{};
    std::vector<std::uint8_t> planes_{};
};

/// Whether packed bytes need the numbers before.
[[nodiscard]] bool needs_before(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace dibhr
