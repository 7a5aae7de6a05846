// Still pictures and the way from OpenCV's pictures to ours.
#include "core/video/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media.hpp"
#include "core/video/modules/picture_codecs.hpp"

namespace dibhr {

namespace fs = std::filesystem;

double highest_level(int bits) {
    return std::ldexp(1.0, bits) - 1.0;
}

/// The weights of luma sum to one in OpenCV's fixed point, so equal channels keep their level
/// exactly.
cv::Mat grey_of(const cv::Mat& picture) {
    cv::Mat grey;
    if (picture.channels() == 3)
        cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    else if (picture.channels() == 4)
        cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
    else if (picture.channels() == 2)
        cv::extractChannel(picture, grey, 0);
    else
        grey = picture;
    return grey;
}

ColourImage colour_of(const cv::Mat& picture) {
    ColourImage colour;
    colour.columns = picture.cols;
    colour.rows = picture.rows;
    colour.rgb.resize(picture.total() * 3);
    cv::Mat rgb(picture.rows, picture.cols, CV_8UC3, colour.rgb.data());
    cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
    return colour;
}

ColourImage read_colour_picture(const fs::path& file) {
    require_readable(file);
    return colour_of(read_still(file, PictureRole::colour).picture);
}

BumpMap read_bump_map(const fs::path& file) {
    const StillPicture still = read_still(file, PictureRole::depth);
    const cv::Mat& picture = still.picture;
    require_size(file, picture.cols, picture.rows);
    BumpMap bump{picture.cols, picture.rows, std::vector<float>(picture.total())};
    cv::Mat heights(bump.rows, bump.columns, CV_32FC1, bump.heights.data());
    grey_of(picture).convertTo(heights, CV_32F);
    double lowest = 0.0;
    double highest = 0.0;
    const cv::Mat finite = cv::abs(heights) <= std::numeric_limits<float>::max();
    cv::minMaxLoc(heights, &lowest, &highest, nullptr, nullptr, finite);
    heights.setTo(lowest, ~finite);
    const auto low = static_cast<float>(lowest);
    const auto range = static_cast<float>(highest - lowest);
    for (float& height : bump.heights) height = range > 0.0F ? (height - low) / range : 0.0F;
    return bump;
}

std::string png_of(const ColourImage& picture) {
    set_up_libraries();
    const auto bytes =
        static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows) * 3;
    if (bytes == 0 || picture.rgb.size() != bytes) {
        throw InputError("A picture cannot be written: it is empty");
    }
    const cv::Mat rgb(picture.rows, picture.columns, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));  // only read
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    return encoded_png(bgr);
}

namespace {

void write_png_into(OutputFile& out, const ColourImage& picture, const fs::path& file) {
    if (picture.rgb.empty())
        throw InputError(shown(file) + " cannot be written: the picture is empty");
    out.write(png_of(picture));
}

}  // namespace

void write_png(const ColourImage& picture, const fs::path& file) {
    OutputFile out(file);
    write_png_into(out, picture, file);
    out.commit();
}

fs::path write_new_png(const ColourImage& picture, const fs::path& file) {
    OutputFile out(file);
    write_png_into(out, picture, file);
    return out.commit_beside();
}

cv::Mat with_bits(const cv::Mat& picture, int bits_now, int bits) {
    if (bits_now == bits) return picture;
    cv::Mat scaled;
    if (bits_now == kRealBits || bits == kRealBits) {  // no highest level to go by
        picture.convertTo(scaled, CV_32F);
        if (bits == kRealBits) return scaled;
        cv::patchNaNs(scaled, 0.0);
        return cv::min(cv::max(scaled, 0.0), highest_level(bits));
    }
    picture.convertTo(scaled, CV_32F, highest_level(bits) / highest_level(bits_now));
    return scaled;
}

