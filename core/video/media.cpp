// Opens what people bring: a colour and a depth video or image, paired by presentation time.
#include "core/video/media.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/video/input_file.hpp"
#include "core/video/libraries.hpp"
#include "core/video/pictures.hpp"
#include "core/video/video_file.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

/// A colour frame up to this part of an interval later than the depth frame still belongs to it:
/// streams that run together may be a little apart. Less than half, so that halfway the earlier one
/// is taken.
constexpr double kNotLater = 0.4;
constexpr std::int64_t kMostCounted = 3000;  ///< frames decoded to describe a video exactly

/// The colour that belongs to each depth frame: the newest one of its time.
class ColourTrack {
  public:
    explicit ColourTrack(std::unique_ptr<PictureSource> source) : source_(std::move(source)) {}

    [[nodiscard]] const SourceFacts& facts() const { return source_->facts(); }
    void forget() { placed_ = false; }

    const cv::Mat& shown_at(double depth_time_s, double depth_interval_s) {
        const double interval_s = std::min(depth_interval_s, interval_of(source_->facts()));
        const double latest_s = depth_time_s + kNotLater * interval_s;
        if (!placed_) {
            source_->seek(latest_s);
            now_ = source_->next().value_or(now_);
            later_ = source_->next();
            placed_ = true;
        }
        while (later_ && later_->time_s <= latest_s) {
            now_ = std::move(*later_);
            later_ = source_->next();
        }
        return now_.picture;
    }

    [[nodiscard]] static double interval_of(const SourceFacts& facts) {
        return facts.frames_per_s > 0.0 ? 1.0 / facts.frames_per_s : 1.0;
    }

  private:
    std::unique_ptr<PictureSource> source_;
    TimedPicture now_{};
    std::optional<TimedPicture> later_{};
    bool placed_{false};
};

void describe_depth(const SourceFacts& facts, MediaDescription& description) {
    description.depth_path = facts.file;
    description.depth_columns = facts.columns;
    description.depth_rows = facts.rows;
    description.depth_codec = facts.codec;
    description.depth_bits = facts.bits;
}

void describe_colour(const SourceFacts& facts, MediaDescription& description) {
    description.colour_path = facts.file;
    description.colour_columns = facts.columns;
    description.colour_rows = facts.rows;
    description.colour_codec = facts.codec;
}

void describe_time(const SourceFacts& facts, MediaDescription& description) {
    description.duration_s = facts.duration_s;
    description.frames_per_s = facts.still ? 0.0 : facts.frames_per_s;
    description.frames = facts.frames;
    description.frames_exact = facts.frames_exact;
    description.still = facts.still;
    description.remark = facts.remark;
}

/// Depth drives; colour is optional.
class PairedMedia : public Media {
  public:
    PairedMedia(std::unique_ptr<PictureSource> depth, std::optional<ColourTrack> colour)
        : depth_(std::move(depth)), colour_(std::move(colour)) {
        describe_depth(depth_->facts(), description_);
        describe_time(depth_->facts(), description_);
        if (colour_) describe_colour(colour_->facts(), description_);
    }

    [[nodiscard]] const MediaDescription& description() const override { return description_; }

    std::optional<RawFrame> next() override {
        auto taken = depth_->next();
        describe_time(depth_->facts(), description_);
        if (!taken) return std::nullopt;
        keep_size(taken->picture);
        RawFrame frame;
        frame.depth = depth_of(taken->picture);
        frame.media_s = taken->time_s;
        frame.index = taken->index;
        if (colour_) {
            const double interval_s = ColourTrack::interval_of(depth_->facts());
            frame.colour = colour_of(colour_->shown_at(frame.media_s, interval_s));
        }
        return frame;
    }

    void seek(double media_s) override {
        depth_->seek(media_s);
        if (colour_) colour_->forget();
    }

  private:
    /// A stream may change its size on the way; a surface may not. Levels are never mixed.
    void keep_size(cv::Mat& picture) const {
        const cv::Size size(description_.depth_columns, description_.depth_rows);
        if (picture.size() == size) return;
        cv::Mat resized;
        cv::resize(picture, resized, size, 0.0, 0.0, cv::INTER_NEAREST);
        picture = resized;
    }

    std::unique_ptr<PictureSource> depth_;
    std::optional<ColourTrack> colour_;
    MediaDescription description_{};
};

bool is_still(const fs::path& file) {
    try {
        return cv::haveImageReader(file.string());
    } catch (const cv::Exception&) {
        return false;
    }
}

/// The depth file given, or found beside the colour file. Throws InputError that says what is
/// missing.
fs::path depth_file_for(const fs::path& colour, const fs::path& depth) {
    if (!depth.empty()) return depth;
    std::string looked_for;
    if (auto found = find_depth_beside(colour, looked_for)) return *found;
    if (named_depth(colour))
        throw InputError(
            shown(colour) +
            " is given alone and its name says depth: give the colour file first, then "
            "this one");
    throw InputError(shown(colour) +
                     " needs a depth file beside it: give one as the second file (looked for " +
                     looked_for + ")");
}

}  // namespace

std::unique_ptr<PictureSource> open_picture_source(const fs::path& file, PictureRole role) {
    set_up_libraries();
    require_readable(file);
    if (is_still(file)) return std::make_unique<StillFile>(file, role);
    return std::make_unique<VideoFile>(file);
}

std::unique_ptr<Media> open_media(const fs::path& colour, const fs::path& depth) {
    if (colour.empty())
        throw InputError(shown(depth) +
                         " is depth alone: give the colour file that belongs to it, too");
    require_readable(colour);
    // First, so that a colour file that cannot be read is not blamed on a missing depth file.
    auto colour_source = open_picture_source(colour, PictureRole::colour);
    const fs::path depth_file = depth_file_for(colour, depth);
    return std::make_unique<PairedMedia>(open_picture_source(depth_file, PictureRole::depth),
                                         ColourTrack(std::move(colour_source)));
}

std::unique_ptr<Media> open_depth(const fs::path& depth) {
    return std::make_unique<PairedMedia>(open_picture_source(depth, PictureRole::depth),
                                         std::nullopt);
}

MediaDescription describe_media(const fs::path& file) {
    set_up_libraries();
    require_readable(file);
    MediaDescription description;
    const auto describe = [&](const SourceFacts& facts) {
        const bool depth = named_depth(file) || facts.channels == 1 || facts.bits == 16;
        depth ? describe_depth(facts, description) : describe_colour(facts, description);
        describe_time(facts, description);
    };
    if (is_still(file)) {
        describe(StillFile(file, PictureRole::depth).facts());
    } else {
        VideoFile video(file);
        video.count_frames(kMostCounted);
        describe(video.facts());
    }
    return description;
}

}  // namespace dibhr
