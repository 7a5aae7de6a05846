// One video track through libav: its pictures in order of presentation time, with all the levels
// that they hold; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/av/objects.hpp"
#include "core/video/formats/av_frame.hpp"
#include "core/video/formats/video_packets.hpp"

namespace dibhr {

/// Pictures come turned as the file says.
class VideoDecoder {
  public:
    /// Decodes nothing yet. Throws InputError: cut off, of an unknown kind, no video.
    VideoDecoder(const std::filesystem::path& file, int track);

    [[nodiscard]] const VideoPackets& packets() const noexcept { return packets_; }
    /// The name of the codec; as the container writes it, where that does.
    [[nodiscard]] std::string codec() const;

    /// The next picture; false at the end. Packets that cannot be decoded are passed over.
    bool decode();
    /// To the key frame at or before the time [s], which decode() then gives; false where the file
    /// cannot jump.
    bool jump(double time_s);

    /// Until the next jump, non-reference pictures before that time [s] are skipped, if the codec
    /// marks them (H.264): a run-up takes less.
    void skip_non_reference_before(double time_s) noexcept;
    /// The times [s] of those skipped between the last two decoded pictures, or after the last,
    /// in their order.
    [[nodiscard]] const std::vector<double>& skipped_s() const noexcept { return skipped_s_; }
    /// How many pictures were decoded so far: not those skipped.
    [[nodiscard]] std::int64_t decoded() const noexcept { return decoded_; }

    /// Keeps the decoded picture, which need not be converted before it is known that it is wanted.
    void keep();
    /// The one kept last becomes the decoded one, and the other way round.
    void swap_kept() noexcept { std::swap(frame_, kept_); }

    // Of the decoded picture, as av_frame.hpp has it, but turned.

    /// From the track's beginning [s]; NaN when the file does not say.
    [[nodiscard]] double time_s() const noexcept;
    [[nodiscard]] cv::Mat colour();
    [[nodiscard]] cv::Mat levels();
    [[nodiscard]] int bits() const noexcept { return bits_of(*frame_); }
    [[nodiscard]] bool has_floats() const noexcept { return holds_floats(*frame_); }
    [[nodiscard]] double pixel_aspect() const noexcept;
    [[nodiscard]] bool is_grey() const noexcept { return dibhr::is_grey(*frame_); }

  private:
    static constexpr double kNever_s = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool may_skip(const AVPacket& packet) const noexcept;
    bool send(const AVPacket* packet);
    void tell_skipped(double until_s);
    [[nodiscard]] cv::Mat turned(cv::Mat picture) const;

    VideoPackets packets_;
    AvOwned<AVCodecContext> decoder_{};
    AvOwned<AVFrame> frame_{new_frame()}, kept_{new_frame()};
    FramePictures pictures_{};
    int quarter_turns_{0};  // clockwise
    bool drained_{false};
    bool marks_non_reference_{false};  // the codec, packet by packet
    double skip_before_s_{kNever_s};
    std::int64_t decoded_{0};
    std::set<double> may_be_skipped_s_{};  // given, and not decoded yet
    std::vector<double> skipped_s_{};
};

}  // namespace dibhr
