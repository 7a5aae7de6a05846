// Decodes hues and the ramp, picture by picture.
#include "core/video/sources/coded_depth.hpp"

#include <utility>
#include <vector>

#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

/// What the code says of the levels that it becomes.
DepthStatement meaning_of(const HueCode& code) {
    DepthStatement meaning;
    meaning.code = DepthCode::hue;
    meaning.near = NearLevels::dark;
    meaning.unit = code.metres ? DepthUnit::m : DepthUnit::levels;
    meaning.scale = 1.0;
    meaning.range = code.metres;
    meaning.no_data.emplace();  // 0 is a level
    return meaning;
}

}  // namespace

std::unique_ptr<PictureSource> hue_decoded(std::unique_ptr<PictureSource> colours, HueCode code,
                                           std::string known_from) {
    const auto decode = [code](const cv::Mat& picture) {
        cv::Mat depth = hues_of(picture, code);
        if (!code.metres) return depth;
        const double near = code.metres->near;
        depth.convertTo(depth, CV_32F, code.metres->far - near, near);
        return depth;
    };
    const auto tell = [code, from = std::move(known_from)](SourceFacts& facts) {
        facts.bits = kRealBits;
        facts.channels = 1;
        facts.known_from = from;
        facts.known.fill_in(meaning_of(code));
    };
    return std::make_unique<ChangedPictures>(std::move(colours), decode, tell);
}

std::unique_ptr<PictureSource> ramp_decoded(std::unique_ptr<PictureSource> colours,
                                            std::string known_from) {
    const auto tell = [from = std::move(known_from)](SourceFacts& facts) {
        facts.bits = 8;
        facts.channels = 1;
        facts.known_from = from;
        DepthStatement ramp;
        ramp.near = NearLevels::bright;
        ramp.unit = DepthUnit::levels;
        ramp.no_data = {0.0};
        facts.known.fill_in(ramp);
    };
    return std::make_unique<ChangedPictures>(std::move(colours), ramp_levels, tell);
}

}  // namespace dibhr
