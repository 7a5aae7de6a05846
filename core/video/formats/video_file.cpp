// Finds frames by their decoded times, and updates the facts as it reads.
#include "core/video/formats/video_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/formats/video_packets.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

namespace {

constexpr double kNearAhead_s = 1.0;   ///< up to here decoding forward is as quick as a jump
constexpr double kNearBehind_s = 2.0;  ///< a seek back by less is a step: more may follow
constexpr double kFewFrames = 3.0;     ///< directly before the wanted frame none is skipped
constexpr double kAllFrames = 1e9;
constexpr int kSmallPixels = 1280 * 720;  ///< up to here the processors are quick enough
constexpr double kHalf = 0.5;  ///< of the pictures of an H.264 video may be non-reference
constexpr std::uintmax_t kQuicklyRead = 64 << 20;  ///< bytes of a file read for its packets' times
constexpr double kLongest_s = 1e6;                 ///< bounds a seek into a file of unknown length

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& file, PictureRole role, int track)
    : role_(role), track_(track), decoder_(file, track) {
    facts_.file = file;
    read_facts();
    const double header_duration_s = facts_.duration_s;
    if (!grab())
        throw InputError(shown(file) + " holds no picture that can be decoded: record it again");
    facts_.start_s = decoder_.packets().start_s();
    facts_.bits = decoder_.bits();
    if (role == PictureRole::depth) read_live_recording();
    pixel_aspect_ = decoder_.pixel_aspect();
    ahead_.push_back(timed(retrieve()));
    facts_.columns = ahead_.front().picture.cols;
    facts_.rows = ahead_.front().picture.rows;
    facts_.channels = decoder_.is_grey() ? 1 : 3;
    require_size(file, facts_.columns, facts_.rows);
    require_whole(file, track, header_duration_s);
    header_duration_s_ = header_duration_s;
    if (!decoder_.packets().counts_frames()) list_frames();
    if (role == PictureRole::depth) read_azure_kinect();
}

/// Facts of a live recording by this program.
void VideoFile::read_live_recording() {
    const VideoPackets& packets = decoder_.packets();
    facts_.noise = noise_in(packets.tag(kNoiseTag));
    const int bits = std::atoi(packets.tag(kBitsTag).c_str());
    keeps_levels_ = facts_.noise && bits > 0 && bits < facts_.bits;
    if (keeps_levels_) facts_.bits = bits;
}

void VideoFile::reopen() {
    ring_.clear();
    from_ring_ = 0;
    decoder_ = VideoDecoder(facts_.file, track_, device_);
    index_ = -1;
    time_s_ = 0.0;
    grabbed_ = false;
    jumped_ = false;
    index_exact_ = true;
    ended_ = false;
}

void VideoFile::read_facts() {
    const VideoPackets& packets = decoder_.packets();
    if (const double rate = packets.frames_per_s(); rate > 0.0) interval_s_ = 1.0 / rate;
    facts_.frames_per_s = 1.0 / interval_s_;
    facts_.timing.nominal_per_s = facts_.frames_per_s;
    facts_.timing.text = "in the file";
    facts_.frames = packets.frames();
    facts_.duration_s = static_cast<double>(facts_.frames) * interval_s_;
    facts_.codec = decoder_.codec();
}

/// Facts of an Azure Kinect recording, which has the mode of the depth camera and the calibration
/// of all cameras (Azure Kinect DK, record file format).
void VideoFile::read_azure_kinect() {
    const VideoPackets& packets = decoder_.packets();
    if (facts_.bits != 16 || packets.tag("K4A_DEPTH_MODE").empty()) return;
    Finding finding =
        finding_of_metadata({.unit = DepthUnit::mm, .scale = 1.0, .no_data = std::vector{0.0}},
                            "Azure Kinect recording");
    const std::string calibration = packets.attachment("calibration.json");
    const cv::Size size(facts_.columns, facts_.rows);
    if (const auto camera = azure_kinect_depth_camera(calibration, size)) {
        finding.statement.intrinsics = camera->intrinsics();
        finding.reason = "Azure Kinect calibration";
        facts_.lens = camera->lens();
    }
    if (auto cameras = azure_kinect_cameras(calibration, size))
        facts_.cameras = std::make_shared<const CameraPair>(std::move(*cameras));
    facts_.findings.push_back(std::move(finding));
}

/// Reports an end before the duration that was verified at the opening.
void VideoFile::detect_early_end() {
    const double end_s = time_s_ + interval_s_;
    if (jumped_ || !(end_s < least_end_s(header_duration_s_))) return;
    facts_.trouble = shown(facts_.file) + " breaks off at " + number_text(end_s, 1) + " s of " +
                     number_text(header_duration_s_, 1) +
                     " s since it was opened: what is left plays on; copy or export it again";
}

