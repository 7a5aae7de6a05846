// Checks every form that may be the depth, and writes the first that fits.
#include "core/estimate/depth_result.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/estimate/depth_video.hpp"
#include "core/estimate/estimator_output.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/modules/picture_codecs.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kMostLevels = 65535.0;

/// Facts of all pictures of one form.
struct Survey {
    std::vector<double> times_s{};
    int columns{0}, rows{0}, bits{0};
    double pixel_aspect{1.0};
    double lowest{std::numeric_limits<double>::infinity()};
    double highest{-std::numeric_limits<double>::infinity()};
};

cv::Mat numbers_of(const cv::Mat& picture) {
    cv::Mat numbers;
    grey_of(picture).convertTo(numbers, CV_32F);
    return numbers;
}

cv::Mat finite_in(const cv::Mat& numbers) {
    return cv::abs(numbers) <= std::numeric_limits<float>::max();
}

void take_in(const TimedPicture& picture, Survey& survey) {
    const cv::Mat numbers = numbers_of(picture.picture);
    const cv::Mat finite = finite_in(numbers);
    survey.times_s.push_back(picture.time_s);
    if (cv::countNonZero(finite) == 0) return;
    double lowest = 0.0;
    double highest = 0.0;
    cv::minMaxLoc(numbers, &lowest, &highest, nullptr, nullptr, finite);
    survey.lowest = std::min(survey.lowest, lowest);
    survey.highest = std::max(survey.highest, highest);
}

std::string size_text(int columns, int rows) {
    return std::to_string(columns) + " x " + std::to_string(rows);
}

/// Width of a pixel divided by its height, where the pictures show all of the colour: 1, except of
/// pictures squeezed to sides that a network needs, as DepthCrafter's. Throws InputError for
/// another shape.
double pixel_aspect_of(const fs::path& file, int columns, int rows, const ColourFrames& colour) {
    constexpr double kMostOff = 0.02;
    constexpr double kMostOff_px = 1.5;  // of small pictures, whose sides are rounded
    constexpr int kSides = 32;           // squeezed sides are multiples of it
    constexpr double kMostSqueezed = 0.12;
    const double wanted_rows = 1.0 * columns * colour.rows / colour.columns;
    const double off = std::fabs(rows - wanted_rows);
    if (off <= kMostOff_px || off <= kMostOff * wanted_rows) return 1.0;
    const bool squeezed = columns % kSides == 0 && rows % kSides == 0 && off <= kSides &&
                          off <= kMostSqueezed * wanted_rows;
    if (squeezed) return rows / wanted_rows;
    throw InputError("the estimator's pictures are of another shape than the colour, " +
                     size_text(columns, rows) + " in " + shown(file.filename()) + " instead of " +
                     size_text(colour.columns, colour.rows) +
                     " or smaller: let it write the depth alone, not cropped");
}

/// Whether it is a video of another rate with the same duration.
bool lasts_as_long(const fs::path& file, const Survey& survey, const ColourFrames& colour) {
    constexpr double kIntervals = 2.0;
    constexpr double kShare = 0.02;
    if (!named_video(file) || survey.times_s.size() < 2) return false;
    const double off_s = std::fabs(survey.times_s.back() - colour.times_s.back());
    return off_s <= std::max(kIntervals * colour.interval_s(), kShare * colour.times_s.back());
}

[[noreturn]] void refuse_count(const fs::path& file, std::size_t count,
                               const ColourFrames& colour) {
    throw InputError("the estimator gave " + std::to_string(count) +
                     (count == 1 ? " picture" : " pictures") + " (" + shown(file.filename()) +
                     ") for the " + std::to_string(colour.count()) + " frames of " +
                     shown(colour.file) + ": let it take every frame");
}

/// Throws InputError where it does not fit. Incomplete when `stop` became true.
Survey surveyed(const DepthOutput& output, const ColourFrames& colour,
                const std::atomic<bool>& stop, const ReportFrames& report) {
    const auto source = output.open();
    const SourceFacts& facts = source->facts();
    const double aspect = pixel_aspect_of(output.file(), facts.columns, facts.rows, colour);
    const bool few = facts.frames_exact && !named_video(output.file()) &&
                     facts.frames != static_cast<std::int64_t>(colour.count());
    if (few) refuse_count(output.file(), static_cast<std::size_t>(facts.frames), colour);
    if (output.is_painted())
        throw InputError("the estimator painted its depth in colours (" +
                         shown(output.file().filename()) +
                         "): let it write grey levels or numbers, often by an option like "
                         "--grayscale");
    Survey survey{
        .columns = facts.columns, .rows = facts.rows, .bits = facts.bits, .pixel_aspect = aspect};
    while (!stop) {
        const auto picture = source->next();
        if (!picture) break;
        take_in(*picture, survey);
        report(survey.times_s.size(), 2 * colour.count());
    }
    if (stop) return survey;
    if (survey.times_s.size() != colour.count() && !lasts_as_long(output.file(), survey, colour))
        refuse_count(output.file(), survey.times_s.size(), colour);
    if (!(survey.highest > survey.lowest))
        throw InputError(
            "the estimator's depth cannot be used: " + shown(output.file().filename()) +
            (std::isfinite(survey.highest) ? " has one level everywhere" : " holds no number") +
            "; try the estimator on a single picture");
    return survey;
}

