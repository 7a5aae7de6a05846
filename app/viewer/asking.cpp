// Makes the question on the depth, and draws a small relief by each of its answers.
#include "app/viewer/asking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/settings/folder.hpp"
#include "core/files/names.hpp"
#include "core/video/depth/texture_slope.hpp"
#include "core/video/live/live_name.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSide = 256;  // of the grid of a small relief
constexpr double kHighestLevel = 255.0;
// Larger than in the window: scaled down, its edges are smooth, also as software draws it.
constexpr glm::ivec2 kDrawn_px{800, 600};

/// The name of the folder whose other files an answer can hold for; empty: there is none.
std::string folder_of_files(const fs::path& depth) {
    std::error_code unknown;
    if (is_live(depth) || !fs::is_regular_file(depth, unknown)) return {};
    return shown(whole_path(depth).parent_path().filename());
}

/// As seen from the side and from above: it shows what is near, whatever is painted on it.
Camera camera_over(const DepthImage& depth, double relief_px) {
    constexpr double kTurn_rad = 12.0 * std::numbers::pi / 180.0;  // beyond the usual view's
    constexpr double kTilt_rad = 22.0 * std::numbers::pi / 180.0;
    constexpr double kZoom = 0.84;  // its corners are in the picture, too
    Camera camera;
    camera.frame_relief(depth.columns, depth.rows, relief_px);
    camera.orbit(kTurn_rad, kTilt_rad);
    camera.zoom(kZoom);
    return camera;
}

}  // namespace

std::optional<DepthQuestion> question_on(const MediaDescription& media) {
    if (media.conclusion.alternatives.size() < 2 || !media.meaning) return std::nullopt;
    return DepthQuestion{.alternatives = media.conclusion.alternatives,
                         .doubt = media.conclusion.doubt,
                         .folder = folder_of_files(media.depth_path)};
}

DepthImage depth_by(const Frame& frame, const DepthMeaning& now, const DepthMeaning& other) {
    const DepthImage& drawn = *frame.drawn();
    const int step = (std::max(drawn.columns, drawn.rows) + kMostSide - 1) / kMostSide;
    const auto level = [&](int i, int j) {
        const std::size_t pixel = drawn.index(i * step, j * step);
        if (frame.unseen && (*frame.unseen)[pixel] != 0) return 0.0;
        const double value = value_at(now, drawn.levels[pixel] / drawn.highest_level);
        const double nearness = nearness_at(other, value / now.scale.value * other.scale.value);
        return std::isfinite(nearness) ? kHighestLevel * std::clamp(nearness, 0.0, 1.0) : 0.0;
    };
    return image_of((drawn.columns + step - 1) / step, (drawn.rows + step - 1) / step,
                    kHighestLevel, level);
}

void take_digit(int digit, ViewerState& state) {
    DepthQuestion& question = *state.ui.depth_question;
    if (digit == 0 && !question.folder.empty()) question.for_folder = !question.for_folder;
    if (digit > 0 && static_cast<std::size_t>(digit) <= question.alternatives.size())
        state.commands.push(AnswerDepth{static_cast<std::size_t>(digit) - 1});
}

void ViewerAsking::draw_reliefs(const DepthBlend& shown, std::uint32_t media, ViewerState& state,
                                SceneView& scene) {
    std::optional<DepthQuestion>& question = state.ui.depth_question;
    const std::size_t next = question ? question->reliefs.size() : 0;
    if (next == 0) frame_.reset();
    if (!question || !state.media.meaning || next == question->alternatives.size()) return;
    if (!frame_ && (!shown.makes_surface() || shown.nearest().media != media)) return;
    if (!frame_) frame_ = shown.nearest();
    const DepthMeaning& now = *state.media.meaning;
    Frame frame;
    frame.depth = std::make_shared<const DepthImage>(
        depth_by(*frame_, now, meaning_by(question->alternatives[next], now)));
    frame.colour = frame_->colour;
    frame.video = frame_->video;
    SceneContent content{.depth = {&frame, &frame, 0.0}, .colour = &frame};
    const MediaDescription drawn{
        .depth_columns = frame.depth->columns,
        .texture_slope = state.media.still ? texture_slope(*frame.depth) : std::nullopt};
    content.shape.relief_px = fit_of(drawn).relief_px;
    content.relief_style.light = 1.0;
    content.relief_style.paint = ReliefPaint::clay;
    content.light_wall = state.settings.theme == Theme::light;
    const auto picture = std::make_shared<const ColourImage>(
        scene.capture(content, camera_over(*frame.depth, content.shape.relief_px), kDrawn_px));
    question->reliefs.push_back(reliefs_.at(next).show(picture, kDrawn_px.x, true));
}

}  // namespace dibhr
