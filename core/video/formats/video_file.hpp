// Reads a video file as pictures in order of presentation time, with an exact seek.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/decoded_ring.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/video_decoder.hpp"

namespace dibhr {

/// A container's frame count and rate are estimates and never used to find a frame: times are those
/// of decoded frames, and a seek jumps before the wanted time and decodes forward, but for frames
/// that were decoded just before.
class VideoFile : public PictureSource {
  public:
    /// Reads the first frame. Throws InputError when the file cannot be opened, holds none,
    /// or ends well before its header says.
    VideoFile(const std::filesystem::path& file, PictureRole role, int track = 0);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    std::optional<TimedPicture> next_from(double earliest_s) override;
    void seek(double time_s) override;
    void seek_near(double time_s) override;
    void share_video() override;
    void decode_by_device() override;
    /// From the first picture on decodes in that device, if it gives the same pictures; null: none.
    void decode_in(std::shared_ptr<DecodingDevice> device);
    /// How many pictures were decoded since the file was opened last.
    [[nodiscard]] std::int64_t decoded() const noexcept { return decoder_.decoded(); }

    /// Decodes at most `most` more frames without converting them, so that the facts become exact.
    void count_frames(std::int64_t most) override;
    /// Decodes a short file once; of a longer one some frames after a key frame near each sample,
    /// and of large pictures the key frame alone.
    std::vector<cv::Mat> samples(int most) override;
    /// While that picture is still kept as it was decoded.
    cv::Mat first_in_colour() override;
    /// By the file's packets.
    [[nodiscard]] std::vector<double> picture_times_s() const override;

  private:
    void reopen();
    void sample_evenly(int most, std::vector<cv::Mat>& pictures);
    void sample_by_jumps(int most, int frames_each, std::vector<cv::Mat>& pictures);
    bool grab_sample(const std::vector<double>& wanted_s, std::size_t at, int frames_each);
    void read_facts();
    void read_azure_kinect();
    void read_live_recording();
    void detect_early_end();
    void report_device();
    bool grab();         ///< decodes one frame: its time and index; false at the end
    cv::Mat retrieve();  ///< the picture of the grabbed frame
    [[nodiscard]] TimedPicture timed(cv::Mat picture) const;  ///< of the grabbed frame
    [[nodiscard]] bool is_coded_as_given() const noexcept;
    void take_coded(TimedPicture& taken);
    TimedPicture taken();                           ///< the same with its picture, or its memory
    TimedPicture retrieve_kept(TimedPicture kept);  ///< converts the picture that the decoder keeps
    void count_skipped();
    void count_played();
    void measure_passing(std::int64_t frames, std::chrono::duration<double> taken);
    void store_time();  ///< appends that of the frame at index_ to times_
    /// To a key frame, where the file can.
    bool jump(double time_s, int most_packets = VideoDecoder::kAllPackets);
    bool show_kept(double time_s);
    void show(const DecodedPicture& kept);
    void rewind_before(double time_s, double frames_before);
    void skip_before(double time_s, double frames_before);
    bool run_up_to(double wanted_s, std::optional<TimedPicture> shown_then);
    [[nodiscard]] bool skipped_until(double time_s) const;
    void place_at(double time_s);  ///< index of a frame reached by a jump
    void list_frames();            ///< their number and times, without decoding them
    void update_facts();           ///< rate and duration, from the times read so far

    SourceFacts facts_{};
    PictureRole role_;
    int track_;
    bool shares_video_{false};
    bool keeps_levels_{false};  ///< levels have fewer bits than the file; do not scale them
    VideoDecoder decoder_;
    std::shared_ptr<DecodingDevice> device_{};  ///< null: the processors decode
    double pixel_aspect_{1.0};
    DecodedRing ring_{};        ///< up to the frame that was decoded last
    std::size_t played_{0};     ///< pictures decoded one after the other since the last seek
    std::size_t from_ring_{0};  ///< place of the frame that grab() gives next; its end: none
    std::deque<TimedPicture> ahead_{};  ///< decoded already, given out next
    std::vector<double> times_{};       ///< of all frames from the first up to a gap
    std::vector<double> listed_s_{};    ///< of all frames, by their packets; empty: not listed
    double header_duration_s_{0.0};     ///< duration by the container's header
    double decoding_s_{0.0};            ///< mean time to decode a frame
    double passing_s_{0.0};             ///< mean time to pass over a frame; 0: not known
    double interval_s_{1.0 / 30.0};     ///< by the container; for frames without a time
    double time_s_{0.0};                ///< of the grabbed frame, or one skipped since
    std::int64_t index_{-1};            ///< of the grabbed frame
    bool grabbed_{false};               ///< a jump has decoded a frame that grab() gives first
    bool jumped_{false};                ///< times before the next frame are unknown
    bool index_exact_{true};            ///< index_ is exact
    bool ended_{false};                 ///< the last grab found no frame
    bool has_times_{true};              ///< false: the file has no usable times, so it cannot jump
};

}  // namespace dibhr
