// Unpacks a stream of zstd or lz4 from its beginning, as far as it is needed; inside the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dibhr {

enum class CompressionFormat { zstd, lz4 };  ///< lz4: its frame format

/// The bound of what so many packed bytes may become, far above what packed pictures do.
[[nodiscard]] std::size_t most_unpacked(std::uint64_t packed_bytes) noexcept;

class UnpackedBytes {
  public:
    /// Writes the next packed bytes and returns their count: 0 at the end.
    using NextPacked = std::function<std::size_t(std::span<std::uint8_t> to)>;

    /// Unpacks at most `most` bytes.
    UnpackedBytes(CompressionFormat form, NextPacked next, std::size_t most);

    /// The first `wanted` bytes; fewer where the stream ends, is damaged, or reached its bound.
    [[nodiscard]] std::span<const std::uint8_t> beginning(std::size_t wanted);

    /// Copies bytes from a place; false where there are fewer.
    [[nodiscard]] bool read(std::uint64_t at, std::span<std::uint8_t> to);

    /// One step of a library's decoder.
    class Decoder {
      public:
        struct Step {
            std::size_t used{0}, made{0};  ///< both 0: damaged, or at the end
        };
        virtual ~Decoder() = default;
        virtual Step unpack(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) = 0;
    };

  private:
    std::size_t most_;
    NextPacked next_;
    std::unique_ptr<Decoder> decoder_;
    std::vector<std::uint8_t> packed_{};      ///< the piece that was read last
    std::span<const std::uint8_t> unused_{};  ///< of that piece
    std::vector<std::uint8_t> bytes_{};       ///< unpacked so far
    bool over_{false};                        ///< nothing more can be unpacked
};

}  // namespace dibhr
