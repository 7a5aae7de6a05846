// The interface of all readers: pictures with presentation times, and facts about them; inside the
// room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/depth/camera.hpp"
#include "core/video/depth/findings.hpp"

namespace dibhr {

struct LivePair;
struct VideoPicture;

/// A decoded picture: 8-bit BGR, or for depth the unchanged levels (8 or 16 bits, or 32-bit real
/// numbers, where not finite is no data; 1 to 4 channels). Shared; never written to.
struct TimedPicture {
    cv::Mat picture{};
    double time_s{0.0};  ///< presentation time, from the file's own beginning
    std::int64_t index{0};
    double decoding_s{0.0};                  ///< mean time to pass over a picture; 0: not known
    std::shared_ptr<const LivePair> pair{};  ///< of a live source: the pair that it is from
    std::shared_ptr<const VideoPicture> video{};  ///< instead of `picture`, after share_video()
    /// `picture` holds codes of 8 bits, and these are their levels, after share_video(); null: it
    /// holds levels.
    std::shared_ptr<const std::vector<float>> level_of_code{};
};

/// Where the times of pictures are from.
enum class TimesFrom { file, names, list, other, stated, assumed };

/// "file", "names", "list", "other", "stated", "assumed".
[[nodiscard]] std::string_view name_of(TimesFrom value) noexcept;

/// How it is known when pictures are shown.
struct Timing {
    TimesFrom from{TimesFrom::file};
    std::string text{};         ///< for people: "in the file"; empty: a still
    double nominal_per_s{0.0};  ///< rate at the opening, which reading does not change
    /// Frame numbers in the pictures' names, rising; null: none.
    std::shared_ptr<const std::vector<double>> numbers{};
    /// Stamps that were found for pictures without times [s], rising, and where; null: none.
    std::shared_ptr<const std::vector<double>> stamps_s{};
    TimesFrom stamps_from{TimesFrom::names};
    std::string stamps_text{};
};

/// The facts about a source known so far; more as frames are read.
struct SourceFacts {
    std::filesystem::path file{};
    std::filesystem::path first_picture{};  ///< of a folder, a list or a pattern; empty: `file`
    int columns{0};
    int rows{0};
    int bits{8};      ///< of a level: the highest is 2^bits - 1; kRealBits: real numbers
    int channels{3};  ///< 1: grey
    std::string codec{};
    std::string decoder{};  ///< a device, or why it is none; empty: the processors, as usual
    double start_s{0.0};    ///< by the clock of its file; NaN: not comparable with other files
    double duration_s{0.0};
    double frames_per_s{0.0};
    std::int64_t frames{0};
    bool frames_exact{false};
    Timing timing{};
    bool still{false};
    bool live{false};                   ///< a live source: no length, no end
    std::string trouble{};              ///< why less is readable than at the opening; empty: all is
    std::string notice{};               ///< what the opening ignored or chose; mostly empty
    Findings findings{};                ///< what its reader and its layout state about depth
    std::optional<DepthNoise> noise{};  ///< used for cleaning when it was recorded live
    Lens lens{};                        ///< of the camera that the findings state
    bool other_camera{false};           ///< its colour is from another camera at another place
    std::shared_ptr<const CameraPair> cameras{};  ///< calibrated together; null: not known

    /// Takes what reading changes: how much there is, and why less is readable.
    void take_progress(const SourceFacts& read);
    /// The file that is read first.
    [[nodiscard]] const std::filesystem::path& picture() const {
        return first_picture.empty() ? file : first_picture;
    }
};

/// Adds a clause to a notice, unless that has it or it is empty.
void add_clause(std::string& notice, const std::string& clause);

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
    /// The next picture returned is one near it that is quick to decode.
    virtual void seek_near(double time_s) { seek(time_s); }
    /// Later pictures of a video may come as its decoder made them: of colour as `video`, of depth
    /// with `level_of_code`.
    virtual void share_video() {}
    /// From the first picture on a device may decode, where this machine has one, and the picture
    /// is large enough to gain. Before the first picture is taken.
    virtual void decode_by_device() {}
    /// Reads at most `most` pictures, so that the facts become exact. For a source that is not read
    /// otherwise.
    virtual void count_frames(std::int64_t /*most*/) {}
    /// At most `most` pictures from all over the source, with the first one, chosen to be cheap to
    /// decode. The next picture returned is the first.
    virtual std::vector<cv::Mat> samples(int most);
    /// The first picture of a depth source, with its colours: 8-bit BGR. Empty: another source has
    /// to read it as colour.
    virtual cv::Mat first_in_colour() { return {}; }
    /// The times of all pictures as next() gives them, rising [s]; may read the whole file, but
    /// decodes nothing. Empty: not known without decoding.
    [[nodiscard]] virtual std::vector<double> picture_times_s() const { return {}; }
};

/// The pictures of another source, each changed in the same way: cropped, decoded, stretched.
class ChangedPictures : public PictureSource {
  public:
    using Change = std::function<cv::Mat(const cv::Mat&)>;
    using ChangeFacts = std::function<void(SourceFacts&)>;

    /// The last function adapts the source's facts to the change, except the size, which is that of
    /// the first changed picture, and what reading changes. Reads that picture. Throws InputError
    /// when it is too small to touch.
    ChangedPictures(std::unique_ptr<PictureSource> source, Change change,
                    const ChangeFacts& change_facts);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    std::optional<TimedPicture> next_from(double earliest_s) override;
    void seek(double time_s) override;
    void seek_near(double time_s) override;
    void count_frames(std::int64_t most) override;
    std::vector<cv::Mat> samples(int most) override;
    [[nodiscard]] std::vector<double> picture_times_s() const override {
        return source_->picture_times_s();
    }

  private:
    std::optional<TimedPicture> changed(std::optional<TimedPicture> taken) const;

    std::unique_ptr<PictureSource> source_;
    Change change_;
    SourceFacts facts_{};
    std::optional<TimedPicture> first_{};  ///< read already, given out next
};

/// Whether times are finite, and each is later than the one before.
[[nodiscard]] bool is_rising(const std::vector<double>& times_s);

/// Rate of pictures without times [1/s].
inline constexpr double kPicturesPerSecond = 30.0;
/// Their timing.
[[nodiscard]] Timing assumed_timing();

/// Pictures that are read by index, from 0, and whose times are known at the opening.
class IndexedPictures : public PictureSource {
  public:
    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    void seek(double time_s) override;
    [[nodiscard]] std::vector<double> picture_times_s() const override { return times_s_; }

  protected:
    /// Sets the times, increasing, one for each picture and at least one, and the facts about time.
    void take_times(std::vector<double> times_s);
    /// Reports why a picture is replaced by the one before it; keeps the first report.
    void report_trouble(const std::string& what);

    SourceFacts facts_{};

  private:
    [[nodiscard]] virtual cv::Mat picture(std::size_t at) = 0;

    std::vector<double> times_s_{};  ///< from the first
    std::size_t at_{0};              ///< index of the next picture
};

}  // namespace dibhr
