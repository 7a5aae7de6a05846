// Texts over the relief: the force in numbers, hints, short notices, the legend and the message
// box.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/panels/labels.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/keys.hpp"
#include "app/touching/device_state.hpp"
#include "app/touching/force_law.hpp"
#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "render/relief_paint.hpp"

namespace dibhr {

namespace {

/// A message centred in the upper part of the relief, as wide as there is room. Returns its lower
/// end.
float draw_banner(const ViewerState& state, const std::string& text) {
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const ImVec2 pad = ImGui::GetStyle().WindowPadding;
    const float widest =
        std::max(std::min(room - 2.0F * pad.x, ImGui::GetFontSize() * 40.0F + 2.0F * pad.x), 1.0F);
    const ImVec2 low{(room - label_size(text, widest, pad).x) * 0.5F,
                     panes_height(state) + 3.2F * ImGui::GetFrameHeight() - pad.y};
    return low.y + label(text, low, 1.0F, widest, *ImGui::GetBackgroundDrawList(), pad);
}

/// Why the device or the live source cannot be used now; empty: both can.
std::string banner_of(const ViewerState& state) {
    if (const std::string banner = device_banner(state.settings, state.touch); !banner.empty())
        return capitalised(banner);
    const auto& live = state.media.playback.live;
    return live && !live->signal && !state.touch.replay ? in_words(*live) : std::string();
}

void centred_label(const ViewerState& state, const std::string& text, float lines_above_bar,
                   float alpha) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFrameHeight();
    const float width = display.x - panel_column_width(state);
    const float widest = width - 24.0F * state.ui.scale;
    const ImVec2 size = label_size(text, widest);
    const float below = label_size({}).y;  // of one line: more lines grow upwards
    label(text,
          {(width - size.x) * 0.5F,
           display.y - bottom_bar_height(state) - (1.4F + lines_above_bar) * line + below - size.y},
          alpha, widest);
}

/// A label with a red dot, so that a recording is visible at a glance.
void red_dot_label(ImDrawList& list, const std::string& text, ImVec2 low) {
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const float line = ImGui::GetTextLineHeight();
    const std::string indent = "      ";
    label(indent + text, low, 1.0F, 0.0F, list);
    list.AddCircleFilled({low.x + pad.x + line * 0.45F, low.y + pad.y + line * 0.5F}, line * 0.42F,
                         IM_COL32(235, 64, 52, 255), 24);
}

std::string replay_text(const ReplayInfo& replay) {
    const std::string date = date_text(replay.started);
    const char* comma = replay.participant.empty() || date.empty() ? "" : ", ";
    const std::string about = replay.participant + comma + date;
    return "Replay of " + replay.file.filename().string() + (about.empty() ? "" : " - " + about);
}

/// The playing position, in time and in frames or ticks.
std::string position_text(const ViewerState& state) {
    const auto& replay = state.touch.replay;
    const PlaybackStatus& video = state.media.playback;
    if (video.live && !replay) return "live, " + in_words(*video.live);
    const PlayState at = state.play_state();
    return clock_text(at.now_s - at.begin_s) + " of " + clock_text(at.end_s - at.begin_s) +
           (replay ? ", tick " + std::to_string(replay->tick_count)
                   : ", frame " + std::to_string(video.frame + 1));
}

/// Whether the spring force exceeds what may be sent: not while the force only rises.
bool is_limited(const ViewerState& state) {
    constexpr double kNearly = 0.999;
    const Touch& touch = state.touch.haptic.touch;
    const double most =
        std::min(state.settings.max_force_newton, limits_of_hand(state.touch).max_force_newton);
    return glm::length(touch.spring_force_newton) > most &&
           glm::length(touch.sent_force_newton) > kNearly * most;
}

constexpr const char* kTouching = "Touching";
constexpr const char* kFree = "Free";

/// In words; with a device, in a replay and beside the statistics also in numbers.
std::string touch_text(const ViewerState& state) {
    const HapticState& haptic = state.touch.haptic;
    if (!state.touch.replay && !state.touch.force_enabled) return "Force off";
    if (const std::string reason = why_held(state); !reason.empty()) return "Force held: " + reason;
    if (!haptic.touchable && state.touch.replay)
        return state.touch.replay->tick.surface ? "Reading the recording" : "Nothing to touch";
    if (!haptic.touchable) return "Nothing to touch yet";
    if (haptic.touch.cut != SafetyCut::none)
        return std::string("No force: ") + name_of(haptic.touch.cut);
    if (!haptic.touch.proxy.contact) return kFree;
    const bool in_numbers = state.ui.statistics || state.touch.replay || may_touch(state.touch);
    if (!in_numbers || state.ui.kiosk) return kTouching;
    const Vec3& f = haptic.touch.sent_force_newton;
    return formatted("Touching   %.2f N%s   (%s, %s, %s)", glm::length(f),
                     is_limited(state) ? ", limited" : "", decimal(f.x, 2).c_str(),
                     decimal(f.y, 2).c_str(), decimal(f.z, 2).c_str());
}

/// The statistics, one line each.
std::vector<std::string> statistics_of(const ViewerState& state) {
    std::vector<std::string> lines;
    const MediaDescription& media = state.media;
    const PlaybackStatus& playback = state.media.playback;
    lines.push_back(formatted("Relief %d x %d, colour %d x %d", media.depth_columns,
                              media.depth_rows, media.colour_columns, media.colour_rows));
    const WindowCost& cost = state.ui.cost;
    lines.push_back(formatted("Processor %.1f %% of a core", 100.0 * cost.core_share));
    lines.push_back(formatted("Pictures %.0f per second", cost.pictures_per_s));
    if (!state.touch.replay && !media.still) {
        lines.back() +=
            formatted(", video %.0f of %.0f", playback.shown_per_s, playback.frames_per_s);
        lines.push_back(formatted("Decoding %.1f ms a frame", playback.decode_ms));
    }
    if (state.touch.replay || !media.still) lines.push_back("At " + position_text(state));
    if (!state.touch.replay) {
        const LoopSecond& second = state.touch.haptic.second;
        lines.push_back(formatted("Ticks %.1f per second%s, late %s of %s", second.rate_hz,
                                  state.touch.haptic.rests ? " at rest" : "",
                                  std::to_string(second.late_ticks).c_str(),
                                  std::to_string(second.ticks).c_str()));
        lines.push_back(formatted("Worst tick %.3f ms late", second.worst_lateness_ms));
        lines.push_back(formatted("Update %.2f us, worst %.1f us, %.1f moves", second.update_us,
                                  second.worst_update_us, second.moves));
    }
    const Touch& touch = state.touch.haptic.touch;
    const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
    if (touch.proxy.contact) {
        lines.push_back(formatted("Penetration %.2f mm, %s (%d, %d)",
                                  glm::length(touch.proxy.position - touch.goal) * pitch_mm,
                                  name_of(touch.proxy.active.kind), touch.proxy.active.i,
                                  touch.proxy.active.j));
    }
    return lines;
}

std::string statistics_text(const ViewerState& state) {
    return listed(statistics_of(state), "\n");
}

/// The pixel under the pointer, in one line or, if too wide, in two.
std::string pointer_text(const ViewerState& state, float widest) {
    const PixelShown& pixel = *state.ui.under_pointer;
    std::string text = formatted("Pixel %d, %d", pixel.column, pixel.row);
    if (const std::string depth = depth_text(state, pixel); !depth.empty()) text += "   " + depth;
    const std::string elevation = "stands " + elevation_text(state, pixel);
    const bool fits = label_size(text + "   " + elevation).x <= widest;
    return text + (fits ? "   " : "\n") + elevation;
}

/// An algorithm, and the colour of its proxy.
struct AlgorithmLine {
    ImU32 colour{0};
    std::string text{};
};

/// First the algorithm in use, then the others with the distances of their proxies from its proxy.
std::vector<AlgorithmLine> side_by_side(const ViewerState& state) {
    const auto line_of = [](Algorithm algorithm, const std::string& what) {
        const SeriesStyle look = style_of(algorithm);
        const Ink ink = look.stroke.ink;
        return AlgorithmLine{IM_COL32(ink.red, ink.green, ink.blue, 255), look.name + what};
    };
    const char* const shown = state.touch.replay ? "   shown" : "   felt";
    std::vector<AlgorithmLine> lines{line_of(state.settings.touch.algorithm, shown)};
    const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
    for (const AlgorithmProxy& other : state.touch.others) {
        const double apart_px =
            glm::distance(other.proxy.position, state.touch.haptic.touch.proxy.position);
        lines.push_back(line_of(other.algorithm, formatted("   %.2f mm off", apart_px * pitch_mm)));
    }
    return lines;
}

/// The lines on a background, each after a ball of its colour. Returns their height.
float draw_algorithms(const std::vector<AlgorithmLine>& lines, ImVec2 low) {
    std::string text;
    for (const AlgorithmLine& line : lines)
        text += (text.empty() ? "      " : "\n      ") + line.text;
    const float height = label(text, low, 1.0F);
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const float line_height = ImGui::GetTextLineHeight();
    ImVec2 middle{low.x + pad.x + 0.45F * line_height, low.y + pad.y + 0.5F * line_height};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const AlgorithmLine& line : lines) {
        list.AddCircleFilled(middle, 0.38F * line_height, line.colour, 24);
        middle.y += line_height;
    }
    return height;
}

