// What sources of pictures have in common.
#include "core/video/formats/picture_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

void add_clause(std::string& notice, const std::string& clause) {
    if (clause.empty() || notice.find(clause) != std::string::npos) return;
    notice += (notice.empty() ? "" : "; ") + clause;
}

std::string_view name_of(TimesFrom value) noexcept {
    constexpr std::array<std::string_view, 6> kNames{"file",  "names",  "list",
                                                     "other", "stated", "assumed"};
    return kNames[static_cast<std::size_t>(value)];
}

bool is_rising(const std::vector<double>& times_s) {
    return std::all_of(times_s.begin(), times_s.end(),
                       [](double time_s) { return std::isfinite(time_s); }) &&
           std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal<>()) ==
               times_s.end();
}

Timing assumed_timing() {
    return {.from = TimesFrom::assumed,
            .text = "assumed: " + short_text(kPicturesPerSecond) + " frames a second"};
}

std::optional<TimedPicture> PictureSource::next_from(double earliest_s) {
    return first_from(earliest_s, *this, &TimedPicture::time_s);
}

std::vector<cv::Mat> PictureSource::samples(int most) {
    std::vector<cv::Mat> pictures;
    const auto count = std::clamp<std::int64_t>(facts().frames, 1, most);
    for (std::int64_t k = 0; k < count; ++k) {
        seek(facts().duration_s * static_cast<double>(k) / static_cast<double>(count));
        if (auto picture = next()) pictures.push_back(std::move(picture->picture));
    }
    seek(0.0);
    return pictures;
}

void SourceFacts::take_progress(const SourceFacts& read) {
    duration_s = read.duration_s;
    frames_per_s = read.frames_per_s;
    frames = read.frames;
    frames_exact = read.frames_exact;
    trouble = read.trouble;
}

ChangedPictures::ChangedPictures(std::unique_ptr<PictureSource> source, Change change,
                                 const ChangeFacts& change_facts)
    : source_(std::move(source)), change_(std::move(change)) {
    first_ = changed(source_->next());
    facts_ = source_->facts();
    const cv::Size size = first_ ? first_->picture.size() : cv::Size();
    facts_.columns = size.width;
    facts_.rows = size.height;
    change_facts(facts_);
    require_size(facts_.file, facts_.columns, facts_.rows);
}

std::optional<TimedPicture> ChangedPictures::changed(std::optional<TimedPicture> taken) const {
    if (taken) taken->picture = change_(taken->picture);
    return taken;
}

std::optional<TimedPicture> ChangedPictures::next() {
    if (first_) return std::exchange(first_, std::nullopt);
    std::optional<TimedPicture> taken = changed(source_->next());
    facts_.take_progress(source_->facts());
    return taken;
}

std::optional<TimedPicture> ChangedPictures::next_from(double earliest_s) {
    if (first_) return PictureSource::next_from(earliest_s);
    std::optional<TimedPicture> taken = changed(source_->next_from(earliest_s));
    facts_.take_progress(source_->facts());
    return taken;
}

void ChangedPictures::seek(double time_s) {
    first_.reset();
    source_->seek(time_s);
    facts_.take_progress(source_->facts());
}

void ChangedPictures::seek_near(double time_s) {
    first_.reset();
    source_->seek_near(time_s);
    facts_.take_progress(source_->facts());
}

std::vector<cv::Mat> ChangedPictures::samples(int most) {
    first_.reset();
    std::vector<cv::Mat> pictures = source_->samples(most);
    for (cv::Mat& picture : pictures) picture = change_(picture);
    return pictures;
}

void ChangedPictures::count_frames(std::int64_t most) {
    source_->count_frames(most);
    facts_.take_progress(source_->facts());
}

void IndexedPictures::take_times(std::vector<double> times_s) {
    times_s_ = std::move(times_s);
    facts_.start_s = times_s_.front();
    for (double& time_s : times_s_) time_s -= facts_.start_s;
    facts_.frames = static_cast<std::int64_t>(times_s_.size());
    facts_.frames_exact = true;
    facts_.still = facts_.frames == 1;
    if (facts_.still) return;
    const double interval_s = times_s_.back() / static_cast<double>(facts_.frames - 1);
    facts_.frames_per_s = 1.0 / interval_s;
    facts_.duration_s = times_s_.back() + interval_s;
    facts_.timing.nominal_per_s = facts_.frames_per_s;
}

void IndexedPictures::report_trouble(const std::string& what) {
    if (facts_.trouble.empty())
        facts_.trouble = what + "; until then the picture before it is shown";
}

std::optional<TimedPicture> IndexedPictures::next() {
    if (at_ == times_s_.size()) return std::nullopt;
    const std::size_t at = at_++;
    return TimedPicture{picture(at), times_s_[at], static_cast<std::int64_t>(at)};
}

void IndexedPictures::seek(double time_s) {
    const auto later =
        std::upper_bound(times_s_.begin(), times_s_.end(), time_s + kTimeTolerance_s);
    at_ = later == times_s_.begin() ? 0 : static_cast<std::size_t>(later - times_s_.begin()) - 1;
}

}  // namespace dibhr
