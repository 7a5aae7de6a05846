// Opens and describes media.
#include "core/video/sources/media.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/cleaning/sparse_meter.hpp"
#include "core/video/depth/depth_guess.hpp"
#include "core/video/depth/texture_slope.hpp"
#include "core/video/sources/coded_levels.hpp"
#include "core/video/sources/depth_finding.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/layouts/layouts.hpp"
#include "core/video/sources/live_source.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/pair_times.hpp"
#include "core/video/sources/paired_media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kPaperRelief = 255.0 / 720.0;  ///< of the width
/// Half of a still's slopes may be steeper: 45 degrees, where a bump map still looks like one.
constexpr double kMostSlope = 1.0;
constexpr double kPaperWidth_mm = 101.6;
constexpr std::int64_t kMostCounted = 3000;  ///< frames decoded to describe a video exactly

/// Calls `open(request, notice)` with the kept choice. Where that fails, because the choice cannot
/// be parsed or no longer fits, calls it without the choice, and with a notice that says so.
template <typename Open>
auto opened(const DepthRequest& request, const Open& open) {
    try {
        return open(request, std::string());
    } catch (const InputError& error) {
        if (!is_folder(request.kept_in)) throw;
        DepthRequest without = request;
        without.kept_in.clear();
        return open(without, std::string("what was chosen for this file before is ignored: ") +
                                 error.what());
    }
}

/// The middle of a sample picture, as large as measuring needs it.
DepthImage middle_of(const cv::Mat& picture, const DepthScale& scale) {
    constexpr int kMeasuredSide_px = 2048;
    const cv::Size size(std::min(picture.cols, kMeasuredSide_px),
                        std::min(picture.rows, kMeasuredSide_px));
    const cv::Point corner((picture.cols - size.width) / 2, (picture.rows - size.height) / 2);
    return scale.image_of(picture(cv::Rect(corner, size)));
}

/// The share of the pixels with data where they are sparse, by the first picture; where that has
/// hardly any data, by some from all over the source.
std::optional<double> sparse_share_of(PictureSource& depth, const DepthScale& scale) {
    const int side_px = std::min(depth.facts().columns, depth.facts().rows);
    if (scale.is_always_data() || !scale.meaning() || side_px < SparseMeter::kLeastSide_px)
        return std::nullopt;
    SparseMeter meter;
    for (const int count : {1, 8}) {
        if (meter.has_measured()) break;
        for (const cv::Mat& picture : depth.samples(count)) meter.add(middle_of(picture, scale));
    }
    return meter.sparse_share();
}

/// Of a still.
std::optional<double> texture_slope_of(PictureSource& depth, const DepthScale& scale) {
    if (!depth.facts().still) return std::nullopt;
    const std::vector<cv::Mat> pictures = depth.samples(1);
    return pictures.empty() ? std::nullopt : texture_slope(middle_of(pictures.front(), scale));
}

std::unique_ptr<PairedMedia> media_of(Sources sources, const DepthStatement& statement,
                                      const DepthRequest& asked, bool seen,
                                      const std::string& notice) {
    decode_levels(sources, statement, asked.find_out);
    if (asked.find_out && !sources.not_depth.empty()) throw InputError(sources.not_depth);
    if (asked.find_out) add_camera_beside(sources);
    const DepthRequest request = with_kept_choice(asked, sources.depth->facts().file);
    FoundScale found = find_scale(sources, request);
    const std::optional<double> sparse_share = sparse_share_of(*sources.depth, found.scale);
    const std::optional<double> slope = texture_slope_of(*sources.depth, found.scale);
    const bool painted = seen && request.paints && sources.colour == nullptr;
    const PairTimes times =
        pair_times(sources, found.scale.meaning().value_or(DepthMeaning{}), request.find_out);
    auto media = std::make_unique<PairedMedia>(std::move(sources.depth), std::move(sources.colour),
                                               std::move(found.scale), painted, times);
    if (request.find_out)
        std::ranges::copy(times.findings, std::back_inserter(found.conclusion.findings));
    media->set_conclusion(std::move(found.conclusion));
    media->add_notice(sources.notice);
    if (sparse_share) media->set_sparse(*sparse_share);
    media->set_texture_slope(slope);
    media->add_notice(notice);
    media->set_panel_statement(request.panel);
    media->set_prepared_in(request.prepared_in);
    media->set_live_feed(std::move(sources.live));
    return media;
}