/// The legend of the depth's colours.
struct Legend {
    static constexpr int kNumbers = 5;

    std::shared_ptr<const ColourImage> colours{};  ///< null: there is none
    std::string unit{};
    std::array<std::string, kNumbers> numbers{};  ///< from the farthest to the nearest
    float width{0.0F};                            ///< of numbers and unit [px]
};

Legend legend_of(const ViewerState& state) {
    Legend legend;
    if (!state.media.meaning) return legend;
    legend.colours = depth_colours(depth_paint(state));
    const DepthMeaning& meaning = *state.media.meaning;
    legend.unit = meaning.unit.value == DepthUnit::levels
                      ? "level"
                      : std::string(name_of(meaning.unit.value));
    const int digits = depth_digits(meaning);
    for (std::size_t k = 0; k < legend.numbers.size(); ++k) {
        const double nearness = static_cast<double>(k) / (Legend::kNumbers - 1);
        legend.numbers[k] = decimal(value_at(meaning, nearness), digits);
        legend.width = std::max(legend.width, ImGui::CalcTextSize(legend.numbers[k].c_str()).x);
    }
    return legend;
}

/// The colour bar, the nearest depth on top.
void draw_colours(const ColourImage& colours, ImVec2 low, ImVec2 high) {
    constexpr int kSteps = 64;
    const float height = high.y - low.y;
    for (int k = 0; k < kSteps; ++k) {
        const std::size_t colour = 3 * (255 - static_cast<std::size_t>(k * 255 / (kSteps - 1)));
        const auto part = [&](std::size_t c) { return static_cast<int>(colours.rgb[colour + c]); };
        ImGui::GetBackgroundDrawList()->AddRectFilled(
            {low.x, low.y + height * static_cast<float>(k) / kSteps},
            {high.x, low.y + height * static_cast<float>(k + 1) / kSteps},
            IM_COL32(part(0), part(1), part(2), 255));
    }
}