/// From the numbers of the estimator to levels of a file: (number - zero) / step.
struct LevelRule {
    double zero{0.0}, step{1.0};
    int bits{16};
    bool marks_holes{false};  ///< as level 0
};

/// Relative numbers may be below 0: then the lowest is level 0. Distances have steps of at most a
/// millimetre, so that a far sky does not make near depth coarse.
LevelRule rule_for_numbers(const Survey& survey, DepthUnit unit) {
    constexpr double kMillimetre_m = 0.001;
    LevelRule rule{.marks_holes = true};
    rule.zero = std::min(survey.lowest, 0.0);
    rule.step = (survey.highest - rule.zero) / kMostLevels;
    if (unit == DepthUnit::m) rule.step = std::min(rule.step, kMillimetre_m);
    if (unit == DepthUnit::mm) rule.step = std::min(rule.step, 1.0);
    return rule;
}

LevelRule rule_for(const Survey& survey, DepthUnit unit) {
    if (survey.bits == kRealBits) return rule_for_numbers(survey, unit);
    if (survey.bits <= 8) return {.bits = 8};
    return {.step = highest_level(survey.bits) / kMostLevels};
}

cv::Mat levels_by(const LevelRule& rule, const cv::Mat& picture) {
    const cv::Mat numbers = numbers_of(picture);
    cv::Mat levels;
    numbers.convertTo(levels, CV_64F, 1.0 / rule.step, -rule.zero / rule.step);
    if (rule.marks_holes) {
        levels = cv::max(levels, 1.0);
        levels.setTo(0.0, ~finite_in(numbers));
    }
    cv::Mat whole;
    levels.convertTo(whole, rule.bits == 8 ? CV_8U : CV_16U);  // rounded and clamped
    return whole;
}

/// False when `stop` became true.
bool write_video(PictureSource& source, const LevelRule& rule, const Survey& survey,
                 const ColourFrames& colour, const fs::path& file, const std::atomic<bool>& stop,
                 const ReportFrames& report) {
    const bool frame_by_frame = survey.times_s.size() == colour.count();
    const std::vector<double>& times_s = frame_by_frame ? colour.times_s : survey.times_s;
    OutputFile out(file);
    DepthVideo video(out.written(), {survey.columns, survey.rows, rule.bits, survey.pixel_aspect});
    for (std::size_t k = 0; k < times_s.size(); ++k) {
        const auto picture = source.next();
        if (stop || !picture) return false;
        const std::size_t next = std::min(k + 1, times_s.size() - 1);
        const double interval_s = next > k ? times_s[next] - times_s[k] : colour.interval_s();
        video.add(levels_by(rule, picture->picture), colour.start_s + times_s[k], interval_s);
        report(times_s.size() + k + 1, 2 * times_s.size());
    }
    video.finish();
    out.commit();
    return true;
}

}  // namespace

DepthWritten write_depth(const fs::path& output, const ColourFrames& colour, DepthUnit unit,
                         const fs::path& target, const std::atomic<bool>& stop,
                         const ReportFrames& report) {
    std::string refusal;
    for (const DepthOutput& form : depth_outputs(output)) {
        try {
            const Survey survey = surveyed(form, colour, stop, report);
            if (stop) return {};
            const LevelRule rule = rule_for(survey, unit);
            const auto source = form.open();
            const fs::path file = target / (colour.still ? "depth.png" : "depth.mkv");
            if (colour.still)
                write_file(
                    file, encoded_png(with_square_pixels(levels_by(rule, source->next()->picture),
                                                         survey.pixel_aspect, PictureRole::depth)));
            else if (!write_video(*source, rule, survey, colour, file, stop, report))
                return {};
            DepthStatement levels{.scale = rule.step};
            if (rule.marks_holes) levels.no_data = std::vector<double>{0.0};
            return {file, levels};
        } catch (const InputError& error) {
            const std::string why = error.what();
            const bool own = why.starts_with("the ");
            if (refusal.empty())
                refusal = (own ? "" : "the estimator's depth cannot be read: ") + why;
        }
    }
    if (refusal.empty())
        refusal =
            "the estimator left no depth: there is neither a picture nor an array nor a video in "
            "its {output}; check whether its command says where to write";
    throw InputError(refusal);
}

}  // namespace dibhr
