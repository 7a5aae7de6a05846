// Strokes, undo and redo, and passing the maps to player, files and recording.
#include "app/viewer/painting/painting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "app/settings/material.hpp"
#include "core/error.hpp"
#include "core/haptics/surface.hpp"
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

std::shared_ptr<const TouchMaps> ViewerPainting::begin(FoundMaps found,
                                                       const MediaDescription& media,
                                                       bool is_sample) {
    stroke_.reset();
    const bool is_same = depth_ == media.depth_path && columns_ == media.depth_columns &&
                         rows_ == media.depth_rows && refusal_.empty();
    felt_ = maps_;
    encoded_.clear();
    if (is_same) return maps_;
    depth_ = media.depth_path;
    columns_ = media.depth_columns;
    rows_ = media.depth_rows;
    is_sample_ = is_sample;
    refusal_ = std::move(found.refusal);
    before_.clear();
    undone_.clear();
    maps_.reset();
    if (found.maps) maps_ = numbered(*found.maps);
    if (maps_) to_write_.push_back({depth_, maps_, false});  // for recordings
    felt_ = maps_;
    return maps_;
}

void ViewerPainting::end(ViewerState& state) {
    stroke_.reset();
    depth_.clear();
    maps_.reset();
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
    brush.has_paint = maps_ != nullptr;
    brush.saved_as = is_sample_ || depth_.empty() ? std::filesystem::path{}
                                                  : touch_map_file(depth_, TouchMapKind::stiffness);
}

void ViewerPainting::use(bool pressed, const std::optional<Vec3>& under, const DepthBlend& shown,
                         ViewerState& state, Player& player) {
    if (!pressed) end_stroke(state, player);
    if (!pressed || !refusal_.empty() || !shown.makes_surface()) return;
    if (!stroke_ && under) start_stroke(shown, state, player);
    if (!stroke_ || !under) return;
    stroke_->go_to(*under);
    drawn_ = std::make_shared<const TouchMaps>(stroke_->maps());
}

void ViewerPainting::start_stroke(const DepthBlend& shown, ViewerState& state, Player& player) {
    if (state.media.playback.playing) player.pause();
    const DepthImage& image = *shown.from->depth;
    if (image.columns != columns_ || image.rows != rows_) return;  // a frame of the last media
    const Brush& brush = state.ui.brush;
    try {
        stroke_.emplace(maps_ ? *maps_ : TouchMaps{}, lays_of(brush, state.settings.touch, image),
                        BrushTip{0.5 * brush.width * columns_, brush.strength}, columns_, rows_);
    } catch (const InputError& error) {
        state.ui.message = error.what();
        state.ui.brush.on = false;
    }
}

void ViewerPainting::end_stroke(ViewerState& state, Player& player) {
    if (!stroke_) return;
    before_.push_back(maps_);
    undone_.clear();
    std::size_t bytes = 0;
    for (std::size_t k = before_.size(); k-- > 0;) {
        bytes += bytes_of(before_[k].get());
        if (bytes <= kMostUndo_bytes || k + 1 == before_.size()) continue;
        before_.erase(before_.begin(), before_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        break;
    }
    TouchMaps painted = stroke_->maps();
    stroke_.reset();
    for (const TouchMapKind kind : all_touch_map_kinds()) {
        if (!painted.of(kind).covers_anything()) painted.of(kind) = {};
    }
    replace_maps(painted.empty() ? nullptr : numbered(std::move(painted)), state, player);
}

void ViewerPainting::replace_maps(std::shared_ptr<const TouchMaps> maps, ViewerState& state,
                                  Player& player) {
    maps_ = std::move(maps);
    drawn_.reset();
    encoded_.clear();
    felt_ = maps_;
    player.set_maps(felt_);
    to_write_.push_back({depth_, maps_, !is_sample_});
    update_brush(state);
}

void ViewerPainting::feel(std::shared_ptr<const TouchMaps> maps, Player& player) {
    felt_ = std::move(maps);
    player.set_maps(felt_);
    if (felt_) to_write_.push_back({depth_, felt_, false});
}

void ViewerPainting::undo(ViewerState& state, Player& player) {
    if (stroke_ || before_.empty()) return;
    undone_.push_back(maps_);
    std::shared_ptr<const TouchMaps> maps = std::move(before_.back());
    before_.pop_back();
    replace_maps(std::move(maps), state, player);
}

void ViewerPainting::redo(ViewerState& state, Player& player) {
    if (stroke_ || undone_.empty()) return;
    before_.push_back(maps_);
    std::shared_ptr<const TouchMaps> maps = std::move(undone_.back());
    undone_.pop_back();
    replace_maps(std::move(maps), state, player);
}

void ViewerPainting::remove_all(ViewerState& state, Player& player) {
    if (stroke_ || !maps_ || !refusal_.empty()) return;
    before_.push_back(maps_);
    undone_.clear();
    replace_maps(nullptr, state, player);
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
    const bool is_last = std::none_of(
        to_write_.begin(), to_write_.end(),
        [&](const ToWrite& later) { return later.to_files && later.depth == next.depth; });
    writing_.start([next, to_files = next.to_files && is_last,
                    known = encoded_as(next.maps ? next.maps->version : 0)]() -> Written {
        Written written;
        try {
            if (next.maps) {
                written.version = next.maps->version;
                written.encoded = known.empty() ? encoded(*next.maps) : known;
            }
            if (to_files) write_touch_maps(next.maps ? *next.maps : TouchMaps{}, next.depth);
        } catch (const std::exception& error) {
            written.failure = error.what();
        }
        return written;
    });
}

void ViewerPainting::take_written(TouchRecording& recording) {
    auto written = writing_.take();
    if (!written) return;
    if (felt_ != maps_) encoded_[written->version] = written->encoded;
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

std::shared_ptr<const TouchMaps> ViewerPainting::drawn() const {
    return stroke_ && drawn_ ? drawn_ : felt_;
}

const Frame* ViewerPainting::tinted(const Frame* frame, const ViewerState& state) {
    const std::shared_ptr<const TouchMaps> maps = stroke_ && drawn_ ? drawn_ : maps_;
    const BrushLayer layer = state.ui.brush.layer;
    if (!state.ui.brush.on || !maps || frame == nullptr || !frame->has_colour()) return frame;
    const bool is_same =
        tinted_of_ == frame->colour_object() && tinted_maps_ == maps && tinted_layer_ == layer;
    if (!is_same) {
        tinted_ = {};
        if (materials_.empty()) materials_ = painted_materials();
        tinted_.colour = std::make_shared<const ColourImage>(
            with_paint(*frame->rgb(), *maps, layer, materials_));
        tinted_of_ = frame->colour_object();
        tinted_maps_ = maps;
        tinted_layer_ = layer;
    }
    return &tinted_;
}

}  // namespace dibhr
