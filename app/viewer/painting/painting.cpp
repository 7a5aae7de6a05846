// Strokes, undo and redo, and passing the maps to player, files and recording.
#include "app/viewer/painting/painting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "app/settings/material.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/guide/regions_file.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

namespace {

/// Memory limit of the undo list; the last stroke can always be undone.
constexpr std::size_t kMostUndo_bytes = std::size_t{256} << 20;

std::size_t bytes_of(const TouchMaps* maps) {
    if (maps == nullptr) return 0;
    std::size_t bytes = maps->at_vertices.heights_px.size() * sizeof(float);
    for (const TouchMapKind kind : all_touch_map_kinds())
        bytes += maps->of(kind).pixels.size() * sizeof(TouchMap::Pixel);
    return bytes;
}

std::size_t bytes_of(const Regions* regions) {
    return regions == nullptr ? 0 : regions->labels.size();
}

Region region_of(const Brush& brush) {
    return {one_line(brush.region_name.data(), kMostRegionName),
            one_line(brush.region_text.data(), kMostRegionText)};
}

/// The maps that are not empty, as PNG.
std::vector<SessionMap> encoded(const TouchMaps& maps) {
    std::vector<SessionMap> all;
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        const TouchMap& map = maps.of(kind);
        if (!map.empty())
            all.push_back({name_of(kind), map.limits.lowest, map.limits.highest, png_of(map)});
    }
    return all;
}

/// Heights of a material's bumps at every pixel [px].
std::function<double(int, int)> bumps_of(const Material& material, const TouchParameters& as_laid,
                                         const DepthImage& image) {
    auto bump = std::make_shared<BumpMap>(
        BumpMap{material.bumps->columns, material.bumps->rows, material.bumps->heights});
    stretch(*bump, image.columns, image.rows, as_laid.shape.bump_size_px);
    return [bump, columns = image.columns, roughness = as_laid.shape.roughness_px](int i, int j) {
        return roughness *
               bump->at_vertices
                   .heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                            static_cast<std::size_t>(i)];
    };
}

std::function<double(int, int)> everywhere(double value) {
    return [value](int, int) { return value; };
}

/// Throws InputError for a material that does not exist any more.
std::vector<Lay> lays_of(const Brush& brush, const TouchParameters& felt, const DepthImage& image) {
    switch (brush.layer) {
        case BrushLayer::stiffness:
            return {{TouchMapKind::stiffness, everywhere(brush.stiffness_newton_per_mm)}};
        case BrushLayer::friction:
            return {{TouchMapKind::friction, everywhere(brush.friction)}};
        case BrushLayer::height:
            return {{TouchMapKind::height, everywhere(brush.height_px)}};
        case BrushLayer::nothing:
            return {{TouchMapKind::stiffness}, {TouchMapKind::friction}, {TouchMapKind::height}};
        case BrushLayer::region:
            return {};
        case BrushLayer::material:
            break;
    }
    const Material material = material_named(brush.material);
    TouchParameters laid = felt;
    apply_material(material, laid);
    return {
        {TouchMapKind::stiffness, everywhere(laid.coupling.stiffness_newton_per_mm)},
        {TouchMapKind::friction, everywhere(laid.friction.static_coefficient)},
        {TouchMapKind::height, material.bumps ? bumps_of(material, laid, image) : everywhere(0.0)}};
}

}  // namespace

FoundMaps find_maps(const MediaDescription& media) {
    try {
        return {read_touch_maps(media.depth_path, media.depth_columns, media.depth_rows), {}};
    } catch (const std::exception& error) {
        return {nullptr, error.what()};
    }
}

std::shared_ptr<const TouchMaps> ViewerPainting::numbered(TouchMaps maps) {
    maps.version = ++versions_;
    lay_heights(maps, columns_, rows_);
    return std::make_shared<const TouchMaps>(std::move(maps));
}

