// Ranks, a line, a factor, and which of the truth's frames is shown.
#include "tests/core/video/zoo/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test::zoo {

namespace {

constexpr double kLeastCorrelation = 0.99;
constexpr double kMostBend_pct = 5.0;
constexpr double kMostScale_pct = 1.0;
constexpr double kMostFrames = 0.51;    ///< colour and depth half a frame apart, and rounding
constexpr double kMostMissing = 0.1;    ///< of the pixels with data
constexpr double kMostInvented = 0.05;  ///< of the pixels without
constexpr double kFarthest = 0.02;      ///< an elevation that is no more than this is far
constexpr double kLeastColour = 0.8;    ///< correlation of the colour picture
constexpr double kLeastBetween = 0.9;   ///< correlation of ranks between the pixels of a LiDAR
constexpr std::size_t kMostRead = 200;

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of Pearson; 0 where one of them is the same everywhere.
double correlation_of(std::span<const double> a, std::span<const double> b) {
    const double mean_a = mean_of(a);
    const double mean_b = mean_of(b);
    double both = 0.0;
    double squares_a = 0.0;
    double squares_b = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        both += (a[k] - mean_a) * (b[k] - mean_b);
        squares_a += (a[k] - mean_a) * (a[k] - mean_a);
        squares_b += (b[k] - mean_b) * (b[k] - mean_b);
    }
    const double product = squares_a * squares_b;
    return product > 0.0 ? both / std::sqrt(product) : 0.0;
}

/// Equal values share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin;
        while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
        for (std::size_t k = begin; k < end; ++k)
            ranks[order[k]] = 0.5 * static_cast<double>(begin + end - 1);
        begin = end;
    }
    return ranks;
}

/// The root mean square of the elevations from the line that fits them best, in percent of theirs
/// from the lowest to the highest.
double bend_of(const std::vector<double>& farness, const std::vector<double>& elevations) {
    if (farness.size() < 3) return kNotMeasured;
    const auto [lowest, highest] = std::minmax_element(elevations.begin(), elevations.end());
    const double correlation = correlation_of(farness, elevations);
    const double mean = mean_of(elevations);
    double squares = 0.0;
    for (const double elevation : elevations) squares += (elevation - mean) * (elevation - mean);
    const double rest = squares * (1.0 - correlation * correlation);
    const double rms = std::sqrt(std::max(rest, 0.0) / static_cast<double>(elevations.size()));
    return *highest > *lowest ? 100.0 * rms / (*highest - *lowest) : kNotMeasured;
}

/// An elevation, 0 to 1, of each pixel; NaN: no data.
cv::Mat elevations_of(const DepthImage& depth) {
    cv::Mat levels(depth.rows, depth.columns, CV_32FC1);
    for (int j = 0; j < depth.rows; ++j)
        for (int i = 0; i < depth.columns; ++i) levels.at<float>(j, i) = depth.at(i, j);
    return levels * (1.0 / depth.highest_level);
}

cv::Mat grey_of_colour(const ColourImage& colour) {
    cv::Mat grey(colour.rows, colour.columns, CV_8UC1);
    const std::uint8_t* rgb = colour.rgb.data();
    for (int j = 0; j < grey.rows; ++j)
        for (int i = 0; i < grey.cols; ++i, rgb += 3)
            grey.at<std::uint8_t>(j, i) = static_cast<std::uint8_t>((rgb[0] + rgb[1] + rgb[2]) / 3);
    return grey;
}

cv::Mat grey_of_truth(const cv::Mat& bgr) {
    std::vector<cv::Mat> channels;
    cv::split(bgr, channels);
    return channels[0] / 3.0 + channels[1] / 3.0 + channels[2] / 3.0;
}

/// The same picture in another size.
cv::Mat in_size(const cv::Mat& picture, cv::Size size, int how) {
    if (picture.size() == size) return picture;
    cv::Mat sized;
    cv::resize(picture, sized, size, 0.0, 0.0, how);
    return sized;
}

/// Pixel by pixel, what both have.
struct Compared {
    std::vector<double> farness{};
    std::vector<double> elevations{};
    double missing{0.0};   ///< share of the pixels with data that have no elevation
    double invented{0.0};  ///< share of those without data that have one
};

