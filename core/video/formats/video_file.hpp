// A video file as pictures in order of presentation time, with an exact seek.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/video_decoder.hpp"

namespace dibhr {

/// Frame counts and rates of containers are estimates, so neither is ever used to find a frame:
/// times are those of the decoded frames, and a seek goes before the wanted time and decodes
/// forward.
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
    /// How many pictures were decoded since it was opened, or began again.
    [[nodiscard]] std::int64_t decoded() const noexcept { return decoder_.decoded(); }

    /// Decodes on without pictures, at most `most` frames, so that the facts become exact.
    void count_frames(std::int64_t most) override;
    /// A short file is decoded once, of a longer one some frames after each key frame nearby.
    std::vector<cv::Mat> samples(int most) override;

  private:
    enum class RunUp { quick, whole };

    void begin_again();
    void sample_evenly(int most, std::vector<cv::Mat>& pictures);
    void sample_by_jumps(int most, int frames_each, std::vector<cv::Mat>& pictures);
    void read_facts();
    void know_azure_kinect();
    void know_live_recording();
    void notice_early_end();
    bool grab();         ///< decodes one frame: its time and index; false at the end
    cv::Mat retrieve();  ///< the picture of the grabbed frame
    [[nodiscard]] TimedPicture timed(cv::Mat picture) const;  ///< of the grabbed frame
    TimedPicture retrieve_kept(TimedPicture kept);  ///< with its picture, which the decoder keeps
    void count_skipped();
    void know_time();  ///< of the frame at index_
    void rewind_before(double time_s, RunUp run_up);
    void skip_before(double time_s);
    bool run_up_to(double wanted_s, std::optional<TimedPicture> shown_then);
    [[nodiscard]] bool skipped_until(double time_s) const;
    void place_at(double time_s);  ///< index of a frame reached by a jump
    void learn();                  ///< rate and duration from the times read so far

    SourceFacts facts_{};
    PictureRole role_;
    int track_;
    bool keeps_levels_{false};  ///< they have fewer bits than the file, and are as they are
    VideoDecoder decoder_;
    double pixel_aspect_{1.0};
    std::deque<TimedPicture> ahead_{};  ///< decoded already, given out next
    std::vector<double> times_{};       ///< of all frames from the first without a gap
    double promised_s_{0.0};            ///< as the container said at the opening
    double decoding_s_{0.0};            ///< of a frame, as of late
    double interval_s_{1.0 / 30.0};     ///< as the container says; for frames without a time
    double time_s_{0.0};                ///< of the grabbed frame, or one skipped since
    std::int64_t index_{-1};            ///< of the grabbed frame
    bool grabbed_{false};               ///< a jump left a decoded frame that `grab` gives first
    bool jumped_{false};                ///< times before the next frame are unknown
    bool counted_{true};                ///< index_ is exact
    bool ended_{false};                 ///< the last grab found no frame
    bool timed_{true};                  ///< false: the file has no usable times, so it cannot jump
};

}  // namespace dibhr
