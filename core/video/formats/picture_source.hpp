// What a reader of any form gives: pictures with presentation times, and what is known of them;
// inside the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/depth/camera.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

struct LivePair;

/// A decoded picture: 8-bit BGR, or as the file has it where depth needs it (8 or 16 bits or 32-bit
/// real numbers, of which what is not finite is no data; 1 to 4 channels). Shared with nobody who
/// writes.
struct TimedPicture {
    cv::Mat picture{};
    double time_s{0.0};  ///< presentation time, from the file's own beginning
    std::int64_t index{0};
    double decoding_s{0.0};  ///< so long decoding one takes, as of late; 0: not known
    std::shared_ptr<const LivePair> pair{};  ///< of which it is, where it came live
};

/// What is known of a source so far; it grows as frames are read.
struct SourceFacts {
    std::filesystem::path file{};
    int columns{0};
    int rows{0};
    int bits{8};      ///< of a level: the highest is 2^bits - 1; kRealBits: real numbers
    int channels{3};  ///< 1: grey
    std::string codec{};
    double start_s{0.0};  ///< by the clock of its file; NaN: that is nobody else's
    double duration_s{0.0};
    double frames_per_s{0.0};
    std::int64_t frames{0};
    bool frames_exact{false};
    bool still{false};
    bool live{false};          ///< it comes as it happens, and has neither length nor end
    std::string trouble{};     ///< why less is read than at the opening; empty: nothing lacks
    std::string notice{};      ///< what was passed over or chosen at the opening; mostly empty
    DepthStatement known{};    ///< what the file's own metadata or its format says of its depth
    std::string known_from{};  ///< where it says so: "EXR channel Z"; empty: nowhere
    std::optional<DepthNoise> noise{};  ///< by which it was cleaned when it was recorded live
    Lens lens{};                        ///< of the camera that `known.intrinsics` are of
    bool other_camera{false};  ///< the colour beside it is of another one, which stands elsewhere
    std::shared_ptr<const CameraPair> cameras{};  ///< calibrated together; none: not known
};

class PictureSource {
  public:
    virtual ~PictureSource() = default;
    [[nodiscard]] virtual const SourceFacts& facts() const = 0;
    /// The next picture in order of time; nothing at the end.
    virtual std::optional<TimedPicture> next() = 0;
    /// The next picture at `earliest_s` or later, or the last one.
    virtual std::optional<TimedPicture> next_from(double earliest_s);
    /// The next picture returned is the one shown at `time_s`: the first before the beginning, the
    /// last after the end.
    virtual void seek(double time_s) = 0;
    /// The next picture returned is one near it, as soon as one can be had.
    virtual void seek_near(double time_s) { seek(time_s); }
    /// Goes through at most `most` pictures, so that the facts become exact; for a source that is
    /// not read otherwise.
    virtual void count_frames(std::int64_t /*most*/) {}
    /// At most `most` pictures from all over it, the first among them, as cheap to get as can be;
    /// the next picture returned is the first.
    virtual std::vector<cv::Mat> samples(int most);
};

/// The pictures of another source, each changed in the same way: a half of it, decoded, stretched.
class ChangedPictures : public PictureSource {
  public:
    using Change = std::function<cv::Mat(const cv::Mat&)>;
    using Tell = std::function<void(SourceFacts&)>;

    /// `tell` puts into the facts of the source what the change makes of them, but the size, which
    /// is that of the first changed picture. Reads that picture. Throws InputError when it is too
    /// small to touch.
    ChangedPictures(std::unique_ptr<PictureSource> source, Change change, Tell tell);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    std::optional<TimedPicture> next_from(double earliest_s) override;
    void seek(double time_s) override;
    void seek_near(double time_s) override;
    void count_frames(std::int64_t most) override;
    std::vector<cv::Mat> samples(int most) override;

  private:
    void learn();
    std::optional<TimedPicture> changed(std::optional<TimedPicture> taken) const;

    std::unique_ptr<PictureSource> source_;
    Change change_;
    Tell tell_;
    SourceFacts facts_{};
    std::optional<TimedPicture> first_{};  ///< read already, given out next
};

/// Pictures a second of those that tell no time.
inline constexpr double kPicturesPerSecond = 30.0;

/// Pictures that are each read by number, from 0, and whose times are known at the opening.
class IndexedPictures : public PictureSource {
  public:
    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    void seek(double time_s) override;

  protected:
    /// One time a picture, rising, and at least one: the facts of time follow from them.
    void take_times(std::vector<double> times_s);
    /// Why a picture is replaced by the one before it; the first reason stays.
    void tell_trouble(const std::string& what);

    SourceFacts facts_{};

  private:
    [[nodiscard]] virtual cv::Mat picture(std::size_t at) = 0;

    std::vector<double> times_s_{};  ///< from the first
    std::size_t at_{0};              ///< the next one
};

}  // namespace dibhr
