// The pictures of a video track that were decoded last, as the decoder made them; inside the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "core/av/objects.hpp"

namespace dibhr {

struct DecodedPicture {
    AvOwned<AVFrame> frame{};  ///< not converted; its memory is the decoder's, by reference
    double time_s{0.0};
    std::int64_t index{0};
    std::size_t bytes{0};
};

/// A row of consecutive pictures, bounded in number and bytes: a seek back to one of them decodes
/// nothing. Pictures in the memory of a decoding device are not kept, as a device has few.
class DecodedRing {
  public:
    static constexpr std::size_t kMostPictures = 32;
    static constexpr std::size_t kMostBytes = std::size_t{96} << 20;  ///< seven pictures of 4K
    static constexpr std::size_t kFewBytes = std::size_t{8} << 20;

    /// Adds the picture that follows the newest one, and drops the oldest beyond the bounds.
    void add(const AVFrame& frame, double time_s, std::int64_t index);
    /// From the next picture on keeps kFewBytes of them and at least the newest, as while playing
    /// nobody steps back, or kMostBytes, as after a step back more may follow. At first few.
    void keep_few(bool few) noexcept { few_ = few; }
    /// Before a picture that does not follow the newest one.
    void clear() noexcept;

    /// Of the picture shown at that time. Nothing: it is not kept, or it is the newest one, whose
    /// successor's time is not known.
    [[nodiscard]] std::optional<std::size_t> place_at(double time_s) const;
    /// From 0, the oldest.
    [[nodiscard]] const DecodedPicture& picture(std::size_t place) const {
        return pictures_[place];
    }
    [[nodiscard]] std::size_t size() const noexcept { return pictures_.size(); }
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
    /// How many pictures as large as the newest one fit at most; 0: nothing is kept.
    [[nodiscard]] std::size_t room() const noexcept;

  private:
    std::deque<DecodedPicture> pictures_{};
    std::size_t bytes_{0};
    bool few_{true};
};

}  // namespace dibhr