bool VideoFile::grab() {
    if (grabbed_) {
        grabbed_ = false;
        return true;
    }
    if (from_ring_ < ring_.size()) {
        show(ring_.picture(from_ring_++));
        return true;
    }
    const auto begin = std::chrono::steady_clock::now();
    ended_ = !decoder_.decode();
    if (device_ && decoder_.device() == nullptr) report_device();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (!jumped_) count_skipped();
    if (ended_) {
        detect_early_end();
        if (!jumped_ && index_exact_ && index_ >= 0 &&
            index_ + 1 == static_cast<std::int64_t>(times_.size())) {
            facts_.frames = index_ + 1;
            facts_.frames_exact = true;
            update_facts();
        }
        return false;
    }
    const double last_s = time_s_;
    const bool follows = index_ >= 0 && !jumped_;
    // The first frame also fills the decoder's threads.
    if (follows && decoder_.skipped_s().empty())
        decoding_s_ = moving_mean_from_first(decoding_s_, taken.count());
    time_s_ = decoder_.time_s();
    if (index_ < 0 && !(time_s_ >= 0.0)) time_s_ = 0.0;
    if (follows && !(time_s_ > last_s)) {
        has_times_ = false;
        time_s_ = last_s + interval_s_;
    }
    if (jumped_)
        place_at(time_s_);
    else
        ++index_;
    jumped_ = false;
    store_time();
    if (!decoder_.skipped_s().empty()) ring_.clear();
    ring_.add(decoder_.decoded_picture(), time_s_, index_);
    from_ring_ = ring_.size();
    return true;
}

/// Counts skipped frames like decoded ones: their times are known.
void VideoFile::count_skipped() {
    for (const double skipped_s : decoder_.skipped_s()) {
        time_s_ = skipped_s;
        ++index_;
        store_time();
    }
}

void VideoFile::store_time() {
    if (!index_exact_ || index_ != static_cast<std::int64_t>(times_.size())) return;
    times_.push_back(time_s_);
    update_facts();
}

cv::Mat VideoFile::retrieve() {
    const bool is_depth = role_ == PictureRole::depth;
    if (is_depth && decoder_.has_floats())
        throw InputError(shown(facts_.file) +
                         " holds floating-point levels: convert it to 16-bit grey");
    cv::Mat picture = is_depth ? decoder_.levels() : decoder_.colour();
    if (picture.empty())
        throw InputError(shown(facts_.file) + " breaks off at " + short_text(time_s_) +
                         " s: record or convert it again");
    if (is_depth && !keeps_levels_) picture = with_bits(picture, decoder_.bits(), facts_.bits);
    return with_square_pixels(picture, pixel_aspect_, role_);
}

void VideoFile::update_facts() {
    const auto known = static_cast<std::int64_t>(times_.size());
    if (!facts_.frames_exact) {
        facts_.frames = std::max(facts_.frames, known);
        if (listed_s_.size() >= 2) return;  // the packets say more
    }
    const double span = times_.back() - times_.front();
    if (known >= 2 && span > 0.0) facts_.frames_per_s = static_cast<double>(known - 1) / span;
    const double last_interval =
        known >= 2 ? times_.back() - times_[times_.size() - 2] : interval_s_;
    const double end_s = times_.back() + last_interval;
    facts_.duration_s = facts_.frames_exact ? end_s : std::max(facts_.duration_s, end_s);
}

/// By its packets; a larger file would take too long to read.
void VideoFile::list_frames() {
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(facts_.file, unknown);
    if (!unknown && bytes <= kQuicklyRead) listed_s_ = picture_times_s();
    const std::size_t count = listed_s_.size();
    if (count < 2) return;
    facts_.frames = static_cast<std::int64_t>(count);
    facts_.frames_per_s = static_cast<double>(count - 1) / (listed_s_.back() - listed_s_.front());
    facts_.duration_s = 2.0 * listed_s_.back() - listed_s_[count - 2];
}

void VideoFile::place_at(double time_s) {
    const auto place_in = [time_s](const std::vector<double>& all_s) {
        return std::lower_bound(all_s.begin(), all_s.end(), time_s - kTimeTolerance_s) -
               all_s.begin();
    };
    index_ = place_in(times_);
    index_exact_ = index_ < static_cast<std::int64_t>(times_.size());
    if (index_exact_) return;
    // Behind a gap: by the packets, else an estimate, until the gap is read.
    const auto listed = static_cast<std::int64_t>(place_in(listed_s_));
    if (listed < static_cast<std::int64_t>(listed_s_.size())) {
        index_ = std::max(listed, index_);
        return;
    }
    const double frames_on = std::round((time_s - times_.back()) * facts_.frames_per_s);
    index_ = static_cast<std::int64_t>(times_.size()) - 1 +
             std::max<std::int64_t>(1, static_cast<std::int64_t>(frames_on));
}

