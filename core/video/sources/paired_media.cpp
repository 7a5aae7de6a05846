// Pairs frames by their presentation times.
#include "core/video/sources/paired_media.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_join.hpp"
#include "core/video/sources/depth_finding.hpp"
#include "core/video/sources/packed.hpp"

namespace dibhr {

namespace {

/// Rounding of the distances of two pictures from a third one, whose times are in milliseconds [s].
constexpr double kSameDistance_s = 4.0 * kTimeTolerance_s;
constexpr double kFarAhead = 1.5;  ///< intervals; farther ahead pictures are not converted

/// Near is light, far is dark, no data is grey.
ColourImage painted_depth(const DepthImage& depth) {
    const cv::Mat levels = view_of(depth);
    cv::Mat shades;
    levels.convertTo(shades, CV_8U, 255.0 / depth.highest_level);
    cv::Mat colours;
    cv::applyColorMap(shades, colours, cv::COLORMAP_CIVIDIS);
    // Not levels != levels: OpenCV with AVX says that no number differs from itself.
    colours.setTo(cv::Scalar::all(kNoColour), ~(levels == levels));
    return colour_of(colours);
}

double interval_of(const SourceFacts& facts) {
    return facts.frames_per_s > 0.0 ? 1.0 / facts.frames_per_s : 1.0;
}

}  // namespace

void describe_depth(const SourceFacts& facts, MediaDescription& description) {
    description.depth_path = facts.file;
    description.depth_columns = facts.columns;
    description.depth_rows = facts.rows;
    description.depth_codec = facts.codec;
    description.depth_bits = facts.bits;
    description.noise = facts.noise;
}

void describe_colour(const SourceFacts& facts, MediaDescription& description) {
    description.colour_path = facts.file;
    description.colour_columns = facts.columns;
    description.colour_rows = facts.rows;
    description.colour_codec = facts.codec;
    description.colour_frames_per_s = facts.still ? 0.0 : facts.frames_per_s;
    description.colour_duration_s = facts.duration_s;
    description.colour_still = facts.still;
}

void describe_time(const SourceFacts& facts, MediaDescription& description) {
    description.duration_s = facts.duration_s;
    description.frames_per_s = facts.still ? 0.0 : facts.frames_per_s;
    description.frames = facts.frames;
    description.frames_exact = facts.frames_exact;
    description.still = facts.still;
    description.live = facts.live;
}

void describe_timing(const SourceFacts& facts, MediaDescription& description) {
    if (facts.still) return;
    description.times_from = name_of(facts.timing.from);
    description.timing = facts.live ? "as frames arrive" : facts.timing.text;
}

ColourTrack::ColourTrack(std::unique_ptr<PictureSource> source, const SourceFacts& depth,
                         const PairTimes& times)
    : source_(std::move(source)),
      start_offset_s_(times.colour_later_s - times.offset_s),
      interval_s_(std::min(interval_of(depth), interval_of(source_->facts()))),
      half_s_(0.5 * interval_of(source_->facts())) {}

double ColourTrack::go_near(double depth_time_s) {
    forget();
    const SourceFacts& facts = source_->facts();
    const double time_s = depth_time_s - start_offset_s_;
    const bool has_then = time_s >= 0.0 && time_s < facts.duration_s;
    if (facts.live || facts.still || !has_then) return depth_time_s;
    source_->seek_near(time_s);
    auto near = source_->next();
    if (!near) return depth_time_s;
    now_ = std::move(*near);
    is_near_ = true;
    return now_.time_s + start_offset_s_;
}

const TimedPicture& ColourTrack::shown_at(double depth_time_s) {
    if (source_->facts().live) {  // joined with the depth already
        now_ = source_->next().value_or(now_);
        return now_;
    }
    const double time_s = depth_time_s - start_offset_s_;
    const bool is_near = std::exchange(is_near_, false);
    if (is_near && std::fabs(now_.time_s - time_s) <= half_s_) return now_;
    const bool is_far = later_ && later_->time_s + kFarAhead * interval_s_ < time_s;
    if (!placed_ || (is_far && !pass_to(time_s))) {
        source_->seek(time_s);
        now_ = source_->next().value_or(now_);
        later_ = source_->next();
        placed_ = true;
    }
    // Of two at the same distance the earlier one stays.
    while (later_ && later_->time_s - time_s < time_s - now_.time_s - kSameDistance_s) {
        now_ = std::move(*later_);
        later_ = source_->next();
    }
    return now_;
}

/// Passed pictures are farther from `time_s` than the one that is taken.
bool ColourTrack::pass_to(double time_s) {
    auto next = source_->next_from(time_s - half_s_ - kSameDistance_s);
    if (!next || std::fabs(next->time_s - time_s) > half_s_) return false;
    now_ = std::move(*next);
    later_ = source_->next();
    return true;
}

PairedMedia::PairedMedia(std::unique_ptr<PictureSource> depth,
                         std::unique_ptr<PictureSource> colour, DepthScale scale, bool painted,
                         const PairTimes& times)
    : depth_(std::move(depth)), scale_(std::move(scale)), painted_(painted) {
    describe_depth(depth_->facts(), description_);
    size_ = {description_.depth_columns, description_.depth_rows};
    describe_time(depth_->facts(), description_);
    describe_timing(depth_->facts(), description_);
    description_.meaning = scale_.meaning();
    if (colour != nullptr) describe_colour(colour->facts(), description_);
    take_times(times, colour != nullptr ? &colour->facts() : nullptr);
    take_range();
    take_camera();
    take_true_shape();
    if (painted_ || (shape_ && colour != nullptr)) {
        description_.colour_columns = description_.depth_columns;
        description_.colour_rows = description_.depth_rows;
    }
    add_notice(depth_->facts().notice);
    if (colour == nullptr) return;
    add_notice(colour->facts().notice);
    colour_of_view_ = true;
    take_registration(colour->facts());
    colour_.emplace(std::move(colour), depth_->facts(), times);
}

std::optional<RawFrame> PairedMedia::next() {
    return known_ ? colour_at_known(0.0) : frame_of(depth_->next());
}

std::optional<RawFrame> PairedMedia::next_from(double earliest_s) {
    return known_ ? colour_at_known(earliest_s) : frame_of(depth_->next_from(earliest_s));
}

/// The frame at the next known time that is not before `earliest_s`, or at the last one.
std::optional<RawFrame> PairedMedia::colour_at_known(double earliest_s) {
    const std::vector<double>& times = *known_;
    while (next_known_ + 1 < times.size() && times[next_known_] < earliest_s) ++next_known_;
    if (!(next_known_ < times.size())) return std::nullopt;
    RawFrame frame;
    frame.media_s = times[next_known_];
    frame.index = static_cast<std::int64_t>(next_known_++);
    frame.colour_of_view = colour_of_view_;
    frame.never_has_holes = frame.depth_left_out = true;
    report_decoders();
    if (!colour_) return frame;
    const TimedPicture taken = colour_->shown_at(frame.media_s);
    report_trouble(colour_->facts());
    frame.skipping_s = colour_->decoding_s();
    frame.video = taken.video;
    if (!frame.video)
        frame.colour = colour_of(apply_registration(taken.picture, registration_, size_));
    return frame;
}

std::optional<RawFrame> PairedMedia::frame_of(std::optional<TimedPicture> taken) {
    describe_time(depth_->facts(), description_);
    report_trouble(depth_->facts());
    report_decoders();
    if (!taken) return std::nullopt;
    keep_size(taken->picture);
    RawFrame frame;
    frame.depth = scale_.image_of(taken->picture, images_.take_out(), taken->level_of_code.get());
    frame.media_s = taken->time_s;
    frame.index = taken->index;
    frame.colour_of_view = colour_of_view_;
    frame.never_has_holes = scale_.is_always_data() && !shape_;
    cv::Mat colour;
    const bool has_colour = colour_.has_value() && !depth_alone_;
    const TimedPicture as_taken = has_colour ? colour_->shown_at(taken->time_s) : TimedPicture();
    frame.video = as_taken.video;
    if (has_colour) colour = colour_for(*taken, as_taken.picture);
    if (taken->pair)
        frame.taken = std::make_shared<const SourcePictures>(
            SourcePictures{taken->picture, depth_->facts().bits, as_taken.picture, taken->pair});
    if (frame.never_has_holes && taken->decoding_s > 0.0)
        frame.skipping_s = taken->decoding_s + (colour_ ? colour_->decoding_s() : 0.0);
    if (shape_)
        apply_true_shape(frame, colour);
    else if (has_colour && !frame.video)
        frame.colour = colour_of(colour);
    if (painted_ && !depth_alone_) frame.colour = painted_depth(frame.depth);
    return frame;
}

/// The colour picture as the depth camera would see it.
cv::Mat PairedMedia::colour_for(const TimedPicture& depth, const cv::Mat& colour) {
    report_trouble(colour_->facts());
    if (cameras_ && !colour.empty())
        return apply_registration(
            cameras_->seen_from_depth(scale_.distances_mm(depth.picture), colour), registration_,
            size_);
    return apply_registration(colour, registration_, size_);
}

void PairedMedia::take_times(const PairTimes& times, const SourceFacts* colour) {
    if (description_.meaning) description_.meaning->times = times.times;
    const bool colour_takes = colour != nullptr && colour->timing.from == TimesFrom::other;
    if (colour_takes && !description_.still && !colour->still) {
        description_.times_from = name_of(TimesFrom::other);
        description_.timing += "; of the colour: " + colour->timing.text;
    }
    if (!times.beginning.empty()) description_.timing += "; " + times.beginning;
    if (times.offset_s != 0.0) {
        description_.times_from = name_of(TimesFrom::stated);
        description_.timing += "; " + short_text(times.offset_s) + " s later";
    }
    add_notice(times.notice);
}

void PairedMedia::take_range() {
    const auto& meaning = description_.meaning;
    if (!meaning || !meaning->is_metric()) return;
    const double unit_mm = one_in_mm(meaning->unit.value);
    range_mm_ = {meaning->range.value.near * unit_mm, meaning->range.value.far * unit_mm};
}

/// A recording's calibration counts only for colour and depth of that recording.
void PairedMedia::take_registration(const SourceFacts& colour) {
    const auto& meaning = description_.meaning;
    if (!meaning) return;
    registration_ = meaning->registration.value;
    const SourceFacts& facts = depth_->facts();
    if (colour.file != facts.file) return;
    if (facts.cameras && meaning->is_metric()) {
        cameras_.emplace(size_, *facts.cameras, range_mm_.far);
        description_.registered_by = facts.cameras->known_from;
    } else if (facts.other_camera && registration_ == Registration{}) {
        colour_of_view_ = false;
        add_notice(shown(facts.file) +
                   " has colour and depth of two cameras, and does not tell how they stand: record "
                   "depth that is aligned to the colour, or shift the colour (--registration)");
    }
}

/// A packed picture's camera is of the whole picture or of a crop: its metadata say of which.
void PairedMedia::take_camera() {
    auto& meaning = description_.meaning;
    if (!meaning || !meaning->intrinsics.value) return;
    is_own_camera_ =
        meaning->intrinsics.value == sure_facts({}, depth_->facts().findings).intrinsics;
    if (is_of_halves(meaning->packing.value)) return;
    FittedCamera fitted = fit_camera(*meaning->intrinsics.value, {}, size_);
    meaning->intrinsics.value = fitted.camera;
    camera_trouble_ = fitted.camera ? std::string() : fitted.notice;
    add_notice(fitted.notice);
}

void PairedMedia::take_true_shape() {
    const auto& meaning = description_.meaning;
    if (!meaning || meaning->geometry.value != Geometry::true_shape) return;
    const std::string file = shown(description_.depth_path);
    if (!meaning->is_metric())
        throw InputError(file +
                         " has no distances, so its true shape is not known: give its unit, mm or "
                         "m, with the scale (--depth-unit), or the relief (--geometry relief)");
    if (!camera_trouble_.empty()) throw InputError(file + ": " + camera_trouble_);
    if (!meaning->intrinsics.value)
        throw InputError(file +
                         " does not say through which camera it was seen: give the intrinsics "
                         "FX,FY,CX,CY or a field of view, as in 60deg (--intrinsics), or the "
                         "relief (--geometry relief)");
    std::vector<cv::Mat> samples_mm;
    const std::vector<cv::Mat> pictures = sample_pictures(*depth_);
    samples_mm.reserve(pictures.size());
    for (const cv::Mat& picture : pictures) samples_mm.push_back(in_mm(scale_.image_of(picture)));
    const CameraModel camera(*meaning->intrinsics.value,
                             is_own_camera_ ? depth_->facts().lens : Lens{});
    shape_.emplace(size_, camera, range_mm_,
                   orthographic_grid(size_, camera, range_mm_, samples_mm));
    description_.depth_columns = shape_->grid().columns;
    description_.depth_rows = shape_->grid().rows;
    description_.true_fit = Fit{shape_->relief_px(), shape_->grid().pitch_mm};
}

/// Distances from the camera; elevations count from the farthest distance.
cv::Mat PairedMedia::in_mm(const DepthImage& depth) const {
    cv::Mat depth_mm;
    view_of(depth).convertTo(
        depth_mm, CV_32F, (range_mm_.near - range_mm_.far) / scale_.highest_level(), range_mm_.far);
    return depth_mm;
}

void PairedMedia::apply_true_shape(RawFrame& frame, const cv::Mat& colour) {
    OrthographicPicture straight = shape_->orthographic_view(in_mm(frame.depth), colour);
    frame.depth = std::move(straight.depth);
    frame.colour = std::move(straight.colour);
}

/// Colour where nothing moves or resamples it; depth where nothing else needs its levels.
void PairedMedia::share_video() {
    if (!cameras_) depth_->share_video();
    if (colour_ && !cameras_ && !shape_ && registration_ == Registration{}) colour_->share_video();
}

void PairedMedia::decode_by_device() {
    depth_->decode_by_device();
    if (colour_) colour_->decode_by_device();
    report_decoders();
}

void PairedMedia::report_decoders() {
    const auto words = [](const std::string& decoder) {
        return decoder.empty() ? std::string("the processors") : decoder;
    };
    const std::string& depth = depth_->facts().decoder;
    const std::string& colour = colour_ ? colour_->facts().decoder : depth;
    if (depth.empty() && colour.empty()) return;
    description_.decoders =
        depth == colour ? depth : "colour by " + words(colour) + "; depth by " + words(depth);
}

/// Where the colour is drawn, moved or calibrated by the depth, that is decoded all the same.
void PairedMedia::leave_out_depth(const FrameTimes& times) {
    known_ = painted_ || cameras_ || shape_ ? nullptr : times;
}

void PairedMedia::seek_frame(double media_s) {
    if (!known_) return depth_->seek(media_s);
    const auto after = std::ranges::upper_bound(*known_, media_s + kTimeTolerance_s);
    next_known_ =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - known_->begin(), 1) - 1);
}