/// The upper edge of the bar under the relief.
float bar_top(const ViewerState& state) {
    return ImGui::GetIO().DisplaySize.y - bottom_bar_height(state);
}

/// The legend at the right of the relief, down to the bar at most. Returns its left edge, or the
/// relief's right edge if there is no legend.
float draw_legend(const ViewerState& state, float margin) {
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const Legend legend = legend_of(state);
    if (!legend.colours) return room;
    const float line = ImGui::GetTextLineHeight();
    const float above = panes_height(state) + 4.0F * margin;
    const float room_below = bar_top(state) - margin - above - 3.5F * line;
    const float height = std::min(10.0F * line, room_below);
    if (height < Legend::kNumbers * line) return room;
    const float bar = 0.9F * line;
    const float unit = ImGui::CalcTextSize(legend.unit.c_str()).x;
    const float inner = std::max(bar + 0.5F * margin + legend.width, unit);
    const ImVec2 low{room - inner - 2.0F * margin, above};
    draw_ground(low, {inner + margin, height + 3.5F * line});
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
    const float left = low.x + 0.5F * margin;
    const float top = low.y + 2.2F * line;
    list.AddText({left, low.y + 0.4F * line}, text, legend.unit.c_str());
    draw_colours(*legend.colours, {left, top}, {left + bar, top + height});
    for (std::size_t k = 0; k < legend.numbers.size(); ++k) {
        const float y =
            top + height * (1.0F - static_cast<float>(k) / (Legend::kNumbers - 1)) - 0.5F * line;
        list.AddText({left + bar + 0.5F * margin, y}, text, legend.numbers[k].c_str());
    }
    return low.x;
}