Compared compared(const cv::Mat& truth, const cv::Mat& elevations) {
    const cv::Mat farness = in_size(truth, elevations.size(), cv::INTER_NEAREST);
    Compared all;
    double with_data = 0.0;
    double without = 0.0;
    for (int j = 0; j < farness.rows; ++j) {
        for (int i = 0; i < farness.cols; ++i) {
            const double far = static_cast<double>(farness.at<float>(j, i));
            const double elevation = static_cast<double>(elevations.at<float>(j, i));
            const bool has = std::isfinite(elevation);
            if (std::isfinite(far)) {
                with_data += 1.0;
                all.missing += has ? 0.0 : 1.0;
                if (!has) continue;
                all.farness.push_back(far);
                all.elevations.push_back(elevation);
            } else {
                without += 1.0;
                all.invented += has ? 1.0 : 0.0;
            }
        }
    }
    all.missing /= std::max(with_data, 1.0);
    all.invented /= std::max(without, 1.0);
    return all;
}

/// The correlation of the ranks of elevation and nearness.
double order_of(const Compared& all) {
    return -correlation_of(ranks_of(all.farness), ranks_of(all.elevations));
}

/// Whether pixels without data are nowhere higher than the farthest.
bool is_far_without_data(const cv::Mat& truth, const cv::Mat& elevations) {
    const cv::Mat farness = in_size(truth, elevations.size(), cv::INTER_NEAREST);
    const cv::Mat without = ~(farness == farness);
    const cv::Mat high = elevations > kFarthest;
    return cv::countNonZero(without & high) <= kMostInvented * cv::countNonZero(without);
}

/// Which picture of the truth is most like the shown one, of one channel, or with `sign` -1 like
/// its negative; `best`: their correlation.
std::size_t most_alike(const Pictures& truth, const cv::Mat& shown, double sign, double& best) {
    std::size_t found = 0;
    best = -2.0;
    cv::Mat other;
    shown.convertTo(other, CV_32F);
    for (std::size_t k = 0; k < truth.size(); ++k) {
        cv::Mat numbers;
        in_size(truth[k], shown.size(), cv::INTER_AREA).convertTo(numbers, CV_32F);
        std::vector<double> a;
        std::vector<double> b;
        for (int j = 0; j < other.rows; ++j) {
            for (int i = 0; i < other.cols; ++i) {
                const double one = static_cast<double>(numbers.at<float>(j, i));
                const double two = static_cast<double>(other.at<float>(j, i));
                if (!std::isfinite(one) || !std::isfinite(two)) continue;
                a.push_back(one);
                b.push_back(sign * two);
            }
        }
        const double alike = a.size() < 2 ? -1.0 : correlation_of(a, b);
        if (alike <= best) continue;
        best = alike;
        found = k;
    }
    return found;
}

/// By how many percent the distances of the elevations are off, in the middle of all.
double scale_error_of(const DepthMeaning& meaning, const Compared& all) {
    const double one_mm = meaning.unit.value == DepthUnit::m ? 1000.0 : 1.0;
    std::vector<double> ratios;
    for (std::size_t k = 0; k < all.farness.size(); ++k) {
        const double elevation = all.elevations[k];
        if (elevation <= 0.0 || elevation >= 1.0) continue;  // beyond the range
        ratios.push_back(one_mm * value_at(meaning, elevation) / (1000.0 * all.farness[k]));
    }
    if (ratios.empty()) return kNotMeasured;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return 100.0 * std::abs(*middle - 1.0);
}

void keep_greater(double& kept, double value) {
    if (std::isfinite(value) && !(kept > value)) kept = value;
}

/// Keeps the first reason.
void fail(Verdict& verdict, const std::string& why) {
    verdict.outcome = Outcome::wrong;
    if (verdict.remark.empty()) verdict.remark = why;
}

