// Makes one media of a source of depth and one of colour; inside the room.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/video/depth/colour_registration.hpp"
#include "core/video/depth/depth_scale.hpp"
#include "core/video/depth/true_shape.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/pair_times.hpp"

namespace dibhr {

/// Copies the facts of a source of depth, or of colour, into a description.
void describe_depth(const SourceFacts& facts, MediaDescription& description);
void describe_colour(const SourceFacts& facts, MediaDescription& description);
void describe_time(const SourceFacts& facts, MediaDescription& description);
/// Where its times are from, as known at the opening.
void describe_timing(const SourceFacts& facts, MediaDescription& description);

/// Gives the colour of each depth frame: the picture nearest to its time, of two the earlier one.
class ColourTrack {
  public:
    ColourTrack(std::unique_ptr<PictureSource> source, const SourceFacts& depth,
                const PairTimes& times);

    [[nodiscard]] const SourceFacts& facts() const { return source_->facts(); }
    void share_video() { source_->share_video(); }
    void decode_by_device() { source_->decode_by_device(); }
    void forget() { placed_ = is_near_ = false; }
    /// Goes to a picture near the depth's time that is quick to decode; returns its own time in
    /// that of the depth. If another picture is nearer to the next depth frame, that one is read.
    double go_near(double depth_time_s);
    const TimedPicture& shown_at(double depth_time_s);
    /// Mean time to pass over a picture; 0: not known.
    [[nodiscard]] double decoding_s() const { return now_.decoding_s; }

  private:
    bool pass_to(double time_s);  ///< false: no picture is so near

    std::unique_ptr<PictureSource> source_;
    double start_offset_s_;  ///< start of the colour after that of the depth
    double interval_s_;      ///< the lesser of both, as known at the opening; never updated
    double half_s_;          ///< likewise half of the colour's
    TimedPicture now_{};
    std::optional<TimedPicture> later_{};
    bool placed_{false};
    bool is_near_{false};  ///< `now_` is near, and nothing is known of the next picture
};

/// Reads depth, and for each depth picture the colour of its time.
class PairedMedia : public Media {
  public:
    /// `colour` may be null: then frames have none, or, if `painted`, colours of their depth.
    PairedMedia(std::unique_ptr<PictureSource> depth, std::unique_ptr<PictureSource> colour,
                DepthScale scale, bool painted = false, const PairTimes& times = {});

    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override;
    std::optional<RawFrame> next_from(double earliest_s) override;
    void seek(double media_s) override;
    void seek_near(double media_s) override;
    void seek_depth(double media_s) override;
    void share_video() override;
    void take_memory_from(const ObjectPool<DepthImage>& images) override { images_ = images; }
    void leave_out_depth(const FrameTimes& times) override;
    [[nodiscard]] std::shared_ptr<LiveFeed> live() const override { return live_; }

    /// Reads at most `most` more frames of depth, so that the description becomes exact.
    void count_frames(std::int64_t most);

    /// Before the first frame is taken: devices may decode it, and the description says which.
    void decode_by_device();

    /// Adds a sentence to the description's notice, once.
    void add_notice(const std::string& sentence);
    /// Stored in the description; the notice says what becomes of the pixels that are not seen.
    void set_sparse(double seen_share);
    void set_texture_slope(std::optional<double> slope) { description_.texture_slope = slope; }
    void set_live_feed(std::shared_ptr<LiveFeed> live) { live_ = std::move(live); }
    /// Both are stored in the description.
    void set_conclusion(DepthConclusion conclusion) {
        description_.conclusion = std::move(conclusion);
    }
    void set_panel_statement(const DepthStatement& panel) { description_.panel = panel; }
    void set_prepared_in(const std::filesystem::path& cache) { description_.prepared_in = cache; }

  private:
    std::optional<RawFrame> frame_of(std::optional<TimedPicture> taken);
    void seek_frame(double media_s);
    [[nodiscard]] std::optional<RawFrame> colour_at_known(double earliest_s);
    void take_range();
    void take_camera();
    void take_times(const PairTimes& times, const SourceFacts* colour);
    void take_true_shape();
    void take_registration(const SourceFacts& colour);
    [[nodiscard]] cv::Mat colour_for(const TimedPicture& depth, const cv::Mat& colour);
    [[nodiscard]] cv::Mat in_mm(const DepthImage& depth) const;
    void apply_true_shape(RawFrame& frame, const cv::Mat& colour);
    void report_trouble(const SourceFacts& facts);
    void report_decoders();
    void keep_size(cv::Mat& picture) const;

    std::unique_ptr<PictureSource> depth_;
    std::optional<ColourTrack> colour_{};
    DepthScale scale_;
    ObjectPool<DepthImage> images_{};
    cv::Size size_{};                              ///< of the depth's pictures
    DepthRange range_mm_{};                        ///< of distances; zeros: not metric
    std::optional<ColourRegistration> cameras_{};  ///< where the two cameras are calibrated
    Registration registration_{};                  ///< applied after that
    std::optional<TrueShape> shape_{};             ///< for `--geometry true`
    bool is_own_camera_{false};     ///< the camera is the recording's, which knows its lens
    std::string camera_trouble_{};  ///< why the stated camera is left out; empty: it is not
    bool painted_;
    bool depth_alone_{false};     ///< frames need no colour, until the next seek
    FrameTimes known_{};          ///< frames come without depth; null: they come with it
    std::size_t next_known_{0};   ///< of these times
    bool colour_of_view_{false};  ///< as far as known
    MediaDescription description_{};
    std::shared_ptr<LiveFeed> live_{};
};

}  // namespace dibhr