/// The left edge of a label of that height: beside the toolbar, where it would be under it.
float left_of_label(const ViewerState& state, float margin, float top, float height) {
    const auto tools = toolbar_place(state);
    const bool beside = tools && top + height > tools->top && top < tools->bottom;
    return beside ? tools->right + 0.5F * margin : margin;
}

/// One label below the other, up to `right` and down to the bar; lines without room are left out.
/// Labels that appear by themselves are the last. The banner is below the text on the touch.
void draw_upper_left(const ViewerState& state, float margin, float right) {
    constexpr float kMostRegion = 5.0F;  // rows of a region's name and text
    const float row = ImGui::GetFrameHeight();
    ImVec2 low{margin, panes_height(state) + margin};
    const float bottom = bar_top(state);
    const auto make_room = [&](float height) {
        low.x = left_of_label(state, margin, low.y, height);
        return right - low.x - margin;  // the widest
    };
    const auto add = [&](std::string text) {
        const float widest = make_room(label_size(text, right - 2.0F * margin).y);
        while (low.y + label_size(text, widest).y > bottom) {
            const std::size_t last = text.rfind('\n');
            if (last == std::string::npos) return;
            text.resize(last);
        }
        low.y += label(text, low, 1.0F, widest) + 0.3F * row;
    };
    if (state.touch.replay) add(replay_text(*state.touch.replay));
    const std::string touch = touch_text(state);
    const bool as_usual = touch == kTouching || touch == kFree;
    if (!as_usual || (state.ui.region.name.empty() && !state.ui.kiosk)) add(touch);
    const float widest_region = make_room(kMostRegion * row);
    low.y += draw_region(state, low, widest_region);
    if (const std::string banner = banner_of(state); !banner.empty())
        low.y = draw_banner(state, banner) + 0.3F * row;
    if (state.touch.recording) {
        make_room(row);
        red_dot_label(*ImGui::GetBackgroundDrawList(),
                      "Recording   " + clock_text(state.touch.recording->time_s), low);
        low.y += 1.3F * row;
    }
    if (!state.touch.others.empty() && state.touch.haptic.touchable && !state.ui.explained) {
        const auto lines = side_by_side(state);
        make_room(static_cast<float>(lines.size()) * row);
        low.y += draw_algorithms(lines, low) + 0.3F * row;
    }
    if (state.ui.statistics) add(statistics_text(state));
    if (state.ui.ruler && !state.ui.explained) add(ruler_text(state));
    const bool inspects = state.ui.statistics || state.ui.ruler || shows_panes(state) ||
                          depth_colours(state.settings.relief_style.paint);
    if (inspects && state.ui.under_pointer && !state.ui.explained)
        add(pointer_text(state, make_room(row)));
    if (state.touch.catching_up) add("Catching up");
}

/// The keys for help and panels, at the upper right, unless the text on the touch is in the way.
void draw_key_hint(const ViewerState& state, float margin) {
    constexpr float kFaint = 0.6F;
    const std::string help = state.keys.name_for(Action::toggle_help);
    const std::string panels = state.keys.name_for(Action::toggle_panels);
    const char* const between = help.empty() || panels.empty() ? "" : "   ";
    const std::string text = (help.empty() ? "" : "Keys: " + help) + between +
                             (panels.empty() ? "" : "Panels: " + panels);
    if (text.empty()) return;
    const float width = label_size(text).x;
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const float touching = ImGui::CalcTextSize(touch_text(state).c_str()).x;
    if (touching + width + 4.0F * margin < room)
        label(text, {room - width - margin, panes_height(state) + margin}, kFaint);
}