void judge_surface(const Truth& truth, const cv::Mat& farness, const cv::Mat& elevations,
                   const MediaDescription& media, Verdict& verdict) {
    const Compared all = compared(farness, elevations);
    if (all.missing > kMostMissing) fail(verdict, "data taken for none");
    const bool may_have =
        !truth.between.empty() || (truth.sky && is_far_without_data(farness, elevations));
    if (all.invented > kMostInvented && !may_have) fail(verdict, "no data taken for depth");
    if (all.farness.size() < 10) return fail(verdict, "nothing to feel");
    const double correlation = order_of(all);
    if (!(verdict.correlation < correlation)) verdict.correlation = correlation;
    if (correlation < kLeastCorrelation)
        fail(verdict, correlation < 0.0 ? "inside out" : "out of order");
    std::vector<double> farness_inside;
    std::vector<double> inside_range;
    for (std::size_t k = 0; k < all.farness.size(); ++k) {
        if (all.elevations[k] <= 0.0 || all.elevations[k] >= 1.0) continue;
        farness_inside.push_back(all.farness[k]);
        inside_range.push_back(all.elevations[k]);
    }
    const double bend_pct = bend_of(farness_inside, inside_range);
    keep_greater(verdict.bend_pct, bend_pct);
    if (truth.knows != Knows::order && bend_pct > kMostBend_pct) fail(verdict, "bent");
    const bool claims = media.meaning && media.meaning->is_metric();
    if (truth.measure == Measure::relative && claims)
        fail(verdict, "distances claimed of relative values");
    if (truth.measure != Measure::metres) return;
    if (claims) {
        keep_greater(verdict.scale_pct, scale_error_of(*media.meaning, all));
        if (verdict.scale_pct > kMostScale_pct) fail(verdict, "wrong distances");
    } else if (truth.knows == Knows::metric) {
        fail(verdict, "distances not found");
    }
}

/// The cleaned surface of sparse depth is near where the whole one is, also between its pixels.
void judge_between(const Brought& brought, const DepthStatement& stated, Verdict& verdict) {
    if (brought.truth.between.empty()) return;
    FrameReader reader(
        open_media(brought.place, brought.depth, {.find_out = true, .command_line = stated}));
    const auto frame = reader.at(0.0);
    if (!frame || !frame->depth) return fail(verdict, "no surface");
    if (order_of(compared(brought.truth.between, elevations_of(*frame->depth))) < kLeastBetween)
        fail(verdict, "not felt between its pixels");
}

void judge_colour(const Truth& truth, const RawFrame& frame, std::size_t at, Verdict& verdict) {
    if (truth.colour.empty()) return;
    if (frame.colour.rgb.empty()) return fail(verdict, "no colour");
    const Pictures grey = each(truth.colour, grey_of_truth);
    const cv::Mat shown =
        in_size(grey_of_colour(frame.colour), grey.front().size(), cv::INTER_AREA);
    double alike = 0.0;
    const std::size_t found = most_alike(grey, shown, 1.0, alike);
    if (alike < kLeastColour) fail(verdict, "another picture as colour");
    if (truth.times_s.empty() && found != at) fail(verdict, "colour of another frame");
}

/// At random times: the depth shown then, and the colour of that depth.
void judge_times(const Truth& truth, Media& media, Verdict& verdict) {
    if (truth.times_s.size() < 2) return;
    const double interval_s = (truth.times_s.back() - truth.times_s.front()) /
                              static_cast<double>(truth.times_s.size() - 1);
    const Pictures colour = each(truth.colour, grey_of_truth);
    std::mt19937 random(41);
    double worst = 0.0;
    for (int trial = 0; trial < 10; ++trial) {
        const double at_s =
            std::uniform_real_distribution(0.0, truth.times_s.back() + interval_s)(random);
        media.seek(at_s);
        const auto frame = media.next();
        if (!frame) return fail(verdict, "no frame at a time");
        const auto after =
            std::upper_bound(truth.times_s.begin(), truth.times_s.end(), at_s + 5e-4);
        const double expected_s = *std::prev(after);
        double alike = 0.0;
        const double shown_s =
            truth.times_s[most_alike(truth.farness, elevations_of(frame->depth), -1.0, alike)];
        worst = std::max(worst, std::abs(shown_s - expected_s) / interval_s);
        if (colour.empty() || frame->colour.rgb.empty()) continue;
        const cv::Mat shown =
            in_size(grey_of_colour(frame->colour), colour.front().size(), cv::INTER_AREA);
        const double colour_s = truth.colour_times_s[most_alike(colour, shown, 1.0, alike)];
        worst = std::max(worst, std::abs(colour_s - shown_s) / interval_s);
    }
    verdict.timing_frames = worst;
    if (worst > kMostFrames) fail(verdict, "at another time");
}

