// Gives colour and depth of a pair times that belong together, and says where they are from; inside
// the room.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/video/depth/findings.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// From the times of a source to the times that it gets; both rise.
class TimeMap {
  public:
    /// `own_s[k]` becomes `given_s[k]`: two or more, as many of each.
    TimeMap(std::vector<double> own_s, std::vector<double> given_s);
    /// Times become `factor` times as large.
    explicit TimeMap(double factor) : factor_(factor) {}

    /// The time given to the picture at an own time.
    [[nodiscard]] double given(double time_s) const;
    /// The own time of the picture shown at a given time: the first before the beginning.
    [[nodiscard]] double own_at(double time_s) const;
    /// The own time of the first picture at a given time or later; the last after the end.
    [[nodiscard]] double own_from(double time_s) const;

    /// Sets rate and duration, and the number of pictures where it is known.
    void change(SourceFacts& facts) const;

  private:
    double factor_{1.0};
    std::vector<double> own_s_{}, given_s_{};  ///< empty: the factor counts
};

/// The pictures of another source at other times.
class RetimedPictures : public PictureSource {
  public:
    /// They begin at `start_s`; NaN: as the source.
    RetimedPictures(std::unique_ptr<PictureSource> source, TimeMap times, Timing timing,
                    double start_s);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    std::optional<TimedPicture> next_from(double earliest_s) override;
    void seek(double time_s) override;
    void seek_near(double time_s) override;
    void share_video() override { source_->share_video(); }
    void decode_by_device() override { source_->decode_by_device(); }
    void count_frames(std::int64_t most) override;
    std::vector<cv::Mat> samples(int most) override { return source_->samples(most); }
    [[nodiscard]] std::vector<double> picture_times_s() const override;

  private:
    std::optional<TimedPicture> retimed(std::optional<TimedPicture> taken);
    void update_facts();

    std::unique_ptr<PictureSource> source_;
    TimeMap times_;
    SourceFacts facts_;
};

/// How the frames of a pair go together.
struct PairTimes {
    Known<DepthTimes> times{};
    double offset_s{0.0};        ///< the depth is so much later than its times say
    double colour_later_s{0.0};  ///< how much later the colour's own beginning is than the depth's
    std::string beginning{};     ///< that in words; empty: they begin together
    std::string notice{};        ///< why both cannot be right; mostly empty
    Findings findings{};         ///< who says when frames are: of each source the surest counts
};

/// Gives the sources the times that the meaning states, and, where it states none and `find_out`,
/// those that are found: stamps, then, for pictures without times, the times of the other source's
/// frames: one by one for as many pictures, by the numbers in their names, or every n-th. Else both
/// begin as the clocks of their files or stamps say, and together where these never meet.
[[nodiscard]] PairTimes pair_times(Sources& sources, const DepthMeaning& meaning, bool find_out);

}  // namespace dibhr