std::shared_ptr<const TouchMaps> ViewerPainting::begin(FoundMaps found, FoundRegions regions,
                                                       const MediaDescription& media,
                                                       bool is_sample) {
    stroke_.reset();
    region_stroke_.reset();
    const bool is_same = depth_ == media.depth_path && columns_ == media.depth_columns &&
                         rows_ == media.depth_rows && refusal_.empty() && regions_refusal_.empty();
    felt_ = painted_.maps;
    encoded_.clear();
    if (is_same) return felt_;
    depth_ = media.depth_path;
    columns_ = media.depth_columns;
    rows_ = media.depth_rows;
    is_sample_ = is_sample;
    refusal_ = std::move(found.refusal);
    regions_refusal_ = std::move(regions.refusal);
    before_.clear();
    undone_.clear();
    painted_ = {nullptr, std::move(regions.regions)};
    if (found.maps) painted_.maps = numbered(*found.maps);
    if (painted_.maps) to_write_.push_back({depth_, painted_});  // for recordings
    felt_ = painted_.maps;
    return felt_;
}

void ViewerPainting::end(ViewerState& state) {
    stroke_.reset();
    region_stroke_.reset();
    depth_.clear();
    painted_ = {};
    felt_.reset();
    before_.clear();
    undone_.clear();
    state.ui.brush.on = false;
    state.ui.brush.ring.clear();
    update_brush(state);
}

void ViewerPainting::update_brush(ViewerState& state) const {
    Brush& brush = state.ui.brush;
    brush.refusal = refusal_;
    brush.can_undo = !before_.empty();
    brush.can_redo = !undone_.empty();
    brush.has_paint = painted_.maps != nullptr;
    brush.regions = painted_.regions;
    brush.saved_as = is_sample_ || depth_.empty() ? std::filesystem::path{}
                                                  : touch_map_file(depth_, TouchMapKind::stiffness);
}

void ViewerPainting::use(bool pressed, const std::optional<Vec3>& under, const DepthBlend& shown,
                         ViewerState& state, Player& player) {
    if (!pressed) end_stroke(state, player);
    if (!pressed || !refusal_.empty() || !shown.makes_surface()) return;
    if (!stroke_ && !region_stroke_ && under) start_stroke(shown, state, player);
    if (!under) return;
    if (stroke_) {
        stroke_->go_to(*under);
        drawn_.maps = std::make_shared<const TouchMaps>(stroke_->maps());
    }
    if (region_stroke_ && region_stroke_->go_to(*under)) {
        drawn_.regions = std::make_shared<const Regions>(region_stroke_->regions());
    }
}

void ViewerPainting::start_stroke(const DepthBlend& shown, ViewerState& state, Player& player) {
    if (state.media.playback.playing) player.pause();
    const DepthImage& image = *shown.from->depth;
    if (image.columns != columns_ || image.rows != rows_) return;  // a frame of the last media
    const Brush& brush = state.ui.brush;
    const bool of_region = brush.layer == BrushLayer::region;
    if (of_region && brush.region_name.front() == '\0') {
        state.ui.message = "The region has no name yet: type one on the Paint panel, then paint.";
        return;
    }
    if (of_region && !regions_refusal_.empty()) {
        state.ui.message = "No region can be painted here: " + regions_refusal_;
        return;
    }
    try {
        const double radius_px = 0.5 * brush.width * columns_;
        drawn_ = painted_;
        if (!of_region)
            stroke_.emplace(painted_.maps ? *painted_.maps : TouchMaps{},
                            lays_of(brush, state.settings.touch, image),
                            BrushTip{radius_px, brush.strength}, columns_, rows_);
        const bool erases = brush.layer == BrushLayer::nothing && painted_.regions;
        if (of_region || erases)
            region_stroke_.emplace(painted_.regions.get(), erases ? Region{} : region_of(brush),
                                   radius_px, columns_, rows_);
    } catch (const InputError& error) {
        state.ui.message = error.what();
        state.ui.brush.on = false;
    }
}

