// Makes the question on the depth, and draws a small relief by each of its answers.
#include "app/viewer/asking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <numbers>
#include <system_error>
#include <utility>
#include <vector>

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

/// The pixels without data; null: there is none.
std::shared_ptr<const std::vector<std::uint8_t>> unseen_in(const DepthImage& depth) {
    std::vector<std::uint8_t> unseen(depth.levels.size());
    bool any = false;
    for (std::size_t k = 0; k < unseen.size(); ++k) {
        unseen[k] = std::isfinite(depth.levels[k]) ? 0 : 1;
        any = any || unseen[k] != 0;
    }
    return any ? std::make_shared<const std::vector<std::uint8_t>>(std::move(unseen)) : nullptr;
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

double spread_of(const Frame& frame) {
    constexpr int kSamples = 64;  // a column, and a row
    const DepthImage& drawn = *frame.drawn();
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    for (int row = 0; row < kSamples; ++row) {
        for (int column = 0; column < kSamples; ++column) {
            const std::size_t pixel =
                drawn.index(column * drawn.columns / kSamples, row * drawn.rows / kSamples);
            const double nearness = drawn.levels[pixel] / drawn.highest_level;
            if (!std::isfinite(nearness) || (frame.unseen && (*frame.unseen)[pixel] != 0)) continue;
            sum += nearness;
            squares += nearness * nearness;
            ++count;
        }
    }
    if (count == 0) return 0.0;
    const double mean = sum / count;
    return std::sqrt(std::max(0.0, squares / count - mean * mean));
}

std::optional<Frame> telling_frame(const MediaDescription& media, DepthRequest request) try {
    constexpr int kFrames = 4;
    if (media.still || media.live) return std::nullopt;
    request.paints = false;
    const auto opened = open_media(media.colour_path, media.depth_path, request);
    std::optional<Frame> best;
    double most = -1.0;
    for (int k = 1; k <= kFrames; ++k) {
        opened->seek_near(media.duration_s * k / (kFrames + 1));
        auto read = opened->next();
        if (!read) break;
        Frame frame;
        frame.unseen = unseen_in(read->depth);
        frame.depth = std::make_shared<const DepthImage>(std::move(read->depth));
        const double spread = spread_of(frame);
        if (spread <= most) continue;
        most = spread;
        best = std::move(frame);
    }
    return best;
} catch (const std::exception&) {  // the frames that are shown are enough
    return std::nullopt;
}

void ViewerAsking::offer(const Frame& frame) {
    constexpr double kClearly = 1.2;  // else the reliefs would change all the time
    const double spread = spread_of(frame);
    if (frame_ && spread < kClearly * spread_) return;
    frame_ = frame;
    spread_ = spread;
    next_ = 0;
}

void ViewerAsking::draw_reliefs(const DepthBlend& shown, std::uint32_t media, ViewerState& state,
                                SceneView& scene) {
    std::optional<DepthQuestion>& question = state.ui.depth_question;
    if (!question || question->reliefs.empty()) frame_.reset();
    if (!question || question->answered || !state.media.meaning) return;
    const bool begins = !frame_;
    if (shown.makes_surface() && shown.nearest().media == media) offer(shown.nearest());
    if (!frame_) return;
    if (begins) {
        searching_.restart(
            [media = static_cast<const MediaDescription&>(state.media),
             request = state.media.opened.request] { return telling_frame(media, request); });
    } else if (const auto found = searching_.take(); found && *found) {
        offer(**found);
    }
    if (next_ == question->alternatives.size()) return;
    const DepthMeaning& now = *state.media.meaning;
    Frame frame;
    frame.depth = std::make_shared<const DepthImage>(
        depth_by(*frame_, now, meaning_by(question->alternatives[next_], now)));
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
    const std::uintptr_t relief = reliefs_.at(next_).show(picture, kDrawn_px.x, true);
    if (next_ < question->reliefs.size())
        question->reliefs[next_] = relief;
    else
        question->reliefs.push_back(relief);
    ++next_;
}

}  // namespace dibhr