/// The place of a pair's depth as names tell it, for statements that the opening itself needs.
fs::path depth_of_pair(const fs::path& colour, const fs::path& depth) {
    if (any_live(colour, depth)) return depth.empty() ? colour : depth;
    if (colour.empty()) return depth_place_for(depth);
    const MediaPlaces places = places_for(colour, depth);
    if (!places.depth.empty()) return places.depth;
    std::string ignored;
    return find_depth_beside(places.colour, ignored).value_or(places.colour);
}

/// The sources of a live pair, of depth alone, or of files.
Sources sources_of(const fs::path& colour, const fs::path& depth, const DepthStatement& statement,
                   const DepthRequest& request) {
    if (any_live(colour, depth)) return find_live_sources(colour, depth, statement, request.live);
    return colour.empty() ? find_depth(depth, statement) : find_sources(colour, depth, statement);
}

/// What persons state of a place, and its sidecar.
DepthStatement statement_at(const fs::path& place, const DepthRequest& request) {
    const MediaPlaces places =
        is_live(place) ? MediaPlaces{.colour = place} : places_for(place, {});
    return statement_for(places.depth.empty() ? places.colour : places.depth, place, request);
}

/// Adds the colour of the other place to depth alone, where that place holds colour alone.
void add_colour(const fs::path& other, const DepthRequest& request, Sources& sources) {
    if (other.empty() || is_live(other) || sources.colour) return;
    try {
        Sources found = find_content(other, statement_at(other, request));
        if (!found.depth && found.not_depth.empty()) sources.colour = std::move(found.colour);
    } catch (const InputError&) {
        return;  // the description of that place says why
    }
}

/// Of colour alone.
MediaDescription described_colour(const Sources& sources) {
    sources.colour->count_frames(kMostCounted);
    MediaDescription description;
    describe_colour(sources.colour->facts(), description);
    describe_time(sources.colour->facts(), description);
    describe_timing(sources.colour->facts(), description);
    description.notice = sources.colour->facts().notice;
    return description;
}

MediaDescription described(const fs::path& place, const fs::path& other,
                           const DepthRequest& request, const std::string& notice) {
    const DepthStatement statement = statement_at(place, request);
    Sources sources =
        is_live(place) ? sources_of(place, {}, statement, request) : find_content(place, statement);
    if (sources.depth == nullptr) return described_colour(sources);
    const bool is_of_depth = sources.colour == nullptr;
    if (!sources.depth->facts().live) add_colour(other, request, sources);
    decode_levels(sources, statement, request.find_out);
    const std::vector<cv::Mat> pictures = sample_pictures(*sources.depth);
    const auto media = media_of(std::move(sources), statement, request, false, notice);
    media->count_frames(kMostCounted);
    MediaDescription description = media->description();
    if (is_of_depth) {
        description.colour_path.clear();
        description.colour_codec.clear();
        description.colour_columns = description.colour_rows = 0;
    }
    description.levels_used = levels_used(pictures);
    if (description.meaning) {
        SampledLevels levels(pictures, description.depth_bits);
        levels.leave_out(description.meaning->no_data.value);
        description.holes_share = levels.holes_share();
    }
    return description;
}

bool has_scale(const DepthStatement& answer) {
    return answer.scale.value_or(1.0) != 1.0;
}

std::string scale_text(const DepthStatement& answer) {
    constexpr int kDigits = 7;
    return short_text(answer.scale.value_or(1.0), kDigits);
}

/// How a person states near, or unit and scale, of an answer: "--near dark", "near = \"dark\"".
std::string stated_text(const DepthStatement& answer, bool is_near, StatedBy way) {
    const auto fact = [way](const char* option, const char* key, const std::string& value) {
        return way == StatedBy::options ? std::string(option) + ' ' + value
                                        : std::string(key) + " = " + value;
    };
    const auto word = [way](std::string_view name) {
        return way == StatedBy::options ? std::string(name) : '"' + std::string(name) + '"';
    };
    if (is_near) return fact("--near", "near", word(name_of(*answer.near)));
    const std::string unit = fact("--depth-unit", "unit", word(name_of(*answer.unit)));
    if (!has_scale(answer)) return unit;
    return unit + (way == StatedBy::options ? " " : ", ") +
           fact("--depth-scale", "scale", scale_text(answer));
}

}  // namespace

std::optional<RawFrame> Media::next_from(double earliest_s) {
    return first_from(earliest_s, *this, &RawFrame::media_s);
}