void ViewerPainting::end_stroke(ViewerState& state, Player& player) {
    if (!stroke_ && !region_stroke_) return;
    Painted painted = painted_;
    if (stroke_) {
        TouchMaps maps = stroke_->maps();
        for (const TouchMapKind kind : all_touch_map_kinds()) {
            if (!maps.of(kind).covers_anything()) maps.of(kind) = {};
        }
        painted.maps = maps.empty() ? nullptr : numbered(std::move(maps));
    }
    if (region_stroke_ && region_stroke_->has_changed(painted_.regions.get()))
        painted.regions = without_bare(region_stroke_->regions());
    stroke_.reset();
    region_stroke_.reset();
    keep_stroke(std::move(painted), state, player);
}

/// In place of what was painted before, which can be taken back.
void ViewerPainting::keep_stroke(Painted painted, ViewerState& state, Player& player) {
    before_.push_back(painted_);
    undone_.clear();
    std::size_t bytes = 0;
    for (std::size_t k = before_.size(); k-- > 0;) {
        const Painted& after = k + 1 < before_.size() ? before_[k + 1] : painted;
        if (before_[k].maps != after.maps) bytes += bytes_of(before_[k].maps.get());
        if (before_[k].regions != after.regions) bytes += bytes_of(before_[k].regions.get());
        if (bytes <= kMostUndo_bytes || k + 1 == before_.size()) continue;
        before_.erase(before_.begin(), before_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        break;
    }
    replace(std::move(painted), state, player);
}

void ViewerPainting::replace(Painted painted, ViewerState& state, Player& player) {
    const bool other_maps = painted.maps != painted_.maps;
    const bool other_regions = painted.regions != painted_.regions;
    painted_ = std::move(painted);
    drawn_ = {};
    if (other_maps) {
        encoded_.clear();
        felt_ = painted_.maps;
        player.set_maps(felt_);
    }
    to_write_.push_back({depth_,
                         {other_maps ? painted_.maps : nullptr, painted_.regions},
                         other_maps && !is_sample_,
                         other_regions && !is_sample_});
    update_brush(state);
}

void ViewerPainting::feel(std::shared_ptr<const TouchMaps> maps, Player& player) {
    felt_ = std::move(maps);
    player.set_maps(felt_);
    if (felt_) to_write_.push_back({depth_, {felt_, nullptr}});
}

void ViewerPainting::undo(ViewerState& state, Player& player) {
    if (stroke_ || region_stroke_ || before_.empty()) return;
    undone_.push_back(painted_);
    Painted painted = std::move(before_.back());
    before_.pop_back();
    replace(std::move(painted), state, player);
}

void ViewerPainting::redo(ViewerState& state, Player& player) {
    if (stroke_ || region_stroke_ || undone_.empty()) return;
    before_.push_back(painted_);
    Painted painted = std::move(undone_.back());
    undone_.pop_back();
    replace(std::move(painted), state, player);
}

void ViewerPainting::remove_all(ViewerState& state, Player& player) {
    if (stroke_ || region_stroke_ || !painted_.maps || !refusal_.empty()) return;
    keep_stroke({nullptr, painted_.regions}, state, player);
}

/// Empty: not encoded yet.
std::vector<SessionMap> ViewerPainting::encoded_as(std::uint32_t version) const {
    const auto found = encoded_.find(version);
    return found == encoded_.end() ? std::vector<SessionMap>{} : found->second;
}

/// Writes one version at a time. A recording may refer to every version; for files only the last
/// one matters.
void ViewerPainting::start_writing() {
    if (to_write_.empty() || writing_.running()) return;
    const ToWrite next = to_write_.front();
    to_write_.erase(to_write_.begin());
    const auto is_last = [&](bool ToWrite::*to_files) {
        return next.*to_files &&
               std::none_of(to_write_.begin(), to_write_.end(), [&](const ToWrite& later) {
                   return later.*to_files && later.depth == next.depth;
               });
    };
    const auto& maps = next.painted.maps;
    writing_.start([next, maps_to_files = is_last(&ToWrite::maps_to_files),
                    regions_to_files = is_last(&ToWrite::regions_to_files),
                    known = encoded_as(maps ? maps->version : 0)]() -> Written {
        Written written;
        const Painted& painted = next.painted;
        const auto attempt = [&written](const auto& step) {
            try {
                step();
            } catch (const std::exception& error) {
                written.failure +=
                    (written.failure.empty() ? "" : "\n\n") + std::string(error.what());
            }
        };
        attempt([&] {
            if (painted.maps) {
                written.version = painted.maps->version;
                written.encoded = known.empty() ? encoded(*painted.maps) : known;
            }
            if (maps_to_files)
                write_touch_maps(painted.maps ? *painted.maps : TouchMaps{}, next.depth);
        });
        attempt([&] {
            if (regions_to_files) write_regions(painted.regions.get(), next.depth);
        });
        return written;
    });
}

void ViewerPainting::take_written(TouchRecording& recording) {
    auto written = writing_.take();
    if (!written) return;
    if (felt_ != painted_.maps) encoded_[written->version] = written->encoded;
    if (written->version > 0) recording.maps(written->version, std::move(written->encoded));
    if (!written->failure.empty()) failure_ = written->failure;
}

void ViewerPainting::poll(ViewerState& state, TouchRecording& recording) {
    update_brush(state);
    take_written(recording);
    start_writing();
    if (!failure_.empty()) throw InputError(std::exchange(failure_, {}));
}

void ViewerPainting::flush_maps(TouchRecording& recording, std::chrono::milliseconds patience) {
    const auto latest = std::chrono::steady_clock::now() + patience;
    while (writing_.running() || !to_write_.empty()) {
        start_writing();
        writing_.wait_until(latest);
        take_written(recording);
        if (std::chrono::steady_clock::now() > latest) return;
    }
}

void ViewerPainting::finish(TouchRecording& recording, std::chrono::milliseconds patience) {
    flush_maps(recording, patience);
    if (writing_.running()) failure_ = depth_.string() + ": what was painted could not be saved";
    if (!failure_.empty()) throw InputError(std::exchange(failure_, {}));
}

ViewerPainting::Painted ViewerPainting::shown() const {
    return stroke_ || region_stroke_ ? drawn_ : painted_;
}

std::shared_ptr<const TouchMaps> ViewerPainting::drawn() const {
    return stroke_ && drawn_.maps ? drawn_.maps : felt_;
}

void ViewerPainting::forget_tints() {
    materials_.clear();
    tinted_of_.reset();
}

const Frame* ViewerPainting::tinted(const Frame* frame, const ViewerState& state) {
    const Painted painted = shown();
    const BrushLayer layer = state.ui.brush.layer;
    const bool of_regions = layer == BrushLayer::region;
    const bool nothing = of_regions ? !painted.regions : !painted.maps;
    if (!state.ui.brush.on || nothing || frame == nullptr || !frame->has_colour()) return frame;
    const bool is_same = tinted_of_ == frame->colour_object() && tinted_as_.maps == painted.maps &&
                         tinted_as_.regions == painted.regions && tinted_layer_ == layer;
    if (!is_same) {
        tinted_ = {};
        if (materials_.empty()) materials_ = painted_materials();
        tinted_.colour = std::make_shared<const ColourImage>(
            of_regions ? with_regions(*frame->rgb(), *painted.regions,
                                      painted.regions->picture_at(frame->media_s))
                       : with_paint(*frame->rgb(), *painted.maps, layer, materials_));
        tinted_of_ = frame->colour_object();
        tinted_as_ = painted;
        tinted_layer_ = layer;
    }
    return &tinted_;
}

}  // namespace dibhr
