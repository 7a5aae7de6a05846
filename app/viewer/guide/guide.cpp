// Looks up the region under the proxy, and changes the ridges with the label pictures.
#include "app/viewer/guide/guide.hpp"

#include <exception>
#include <glm/geometric.hpp>
#include <utility>

#include "core/video/guide/regions_file.hpp"
#include "core/video/guide/ridged_maps.hpp"

namespace dibhr {

namespace {

/// A finger rests that stays within this share of the picture's width for so long.
constexpr double kRestingReach = 0.02;
constexpr double kRest_s = 0.6;
/// After the finger has left, the region is shown for so long.
constexpr double kStays_s = 3.0;

}  // namespace

FoundGuide find_guide(const MediaDescription& media) {
    FoundGuide found;
    const auto report = [&found](const std::exception& error, const char* without) {
        found.trouble += (found.trouble.empty() ? "" : "\n\n") + std::string(error.what()) +
                         "\n\nThe recording is touched without " + without + ".";
    };
    try {
        found.regions.regions =
            read_regions(media.depth_path, media.depth_columns, media.depth_rows);
    } catch (const std::exception& error) {
        found.regions.refusal = error.what();
        report(error, "named regions");
    }
    try {
        found.captions = read_captions(media.depth_path);
    } catch (const std::exception& error) {
        report(error, "captions");
    }
    return found;
}

void ViewerGuide::begin(const FoundGuide& found, ViewerState& state) {
    captions_ = found.captions;
    state.ui.caption.clear();
    laid_ = {};
    take(found.regions.regions, state);
    if (found.trouble.empty()) return;
    std::string& message = state.ui.message;
    message += (message.empty() ? "" : "\n\n") + found.trouble;
}

void ViewerGuide::show(const std::shared_ptr<const Regions>& regions, ViewerState& state) {
    if (regions_ != regions) take(regions, state);
}

void ViewerGuide::take(const std::shared_ptr<const Regions>& regions, ViewerState& state) {
    regions_ = regions;
    touched_ = nullptr;
    versions_.clear();
    numbered_for_.reset();
    state.ui.region = {};
    state.ui.regions = regions_ ? regions_->regions.size() : 0;
}

void ViewerGuide::follow(const DepthBlend& shown, double now_s, ViewerState& state) {
    if (captions_ && shown.makes_surface())
        state.ui.caption = captions_->at(shown.nearest().media_s);
    if (regions_) follow_finger(shown, now_s, state);
}

void ViewerGuide::follow_finger(const DepthBlend& shown, double now_s, ViewerState& state) {
    RegionShown& region = state.ui.region;
    const Proxy& proxy = state.touch.haptic.touch.proxy;
    const bool touches = shown.makes_surface() && state.touch.haptic.touchable && proxy.contact;
    const Region* here = nullptr;
    double reach_px = 0.0;
    if (touches) {
        const DepthImage& image = *shown.from->drawn();
        here = regions_->at(proxy.position.x, proxy.position.y, image.columns, image.rows,
                            shown.nearest().media_s);
        reach_px = kRestingReach * image.columns;
    }
    if (here == nullptr) {
        const bool stays = !touches && now_s < left_s_ + kStays_s;
        if (stays) return;
        touched_ = nullptr;
        region = {};
        return;
    }
    left_s_ = now_s;
    if (here != touched_) region = {here->name, here->text, false};
    const glm::dvec2 hand(state.touch.haptic.touch.goal);
    const bool moved = !(glm::distance(hand, rested_at_) <= reach_px);
    if (here != std::exchange(touched_, here) || moved) {
        rested_at_ = hand;
        rested_since_s_ = now_s;
    }
    if (now_s >= rested_since_s_ + kRest_s) region.rests = true;
}

std::uint32_t ViewerGuide::version_of(const Ridges& ridges, ViewerPainting& painting) {
    if (numbered_for_ != ridges.painted) versions_.clear();
    numbered_for_ = ridges.painted;
    std::uint32_t& version = versions_[*ridges.picture];
    if (version == 0) version = painting.new_version();
    return version;
}

void ViewerGuide::follow_ridges(const DepthBlend& shown, const ViewerState& state,
                                ViewerPainting& painting, Player& player) {
    if (!shown.makes_surface()) return;
    Ridges wanted{painting.painted(), regions_, {}};
    if (regions_ && state.settings.outlines)
        wanted.picture = regions_->picture_at(shown.nearest().media_s);
    if (auto raised = raising_.take(); raised && raised->of.painted == wanted.painted &&
                                       raised->of.regions == wanted.regions && raised->of.picture &&
                                       wanted.picture) {
        laid_ = raised->of;
        painting.feel(std::move(raised->maps), player);
    }
    if (!wanted.picture && laid_.picture) {
        laid_ = wanted;
        painting.feel(wanted.painted, player);
    }
    if (!wanted.picture || laid_ == wanted || raising_.running()) return;
    const DepthImage& image = *shown.from->drawn();
    raising_.start([wanted, version = version_of(wanted, painting), columns = image.columns,
                    rows = image.rows]() -> Raised {
        TouchMaps maps =
            with_ridges(wanted.painted.get(), *wanted.regions, *wanted.picture, columns, rows);
        maps.version = version;
        return {wanted, std::make_shared<const TouchMaps>(std::move(maps))};
    });
}

}  // namespace dibhr