std::optional<TimedPicture> VideoFile::next() {
    if (!ahead_.empty()) {
        TimedPicture first = std::move(ahead_.front());
        ahead_.pop_front();
        return first;
    }
    if (from_ring_ == ring_.size()) count_played();
    if (!grab()) return std::nullopt;
    return taken();
}

/// A step back decodes some pictures forward, too: only after many of them the video plays.
void VideoFile::count_played() {
    if (++played_ > DecodedRing::kMostPictures) ring_.keep_few(true);
}

/// Earlier frames are not converted, and those that no other frame refers to are not decoded.
std::optional<TimedPicture> VideoFile::next_from(double earliest_s) {
    std::optional<TimedPicture> last;  // without a picture: the decoder keeps it
    for (; !ahead_.empty(); ahead_.pop_front()) {
        last = std::move(ahead_.front());
        if (last->time_s < earliest_s) continue;
        ahead_.pop_front();
        return last;
    }
    if (has_times_) decoder_.skip_non_reference_before(earliest_s);
    const std::int64_t from = index_;
    const bool decodes = from_ring_ == ring_.size();
    if (decodes) count_played();
    const auto begin = std::chrono::steady_clock::now();
    while (grab()) {
        if (!(time_s_ < earliest_s)) {
            if (decodes)
                measure_passing(index_ - from - 1, std::chrono::steady_clock::now() - begin);
            return taken();
        }
        decoder_.keep();
        last = timed({});
    }
    if (skipped_until(time_s_)) {  // the last frame of all
        last.reset();
        rewind_before(time_s_, kAllFrames);
        if (run_up_to(std::numeric_limits<double>::infinity(), {})) last = next();
    }
    if (last && last->picture.empty() && !last->video) last = retrieve_kept(std::move(*last));
    return last;
}

/// `taken` includes the decoding of the frame after them.
void VideoFile::measure_passing(std::int64_t frames, std::chrono::duration<double> taken) {
    if (frames < 1 || !(decoding_s_ > 0.0)) return;
    const double each_s = std::max(taken.count() - decoding_s_, 0.0) / static_cast<double>(frames);
    passing_s_ = moving_mean_from_first(passing_s_, each_s);
}

TimedPicture VideoFile::timed(cv::Mat picture) const {
    const double guess_s = (decoder_.marks_non_reference() ? kHalf : 1.0) * decoding_s_;
    return {.picture = std::move(picture),
            .time_s = time_s_,
            .index = index_,
            .decoding_s = passing_s_ > 0.0 ? passing_s_ : guess_s};
}

TimedPicture VideoFile::taken() {
    TimedPicture taken = timed({});
    if (shares_video_ && role_ == PictureRole::colour)
        taken.video = decoder_.shared(pixel_aspect_);
    else if (shares_video_ && is_coded_as_given())
        take_coded(taken);
    if (!taken.video && taken.picture.empty()) taken.picture = retrieve();
    return taken;
}

/// Whether neither bits nor pixels of the levels are changed.
bool VideoFile::is_coded_as_given() const noexcept {
    return !decoder_.has_floats() && decoder_.bits() == facts_.bits && pixel_aspect_ == 1.0;
}

void VideoFile::take_coded(TimedPicture& taken) {
    CodedLevels coded = decoder_.coded_levels();
    taken.picture = std::move(coded.picture);
    taken.level_of_code = std::move(coded.level_of_code);
}

/// Colours also of the pictures that are given out next.
void VideoFile::share_video() {
    if (shares_video_) return;
    shares_video_ = true;
    if (role_ != PictureRole::colour) return;
    if (ahead_.size() == 1 && ahead_.front().index == index_ && !grabbed_)
        ahead_.front() = taken();
    else if (!ahead_.empty())
        seek(ahead_.front().time_s);
}

TimedPicture VideoFile::retrieve_kept(TimedPicture kept) {
    decoder_.swap_kept();
    TimedPicture converted = taken();
    decoder_.swap_kept();
    kept.picture = std::move(converted.picture);
    kept.level_of_code = std::move(converted.level_of_code);
    kept.video = std::move(converted.video);
    return kept;
}

bool VideoFile::jump(double time_s, int most_packets) {
    ring_.clear();
    from_ring_ = 0;
    grabbed_ = false;
    jumped_ = decoder_.jump(time_s, most_packets);
    return jumped_;
}

/// Goes back to the frame shown then, where that and the frame after it are still kept.
bool VideoFile::show_kept(double time_s) {
    const std::optional<std::size_t> place = ring_.place_at(time_s);
    if (!place) return false;
    show(ring_.picture(*place));
    from_ring_ = *place + 1;
    grabbed_ = true;
    ended_ = false;
    return true;
}