std::string clip_text(const ViewerState& state) {
    if (state.ui.clip->finishing) return "Finishing the clip";
    const std::string key = state.keys.name_for(Action::take_clip);
    return "Clip   " + clock_text(state.ui.clip->time_s) +
           (key.empty() ? "" : "   " + key + " ends it");
}

}  // namespace

void draw_overlay(const ViewerState& state, double now_s) {
    const float margin = 12.0F * state.ui.scale;
    if (!state.ui.kiosk) draw_key_hint(state, margin);
    draw_caption(state);
    draw_upper_left(state, margin, draw_legend(state, margin));
    if (now_s < state.ui.notice_until_s) {
        const double left_s = state.ui.notice_until_s - now_s;
        const std::string text =
            state.ui.notice_shows_position ? position_text(state) : state.ui.notice;
        const float lines = state.ui.lead ? 2.6F : 1.5F;  // above its steps
        centred_label(state, text, lines, static_cast<float>(std::min(1.0, left_s)));
    }
}

void draw_over_pictures(const ViewerState& state, const std::function<void()>& drawn) {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const auto call = [](const ImDrawList*, const ImDrawCmd* command) {
        (*static_cast<const std::function<void()>*>(command->UserCallbackData))();
    };
    list.AddCallback(call, const_cast<std::function<void()>*>(&drawn));  // NOLINT: its signature
    if (!state.ui.clip) return;
    const float margin = 12.0F * state.ui.scale;
    constexpr float kLinesAboveBar = 4.4F;  // hints and notices are below
    const float row = ImGui::GetFrameHeight();
    const float top = bar_top(state) - kLinesAboveBar * row;
    red_dot_label(list, clip_text(state), {left_of_label(state, margin, top, row), top});
}

void draw_hint(const ViewerState& state, Hint hint, float alpha) {
    if (alpha <= 0.0F) return;
    constexpr const char* kHints[][2] = {
        {"Move the mouse over the picture. Hold the left button to touch.",
         "Hold the left button to touch."},
        {"The arrow keys move the hand. Hold Space to touch.", "Hold Space to touch."},
        {"Turn the wheel while you press: deeper, or less deep.", "Wheel: press deeper."},
        {"Page up and Page down while you press: deeper, less deep.", "Page up: press deeper."}};
    const auto& [whole, brief] =
        kHints[2 * static_cast<int>(hint) + (state.ui.keys_move_hand ? 1 : 0)];
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const bool fits = ImGui::CalcTextSize(whole).x + 40.0F * state.ui.scale < room;
    centred_label(state, fits ? whole : brief, 0.0F, alpha);
}

void draw_nothing_open(ViewerState& state) {
    const bool is_open = state.touch.replay || !state.media.depth_path.empty();
    if (is_open || state.media.opening || state.ui.dialog.shown || !state.ui.message.empty() ||
        state.ui.depth_offer)
        return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * (display.x - panel_column_width(state)), 0.42F * display.y},
                            ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::Begin("Nothing is open", nullptr,
                 kBareWindow | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextUnformatted("Nothing is open.");
    ImGui::TextDisabled("Drop a colour and a depth file here, a folder or a session, or");
    ImGui::Spacing();
    if (item::button(("Open a recording" + state.keys.in_brackets(Action::open_file)).c_str()))
        state.commands.push(Action::open_file);
    ImGui::End();
}

void draw_message_box(ViewerState& state) {
    if (state.ui.message.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.4F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 32.0F, 0.0F});
    bool open = true;
    ImGui::Begin("That did not work", &open, kTitledWindow);
    ImGui::TextWrapped("%s", state.ui.message.c_str());
    ImGui::Spacing();
    if (item::button(("Close" + state.keys.in_brackets(Action::close_topmost)).c_str()))
        open = false;
    ImGui::End();
    if (!open) state.ui.message.clear();
}

}  // namespace dibhr
