// Looks at the colours of a depth: grey, hues, a ramp, numbers in bytes, or a photograph.
#include "core/video/sources/coded_colours.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/video/depth/byte_code.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/level_code.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

/// 8-bit blue, green and red of a depth picture, for statistics; empty where it has none.
cv::Mat seen_colours(const cv::Mat& picture) {
    if (picture.channels() < 3) return {};
    cv::Mat colours = picture;
    if (picture.channels() == 4) cv::cvtColor(picture, colours, cv::COLOR_BGRA2BGR);
    if (colours.depth() == CV_8U) return colours;
    double highest = highest_level(16);
    if (colours.depth() != CV_16U) {
        const cv::Mat numbers = colours.reshape(1);
        const cv::Mat finite = cv::abs(numbers) <= std::numeric_limits<float>::max();
        cv::minMaxIdx(numbers, nullptr, &highest, nullptr, nullptr, finite);
    }
    cv::Mat seen;
    colours.convertTo(seen, CV_8U, highest > 0.0 ? highest_level(8) / highest : 0.0);
    return seen;
}

/// Samples of the depth with its colours; `halves`: it is a half of the place's pictures, null: it
/// is all. The depth of a video that is not coded in red, green and blue is its luma: then its
/// first picture is converted again, and for more pictures the video is read again.
std::vector<cv::Mat> depth_samples(const KnownPlace& place, Sources& sources, int most,
                                   const PackedForm* halves) {
    const bool is_video = place.is(PictureForm::video);
    if (!is_video || halves == nullptr) {
        const std::vector<cv::Mat> first = sources.depth->samples(1);
        const bool is_luma = is_video && !first.empty() && first.front().channels() < 3;
        if (!is_luma) return most == 1 ? first : sources.depth->samples(most);
        const cv::Mat in_colour = most == 1 ? sources.depth->first_in_colour() : cv::Mat();
        if (!in_colour.empty()) return {in_colour};
    }
    std::vector<cv::Mat> pictures = colour_samples(place.path, most, sources.depth_track);
    for (cv::Mat& picture : pictures) {
        if (halves != nullptr)
            picture = picture(
                half_of(picture.size(), halves->packing, PictureRole::depth, halves->gap_px));
    }
    return pictures;
}

}  // namespace

ColoursOfDepth colours_of_depth(const KnownPlace& place, Sources& sources,
                                const PackedForm* halves) {
    if (sources.depth->facts().channels == 1) return {};
    // The first picture first, as sampling more takes time.
    const std::vector<cv::Mat> first = depth_samples(place, sources, 1, halves);
    if (first.empty() || first.front().channels() < 3 || !is_coloured(seen_colours(first.front())))
        return {};
    const std::vector<cv::Mat> pictures = depth_samples(place, sources, kKindSamples, halves);
    const auto code = byte_code_in(pictures);
    if (code && may_hold_bytes(*sources.depth, *code)) return {PictureKind::byte_depth, *code};
    if (code || first.front().depth() == CV_32F) return {PictureKind::photo};
    std::vector<cv::Mat> seen;
    std::transform(pictures.begin(), pictures.end(), std::back_inserter(seen), seen_colours);
    return {guess_kind(seen).kind};
}

namespace {

/// The pictures of the depth with their colours.
std::unique_ptr<PictureSource> in_colours(const KnownPlace& place, Sources& sources) {
    if (!place.is(PictureForm::video) && !place.is(PictureForm::still))
        return std::move(sources.depth);
    return open_as_colour(place.path, sources.depth_track);
}

void decode_colours(const KnownPlace& place, DepthCode code, bool is_stated, Sources& sources) {
    const Finding coded = finding_on_code(code, is_stated);
    if (is_of_bytes(code))
        sources.depth = byte_decoded(std::move(sources.depth), code, coded);
    else
        sources.depth = hue_decoded(in_colours(place, sources), HueCode{}, coded);
}

}  // namespace

void refuse_colours(const KnownPlace& place, const PackedForm* halves, Sources& sources) {
    const std::vector<cv::Mat> first = depth_samples(place, sources, 1, halves);
    sources.not_depth = refusal_of_colours(sources.depth->facts(),
                                           first.empty() ? cv::Mat() : seen_colours(first.front()));
}

Sources with_decoded_colours(const KnownPlace& place, Sources sources,
                             const DepthStatement& statement) {
    sources.reader = &place.reader;
    const auto stated = statement.code;
    if (stated && *stated != DepthCode::grey && !is_of_levels(*stated)) {
        decode_colours(place, *stated, true, sources);
        return sources;
    }
    const ColoursOfDepth colours = colours_of_depth(place, sources);
    const bool is_ramp = colours.kind == PictureKind::ramp_depth;
    if (is_ramp) sources.depth = ramp_decoded(in_colours(place, sources));
    if (stated || is_ramp || colours.kind == PictureKind::grey_depth) return sources;
    if (colours.kind == PictureKind::hue_depth)
        decode_colours(place, DepthCode::hue, false, sources);
    else if (colours.kind == PictureKind::byte_depth)
        decode_colours(place, colours.bytes, false, sources);
    else
        refuse_colours(place, nullptr, sources);
    return sources;
}

}  // namespace dibhr