void VideoFile::show(const DecodedPicture& kept) {
    decoder_.show_again(*kept.frame);
    time_s_ = kept.time_s;
    index_ = kept.index;
}

void VideoFile::rewind_before(double time_s, double frames_before) {
    const auto jump_to = [&](double to_s) {
        const bool jumps = jump(to_s);
        skip_before(time_s, frames_before);
        return jumps;
    };
    for (double margin_s = 0.25; has_times_ && time_s - margin_s > 0.0; margin_s *= 4.0) {
        if (!jump_to(time_s - margin_s)) break;
        if (!grab()) continue;
        grabbed_ = time_s_ <= time_s;
        if (grabbed_) return;
    }
    if (has_times_ && jump_to(0.0)) {
        grabbed_ = grab() && index_ == 0 && time_s_ >= 0.0;
        if (grabbed_) return;
    }
    reopen();
}

/// Except the last `frames_before`.
void VideoFile::skip_before(double time_s, double frames_before) {
    const double interval_s = std::max(interval_s_, 1.0 / facts_.frames_per_s);
    if (has_times_) decoder_.skip_non_reference_before(time_s - frames_before * interval_s);
}

void VideoFile::seek(double time_s) {
    const double latest_s = facts_.frames_exact ? facts_.duration_s : kLongest_s;
    const double wanted_s = (time_s > 0.0 ? std::min(time_s, latest_s) : 0.0) + kTimeTolerance_s;
    ahead_.clear();
    if (show_kept(wanted_s)) {
        run_up_to(wanted_s, {});
        return;
    }
    const bool near_ahead = !ended_ && time_s_ <= wanted_s && wanted_s < time_s_ + kNearAhead_s;
    const bool near_behind = time_s_ > wanted_s && wanted_s > time_s_ - kNearBehind_s;
    // The frame shown then may begin some frames earlier; the next step back goes to one before.
    const double frames_before =
        near_behind ? std::max(kFewFrames, static_cast<double>(ring_.room())) : kFewFrames;
    if (near_ahead) {
        decoder_.keep();
        skip_before(wanted_s, frames_before);
        if (run_up_to(wanted_s, timed({}))) return;
    } else {
        played_ = 0;
        ring_.keep_few(!near_behind);
        rewind_before(wanted_s, frames_before);
        if (run_up_to(wanted_s, {})) return;
    }
    rewind_before(wanted_s, kAllFrames);
    run_up_to(wanted_s, {});
}

/// Decodes up to `wanted_s`. Converts only the frame shown then, which the decoder keeps, and the
/// frame after it. False: the frame shown then was skipped.
bool VideoFile::run_up_to(double wanted_s, std::optional<TimedPicture> shown_then) {
    while (grab()) {
        const bool beyond = time_s_ > wanted_s;
        if (beyond && skipped_until(wanted_s)) return false;
        if (beyond && shown_then) {
            ahead_.push_back(taken());
            break;
        }
        const auto follower = static_cast<std::size_t>(index_) + 1;
        const bool passed =
            index_exact_ && follower < times_.size() && times_[follower] <= wanted_s;
        if (!passed) {
            decoder_.keep();
            shown_then = timed({});
        }
        if (beyond) break;
    }
    if (ended_ && skipped_until(wanted_s)) return false;
    if (shown_then) ahead_.push_front(retrieve_kept(std::move(*shown_then)));
    return true;
}

/// Whether a frame up to `time_s` was skipped since the last decoded one.
bool VideoFile::skipped_until(double time_s) const {
    return !decoder_.skipped_s().empty() && decoder_.skipped_s().front() <= time_s;
}

/// Gives the key frame before it.
void VideoFile::seek_near(double time_s) {
    ahead_.clear();
    grabbed_ = false;
    if (!has_times_ || !jump(std::max(time_s, 0.0))) return seek(time_s);
    if (!grab()) return seek(time_s);
    ahead_.push_back(taken());
}

void VideoFile::decode_by_device() {
    if (facts_.columns * facts_.rows <= kSmallPixels) return;
    decode_in(open_decoding_device(decoder_.codec_id()));
}

void VideoFile::decode_in(std::shared_ptr<DecodingDevice> device) {
    if (!device) return;
    facts_.decoder = device->name();
    if (!decodes_alike(facts_.file, track_, device)) {
        facts_.decoder = "the processors, as " + facts_.decoder + " cannot decode it to the same";
        return;
    }
    device_ = std::move(device);
    ahead_.clear();
    reopen();
}

void VideoFile::report_device() {
    facts_.decoder =
        "the processors, as " + device_->name() + " failed at " + number_text(time_s_, 1) + " s";
    device_.reset();
}

}  // namespace dibhr