std::string doubt_about(const MediaDescription& media, StatedBy way) {
    const DepthConclusion& conclusion = media.conclusion;
    if (conclusion.alternatives.empty()) return {};
    const bool is_near =
        conclusion.near_sure < kSureEnough || conclusion.near_sure <= conclusion.unit_sure;
    const double sure = is_near ? conclusion.near_sure : conclusion.unit_sure;
    std::vector<std::string> ways;
    for (const DepthAlternative& answer : conclusion.alternatives) {
        std::string text = stated_text(answer.statement, is_near, way);
        if (std::find(ways.begin(), ways.end(), text) == ways.end())
            ways.push_back(std::move(text));
    }
    const DepthStatement& best = conclusion.alternatives.front().statement;
    std::string assumed = is_near ? "near is assumed to be " + std::string(name_of(*best.near))
                                  : "the unit is assumed to be " + std::string(name_of(*best.unit));
    if (!is_near && has_scale(best)) assumed += " and the scale " + scale_text(best);
    constexpr double kPercent = 100.0;
    const std::string doubt =
        conclusion.doubt.empty() ? "" : conclusion.doubt + ", so it may be no depth; ";
    return shown(media.depth_path) + ": " + doubt + assumed + " (" +
           number_text(kPercent * sure, 0) + " % sure): look at it, or " +
           (way == StatedBy::options ? "say " + listed(ways, " or ")
                                     : "state " + listed(ways, " or ") + " in its sidecar " +
                                           shown(sidecar_of(media.depth_path))) +
           (doubt.empty() ? "" : ", or give the file of the depth");
}

std::string motion_trouble(const MediaDescription& media) {
    if (media.still) return {};
    if (media.colour_path.empty())
        return "without colour, motion is seen at the depth's outlines alone";
    if (media.colour_still) return "the colour is a still picture: no motion is seen in it";
    if (media.live) return {};
    const double rate = media.colour_frames_per_s;
    constexpr double kSameRate = 0.95;
    if (rate > 0.0 && rate < kSameRate * media.frames_per_s)
        return "the colour has " + short_text(rate, 3) + " pictures a second and the depth " +
               short_text(media.frames_per_s, 3) + ": motion looks jerky";
    const double after_s = media.colour_duration_s;
    const double frame_s = media.frames_per_s > 0.0 ? 1.0 / media.frames_per_s : 0.0;
    if (after_s > 0.0 && after_s + 2.0 * frame_s < media.duration_s)
        return "the colour ends after " + short_text(after_s, 3) + " s, the depth after " +
               short_text(media.duration_s, 3) + " s: no motion is seen in between";
    return {};
}

Fit fit_of(const MediaDescription& media) {
    if (media.true_fit) return *media.true_fit;
    const double columns = std::max(media.depth_columns, 2);
    const double paper_px = kPaperRelief * columns;
    const double slope = media.texture_slope.value_or(0.0) * paper_px;
    return {paper_px / std::max(slope / kMostSlope, 1.0), kPaperWidth_mm / columns};
}

CleaningOptions cleaning_on(const MediaDescription& media, CleaningOptions asked) {
    if (asked.preset != CleaningPreset::automatic || !media.meaning) return asked;
    const CleaningChoice& statement = media.meaning->cleaning.value;
    return {.preset = statement.preset, .own = statement.own, .finger = asked.finger};
}

double finger_mm_on(const MediaDescription& media, double asked_mm) {
    if (asked_mm > 0.0 || !media.meaning) return asked_mm;
    return media.meaning->finger_mm.value;
}

std::unique_ptr<Media> open_media(const fs::path& colour, const fs::path& depth,
                                  const DepthRequest& asked) {
    return opened(asked, [&](const DepthRequest& request, const std::string& notice) {
        const DepthStatement statement =
            statement_for(depth_of_pair(colour, depth), colour, request);
        auto media = media_of(sources_of(colour, depth, statement, request), statement, request,
                              true, notice);
        if (request.decoder == Decoder::automatic) media->decode_by_device();
        return media;
    });
}

std::unique_ptr<Media> open_depth(const fs::path& place, const DepthRequest& asked) {
    return opened(asked, [&](const DepthRequest& request, const std::string& notice) {
        const fs::path depth = is_live(place) ? place : depth_place_for(place);
        const DepthStatement statement = statement_for(depth, place, request);
        Sources sources = sources_of({}, place, statement, request);
        sources.colour.reset();
        auto media = media_of(std::move(sources), statement, request, false, notice);
        if (request.decoder == Decoder::automatic) media->decode_by_device();
        return media;
    });
}

MediaDescription describe_media(const fs::path& place, const DepthRequest& asked,
                                const fs::path& other) {
    return opened(asked, [&](const DepthRequest& request, const std::string& notice) {
        return described(place, other, request, notice);
    });
}

}  // namespace dibhr