void PairedMedia::seek(double media_s) {
    depth_alone_ = false;
    seek_frame(media_s);
    if (colour_) colour_->forget();
}

void PairedMedia::seek_depth(double media_s) {
    seek(media_s);
    depth_alone_ = true;
}

void PairedMedia::seek_near(double media_s) {
    depth_alone_ = false;
    // The colour first, as its pictures mostly take longest.
    const double near_s = colour_ ? colour_->go_near(media_s) : media_s;
    known_ ? seek_frame(near_s) : depth_->seek_near(near_s);
}

void PairedMedia::count_frames(std::int64_t most) {
    depth_->count_frames(most);
    describe_time(depth_->facts(), description_);
}

void PairedMedia::add_notice(const std::string& sentence) {
    add_clause(description_.notice, sentence);
}

void PairedMedia::set_sparse(double seen_share) {
    constexpr int kDigits = 2;
    description_.sparse_share = seen_share;
    add_notice("sparse depth, " + short_text(100.0 * seen_share, kDigits) +
               " % of the pixels are seen: " +
               (shape_ ? "a true shape has no surface between them, the relief has "
                         "(--geometry relief)"
                       : "cleaning interpolates the surface between them"));
}

void PairedMedia::report_trouble(const SourceFacts& facts) {
    if (description_.trouble.empty()) description_.trouble = facts.trouble;
}

/// Resizes a picture to the first one's size: a surface keeps its size. Levels are never mixed.
void PairedMedia::keep_size(cv::Mat& picture) const {
    if (picture.size() == size_) return;
    cv::Mat resized;
    cv::resize(picture, resized, size_, 0.0, 0.0, cv::INTER_NEAREST);
    picture = resized;
}

}  // namespace dibhr