cv::Mat resampleable(const cv::Mat& picture) {
    const double shrink = 1.0 * kMostAlong / std::max(picture.cols, picture.rows);
    if (shrink >= 1.0) return picture;
    cv::Mat smaller;
    cv::resize(picture, smaller, {}, shrink, shrink, cv::INTER_AREA);
    return smaller;
}

cv::Mat with_square_pixels(const cv::Mat& picture, double aspect, PictureRole role) {
    if (aspect == 1.0 || picture.empty()) return picture;
    const cv::Size size(static_cast<int>(std::lround(picture.cols * std::max(aspect, 1.0))),
                        static_cast<int>(std::lround(picture.rows / std::min(aspect, 1.0))));
    cv::Mat between;
    cv::resize(picture, between, size, 0.0, 0.0, cv::INTER_LINEAR);
    if (role == PictureRole::colour) return between;
    const cv::Mat data = grey_of(picture) > 0.0;  // 255 each
    cv::Mat beside_none;
    cv::resize(data, beside_none, size, 0.0, 0.0, cv::INTER_LINEAR);
    cv::Mat nearest;
    cv::resize(picture, nearest, size, 0.0, 0.0, cv::INTER_NEAREST);
    nearest.copyTo(between, beside_none < 255.0);
    return between;
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

ChangedPictures::ChangedPictures(std::unique_ptr<PictureSource> source, Change change, Tell tell)
    : source_(std::move(source)), change_(std::move(change)), tell_(std::move(tell)) {
    first_ = changed(source_->next());
    if (first_) {
        facts_.columns = first_->picture.cols;
        facts_.rows = first_->picture.rows;
    }
    learn();
    require_size(facts_.file, facts_.columns, facts_.rows);
}

void ChangedPictures::learn() {
    const cv::Size size(facts_.columns, facts_.rows);
    facts_ = source_->facts();
    facts_.columns = size.width;
    facts_.rows = size.height;
    tell_(facts_);
}

std::optional<TimedPicture> ChangedPictures::changed(std::optional<TimedPicture> taken) const {
    if (taken) taken->picture = change_(taken->picture);
    return taken;
}

std::optional<TimedPicture> ChangedPictures::next() {
    if (first_) return std::exchange(first_, std::nullopt);
    std::optional<TimedPicture> taken = changed(source_->next());
    learn();
    return taken;
}

std::optional<TimedPicture> ChangedPictures::next_from(double earliest_s) {
    if (first_) return PictureSource::next_from(earliest_s);
    std::optional<TimedPicture> taken = changed(source_->next_from(earliest_s));
    learn();
    return taken;
}

void ChangedPictures::seek(double time_s) {
    first_.reset();
    source_->seek(time_s);
    learn();
}

void ChangedPictures::seek_near(double time_s) {
    first_.reset();
    source_->seek_near(time_s);
    learn();
}

std::vector<cv::Mat> ChangedPictures::samples(int most) {
    first_.reset();
    std::vector<cv::Mat> pictures = source_->samples(most);
    for (cv::Mat& picture : pictures) picture = change_(picture);
    return pictures;
}

void ChangedPictures::count_frames(std::int64_t most) {
    source_->count_frames(most);
    learn();
}

StillFile::StillFile(const std::filesystem::path& file, PictureRole role) {
    StillPicture still = read_still(file, role);
    picture_ = std::move(still.picture);
    facts_.file = file;
    facts_.columns = picture_.cols;
    facts_.rows = picture_.rows;
    facts_.bits = still.bits;
    facts_.channels = picture_.channels();
    facts_.codec = std::move(still.codec);
    facts_.known = std::move(still.known);
    facts_.known_from = std::move(still.known_from);
    facts_.frames = 1;
    facts_.frames_exact = true;
    facts_.still = true;
    require_size(file, facts_.columns, facts_.rows);
}

std::optional<TimedPicture> StillFile::next() {
    if (given_) return std::nullopt;
    given_ = true;
    return TimedPicture{picture_, 0.0, 0};
}

void StillFile::seek(double /*time_s*/) {
    given_ = false;
}

}  // namespace dibhr