void judge_opened(const Truth& truth, Media& media, Verdict& verdict) {
    std::vector<RawFrame> frames;
    while (frames.size() < kMostRead) {
        auto frame = media.next();
        if (!frame) break;
        frames.push_back(std::move(*frame));
    }
    if (truth.farness.empty()) return fail(verdict, "opened, though it holds nothing");
    verdict.outcome = Outcome::right;
    if (frames.size() != truth.farness.size())
        return fail(verdict, std::to_string(frames.size()) + " frames of " +
                                 std::to_string(truth.farness.size()));
    for (const std::size_t at : {std::size_t{0}, frames.size() / 2, frames.size() - 1}) {
        judge_surface(truth, truth.farness[at], elevations_of(frames[at].depth),
                      media.description(), verdict);
        judge_colour(truth, frames[at], at, verdict);
    }
    judge_times(truth, media, verdict);
}

/// As opened with what a person states.
Verdict judge_with(const Brought& brought, const DepthStatement& stated) {
    Verdict verdict;
    const auto media =
        open_media(brought.place, brought.depth, {.find_out = true, .command_line = stated});
    judge_opened(brought.truth, *media, verdict);
    if (verdict.outcome == Outcome::right) judge_between(brought, stated, verdict);
    return verdict;
}

/// Asked truly: one of the answers that are offered is right.
Verdict judge_answers(const Brought& brought, const std::vector<DepthAlternative>& answers) {
    Verdict likeliest;
    for (const DepthAlternative& answer : answers) {
        Verdict verdict = judge_with(brought, answer.statement);
        if (verdict.outcome == Outcome::right) {
            verdict.outcome = Outcome::asked;
            return verdict;
        }
        if (likeliest.remark.empty()) likeliest = verdict;
    }
    likeliest.remark = "asked, and no answer is right: " + likeliest.remark;
    return likeliest;
}

/// Whether what cannot be read is refused by its name, and not in misleading words.
bool is_refused_truly(const Truth& truth, const std::string& line) {
    if (truth.refused_as.empty()) return false;
    const std::string words = lower_case(line);
    for (const char* const misleading :
         {"cut off", "damaged", "holds text", "needs a depth file"}) {
        if (words.find(misleading) != std::string::npos) return false;
    }
    return words.find(lower_case(truth.refused_as)) != std::string::npos &&
           words.find(": ") != std::string::npos;
}

}  // namespace

std::string name_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::right:
            return "right";
        case Outcome::asked:
            return "asked";
        case Outcome::refused:
            return "refused";
        case Outcome::wrong:
            return "wrong";
    }
    return {};
}

Verdict judge(const Form& form) {
    const TemporaryFolder folder;
    Verdict verdict;
    Truth truth;
    try {
        fs::create_directory(folder / "scan");
        const Brought brought = form.bring(folder / "scan");
        truth = brought.truth;
        const auto answers = open_media(brought.place, brought.depth, {.find_out = true})
                                 ->description()
                                 .conclusion.alternatives;
        verdict = answers.empty() ? judge_with(brought, {}) : judge_answers(brought, answers);
    } catch (const InputError& error) {
        verdict.outcome = is_refused_truly(truth, error.what()) ? Outcome::refused : Outcome::wrong;
        verdict.remark = error.what();
        const std::string path = folder.path().string() + "/scan";
        for (auto at = verdict.remark.find(path); at != std::string::npos;
             at = verdict.remark.find(path))
            verdict.remark.erase(at, path.size());
    } catch (const std::exception& error) {
        fail(verdict, std::string("exception: ") + error.what());
    }
    verdict.form = form.name;
    return verdict;
}

}  // namespace dibhr::test::zoo
