// Decodes one video track through libav: pictures in order of presentation time, without losing
// levels; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/av/decoding_device.hpp"
#include "core/av/objects.hpp"
#include "core/video/formats/av_frame.hpp"
#include "core/video/formats/shared_frame.hpp"
#include "core/video/formats/video_packets.hpp"

namespace dibhr {

/// Gives pictures rotated as the file states.
class VideoDecoder {
  public:
    /// Decodes nothing yet. With a device decodes in that, until that fails: then this machine's
    /// processors decode again from the last key frame, and no picture is lost. Throws InputError:
    /// cut off, of an unknown kind, no video.
    VideoDecoder(const std::filesystem::path& file, int track,
                 std::shared_ptr<DecodingDevice> device = nullptr);

    [[nodiscard]] const VideoPackets& packets() const noexcept { return packets_; }
    /// The name of the codec: the container's tag, else the usual name.
    [[nodiscard]] std::string codec() const;
    [[nodiscard]] int codec_id() const noexcept;  ///< an AVCodecID

    /// Null: the processors decode.
    [[nodiscard]] const DecodingDevice* device() const noexcept { return device_.get(); }

    /// The next picture; false at the end. Ignores packets that cannot be decoded.
    bool decode();
    static constexpr int kAllPackets = -1;
    /// Jumps to the key frame at or before the time [s], which decode() then gives; false where the
    /// file cannot jump. `most_packets`: where the following pictures are not needed, decode() ends
    /// after so many packets, until the next jump.
    bool jump(double time_s, int most_packets = kAllPackets);

    /// Until the next jump the decoder skips non-reference pictures before that time [s], if the
    /// codec marks them (H.264): decoding up to the target takes less time.
    void skip_non_reference_before(double time_s) noexcept;
    [[nodiscard]] bool marks_non_reference() const noexcept { return marks_non_reference_; }
    /// The times [s] of pictures skipped between the last two decoded ones, or after the last, in
    /// order.
    [[nodiscard]] const std::vector<double>& skipped_s() const noexcept { return skipped_s_; }
    /// How many pictures were decoded so far, without skipped ones.
    [[nodiscard]] std::int64_t decoded() const noexcept { return decoded_; }

    /// Keeps the decoded picture, so that it is converted only if it turns out to be needed.
    void keep();
    /// Exchanges the kept and the decoded picture.
    void swap_kept() noexcept { std::swap(frame_, kept_); }
    [[nodiscard]] const AVFrame& decoded_picture() const noexcept { return *frame_; }
    /// Makes a picture that was decoded before the decoded one again; decode() goes on as without.
    void show_again(const AVFrame& picture);

    // Of the decoded picture, as in av_frame.hpp, but rotated.

    /// From the track's beginning [s]; NaN: not known.
    [[nodiscard]] double time_s() const noexcept;
    [[nodiscard]] cv::Mat colour();
    [[nodiscard]] cv::Mat levels();
    [[nodiscard]] CodedLevels coded_levels();
    /// Its memory, with pixels of that shape; null: only colour() can give it.
    [[nodiscard]] std::shared_ptr<const VideoPicture> shared(double pixel_aspect);
    [[nodiscard]] int bits() const noexcept { return bits_of(*frame_); }
    [[nodiscard]] bool has_floats() const noexcept { return holds_floats(*frame_); }
    [[nodiscard]] double pixel_aspect() const noexcept;
    [[nodiscard]] bool is_grey() const noexcept { return dibhr::is_grey(*frame_); }

  private:
    static constexpr double kNever_s = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool open();
    int receive();
    void leave_device();
    [[nodiscard]] bool may_skip(const AVPacket& packet) const noexcept;
    bool send(const AVPacket* packet);
    void update_skipped(double until_s);
    const AVPacket* next_packet();

    std::filesystem::path file_;
    int track_;
    VideoPackets packets_;
    std::shared_ptr<DecodingDevice> device_;
    AvOwned<AVCodecContext> decoder_{};
    AvOwned<AVFrame> frame_{new_frame()}, kept_{new_frame()};
    FramePictures pictures_{};
    FrameSharer sharer_{};
    int quarter_turns_{0};                             // clockwise
    double jumped_to_s_{kNever_s}, last_s_{kNever_s};  // the last jump; the last picture since
    double again_to_s_{kNever_s};                      // pictures up to then were given before
    int most_packets_{kAllPackets}, packets_left_{kAllPackets};
    bool drained_{false};
    bool marks_non_reference_{false};  // whether the codec marks packets as non-reference
    double skip_before_s_{kNever_s};
    std::int64_t decoded_{0};
    std::set<double> may_be_skipped_s_{};  // sent to the decoder, not decoded yet
    std::vector<double> skipped_s_{};
};

/// Whether the device decodes the first pictures to the levels and times that the processors do,
/// and the first one to the colours.
[[nodiscard]] bool decodes_alike(const std::filesystem::path& file, int track,
                                 const std::shared_ptr<DecodingDevice>& device);

}  // namespace dibhr
