// Measures first, then draws, so that no page jumps in its second picture.
#include "app/study/page_layout.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr float kLineHeight = 1.3F;   // of the text's
constexpr float kMargin = 1.4F;       // above and below a page [em]
constexpr float kBetween = 1.1F;      // two parts of it [em]
constexpr float kDescender = 0.25F;   // of the text's height
constexpr float kWidestText = 36.0F;  // for easy reading [em]
constexpr float kWidest = 0.94F;      // used share of the window's width
constexpr float kTallestPicture = 0.42F;

const char* next_character(const char* at, const char* end) {
    do ++at;
    while (at < end && (static_cast<unsigned char>(*at) & 0xC0U) == 0x80U);
    return at;
}

void break_lines(const std::string& paragraph, float width, float times,
                 std::vector<std::string>& lines) {
    const char* at = paragraph.c_str();
    const char* const end = at + paragraph.size();
    do {
        const char* stop = ImGui::GetFont()->CalcWordWrapPositionA(times, at, end, width);
        if (stop == at && at < end) stop = next_character(at, end);
        lines.emplace_back(at, stop);
        at = stop;
        while (at < end && *at == ' ') ++at;
    } while (at < end);
}

float width_of(const std::string& line, float times) {
    return ImGui::GetFont()
        ->CalcTextSizeA(times * em(), FLT_MAX, 0.0F, line.c_str(), line.c_str() + line.size())
        .x;
}

float window_width() {
    return ImGui::GetWindowWidth();
}

/// A button of a group: its place in the group, and its label.
struct ButtonPlace {
    ImVec2 at{0.0F, 0.0F}, size{0.0F, 0.0F};
    TextBlock label{};
};

struct ButtonPlaces {
    std::vector<ButtonPlace> places{};
    float height{0.0F};
};

/// Row after row, each centred; all buttons of a row get the height of its highest.
void put_in_rows(ButtonPlaces& all, std::size_t columns, float between) {
    for (std::size_t first = 0; first < all.places.size(); first += columns) {
        const std::span<ButtonPlace> row =
            std::span(all.places).subspan(first, std::min(columns, all.places.size() - first));
        float wide = -between;
        float high = 0.0F;
        for (const ButtonPlace& place : row) {
            wide += place.size.x + between;
            high = std::max(high, place.size.y);
        }
        if (first > 0) all.height += between;
        float x = 0.5F * (window_width() - wide);
        for (ButtonPlace& place : row) {
            place.at = {x, all.height};
            place.size.y = high;
            x += place.size.x + between;
        }
        all.height += high;
    }
}

ButtonPlaces placed(const ButtonGroup& group) {
    const float most = kWidest * window_width();
    const float around = 2.0F * group.space * em();
    ButtonPlaces all;
    float widest = 0.0F;
    float wide = -0.8F * em();
    for (const std::string& text : group.labels) {
        TextBlock label = text_block(text, most - around);
        const float width = std::max(group.least_width * em(), label.size.x + around);
        all.places.push_back({.size = {width, label.size.y + 1.1F * em()}, .label = label});
        widest = std::max(widest, width);
        wide += width + 0.8F * em();
    }
    if (wide <= most) {
        put_in_rows(all, std::max<std::size_t>(all.places.size(), 1), 0.8F * em());
        return all;
    }
    const float between = 0.5F * em();
    for (ButtonPlace& place : all.places) place.size = {widest, place.label.size.y + 0.8F * em()};
    const auto columns = static_cast<std::size_t>((most + between) / (widest + between));
    put_in_rows(all, std::max<std::size_t>(columns, 1), between);
    return all;
}

bool button(const ButtonPlace& place, ImVec2 origin) {
    const ImVec2 at{origin.x + place.at.x, origin.y + place.at.y};
    ImGui::SetCursorScreenPos(at);
    const bool clicked = ImGui::Button("##button", place.size);
    draw_text(place.label,
              {at.x + 0.5F * (place.size.x - place.label.size.x),
               at.y + 0.5F * (place.size.y - place.label.size.y)},
              LineAlign::middle);
    return clicked;
}

std::optional<int> buttons(const ButtonGroup& group, const ButtonPlaces& all) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    std::optional<int> clicked;
    ImGui::BeginDisabled(!group.enabled);
    for (int k = 0; k < static_cast<int>(all.places.size()); ++k) {
        ImGui::PushID(k);
        const bool lit = k == group.marked;
        for (const ImGuiCol ground : {ImGuiCol_Button, ImGuiCol_ButtonHovered})
            if (lit) ImGui::PushStyleColor(ground, ImGui::GetColorU32(ImGuiCol_SliderGrab));
        if (button(all.places[static_cast<std::size_t>(k)], origin)) clicked = k;
        if (lit) ImGui::PopStyleColor(2);
        ImGui::PopID();
    }
    ImGui::EndDisabled();
    return clicked;
}

float height_of(std::span<const FootPart> foot) {
    float height = 0.0F;
    for (const FootPart& part : foot) height += part.height + kBetween * em();
    return std::max(0.0F, height - kBetween * em());
}

/// Draws the parts from the cursor down.
std::optional<StudyPress> draw_foot(std::span<const FootPart> foot) {
    std::optional<StudyPress> press;
    float top = ImGui::GetCursorPosY();
    for (std::size_t k = 0; k < foot.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        ImGui::SetCursorPos({0.0F, top});
        if (const auto pressed = foot[k].draw()) press = pressed;
        top += foot[k].height + kBetween * em();
        ImGui::PopID();
    }
    return press;
}

ImVec2 picture_size(const PageBody& body) {
    if (body.picture == 0) return {0.0F, 0.0F};
    const auto columns = static_cast<float>(body.picture_columns);
    const auto rows = static_cast<float>(body.picture_rows);
    const float factor = std::min(0.8F * window_width() / columns,
                                  kTallestPicture * ImGui::GetWindowHeight() / rows);
    return {factor * columns, factor * rows};
}

/// A body with its measured sizes.
struct MeasuredBody {
    ImVec2 picture{0.0F, 0.0F};
    std::vector<TextBlock> blocks{};
    float height{0.0F};
};

MeasuredBody measured(const PageBody& body) {
    MeasuredBody whole{.picture = picture_size(body)};
    const float between = 0.6F * em();
    const float widest = std::min(0.8F * window_width(), kWidestText * em());
    whole.height = -between;
    if (body.picture != 0) whole.height += whole.picture.y + between;
    for (const PageText& text : body.texts) {
        if (text.text.empty()) continue;
        whole.blocks.push_back(text_block(text.text, widest, text.times));
        whole.height += whole.blocks.back().size.y + between;
    }
    // Else the pane cuts off the last line's g and y.
    whole.height = std::max(0.0F, whole.height) + kDescender * em();
    return whole;
}

/// Draws at the cursor. Each text is a centred column.
void draw_body(const PageBody& body, const MeasuredBody& whole, float width) {
    float top = ImGui::GetCursorPosY();
    const auto place = [&](ImVec2 size) {
        ImGui::SetCursorPos({0.5F * (width - size.x), top});
        top += size.y + 0.6F * em();
    };
    if (body.picture != 0) {
        place(whole.picture);
        ImGui::Image(texture_id<ImTextureID>(body.picture), whole.picture);
    }
    std::size_t k = 0;
    for (const PageText& text : body.texts) {
        if (text.text.empty()) continue;
        const TextBlock& block = whole.blocks[k++];
        place(block.size);
        draw_text(block, ImGui::GetCursorScreenPos(), text.align, text.dimmed);
        ImGui::Dummy(block.size);
    }
}

/// A part of the window over its full width.
struct Pane {
    const char* name;
    float top, shown;  // [px]
    float height;      // of its content
    [[nodiscard]] bool fits() const {
        constexpr float kRounding_px = 1.0F;
        return height <= shown + kRounding_px;
    }
};

/// Draws a pane, which scrolls where its content is higher.
template <typename Draw>
void draw_pane(const Pane& pane, bool first_picture, float scroll, const Draw& draw) {
    if (pane.shown <= 0.0F) return;
    ImGui::SetCursorPos({0.0F, pane.top});
    ImGui::PushStyleVar(ImGuiStyleVar_ScrollbarSize, 0.7F * em());
    ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    ImGui::PushStyleColor(ImGuiCol_ScrollbarBg, ImGui::GetColorU32(ImGuiCol_FrameBg));
    ImGui::BeginChild(
        pane.name, {window_width(), pane.shown}, false,
        ImGuiWindowFlags_NoNav |
            (pane.fits() ? ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse
                         : ImGuiWindowFlags_AlwaysVerticalScrollbar));
    if (first_picture)
        ImGui::SetScrollY(0.0F);
    else if (std::abs(scroll) > 0.0F)
        ImGui::SetScrollY(std::max(0.0F, ImGui::GetScrollY() + scroll * kLineHeight * em()));
    draw();
    ImGui::SetCursorPos({0.0F, pane.height});
    ImGui::Dummy({1.0F, 0.0F});
    ImGui::EndChild();
    ImGui::PopStyleColor(2);
    ImGui::PopStyleVar();
}

}  // namespace

float em() {
    return ImGui::GetFontSize();
}

TextBlock text_block(const std::string& text, float most_width, float times) {
    TextBlock block{.times = times};
    std::istringstream paragraphs(text);
    for (std::string line; std::getline(paragraphs, line);)
        break_lines(line, most_width, times, block.lines);
    for (const std::string& line : block.lines)
        block.size.x = std::max(block.size.x, width_of(line, times));
    // Without the space below the last line, so that a single line is centred vertically.
    const auto count = static_cast<float>(block.lines.size());
    block.size.y =
        block.lines.empty() ? 0.0F : times * em() * (1.0F + kLineHeight * (count - 1.0F));
    return block;
}

void draw_text(const TextBlock& block, ImVec2 at, LineAlign align, bool dimmed) {
    const ImU32 colour = ImGui::GetColorU32(dimmed ? ImGuiCol_TextDisabled : ImGuiCol_Text);
    const float share = align == LineAlign::left ? 0.0F : align == LineAlign::middle ? 0.5F : 1.0F;
    for (const std::string& line : block.lines) {
        const float free = block.size.x - width_of(line, block.times);
        ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), block.times * em(),
                                            {at.x + share * free, at.y}, colour, line.c_str(),
                                            line.c_str() + line.size());
        at.y += block.times * kLineHeight * em();
    }
}

FootPart button_part(const ButtonGroup& group, std::function<StudyPress(int)> press_of) {
    const ButtonPlaces all = placed(group);
    return {all.height, [group, all, press_of = std::move(press_of)]() {
                const auto clicked = buttons(group, all);
                return clicked ? std::optional(press_of(*clicked)) : std::nullopt;
            }};
}

FootPart note_part(const std::string& text) {
    const TextBlock block = text_block(text, kWidest * window_width());
    return {block.size.y, [block]() -> std::optional<StudyPress> {
                const ImVec2 at = ImGui::GetCursorScreenPos();
                draw_text(block, {at.x + 0.5F * (window_width() - block.size.x), at.y},
                          LineAlign::middle, true);
                return std::nullopt;
            }};
}

std::optional<StudyPress> draw_page(const PageBody& body, std::span<const FootPart> foot) {
    const float high = ImGui::GetWindowHeight();
    const float width = window_width();
    const float margin = kMargin * em();
    const MeasuredBody whole = measured(body);
    // The buttons get all the room that they need, except for a part of the text.
    const float room = high - 3.0F * margin;
    const float foot_height = height_of(foot);
    const float foot_shown = std::min(foot_height, room - std::min(whole.height, 0.3F * high));
    const float body_shown = std::min(whole.height, room - foot_shown);
    const float lowest = high - 2.0F * margin - foot_shown - body_shown;
    const float top = std::max(margin, std::min(body.top * high, lowest));
    const Pane above{"body", top, body_shown, whole.height};
    const Pane below{"foot", top + body_shown + margin, foot_shown, foot_height};
    draw_pane(above, body.first_picture, body.scroll, [&] { draw_body(body, whole, width); });
    std::optional<StudyPress> press;
    draw_pane(below, body.first_picture, above.fits() ? body.scroll : 0.0F,
              [&] { press = draw_foot(foot); });
    return press;
}

std::optional<StudyPress> draw_at_bottom(std::span<const FootPart> foot) {
    ImGui::SetCursorPosY(ImGui::GetWindowHeight() - kMargin * em() - height_of(foot));
    return draw_foot(foot);
}

float draw_label(const std::string& text, float top, float times) {
    const TextBlock block = text_block(text, 0.8F * window_width(), times);
    const float pad = 0.5F * em();
    const float x = 0.5F * (window_width() - block.size.x);
    const float bottom = top + block.size.y + 2.0F * pad;
    ImGui::GetWindowDrawList()->AddRectFilled({x - 2.0F * pad, top},
                                              {x + block.size.x + 2.0F * pad, bottom},
                                              ImGui::GetColorU32(ImGuiCol_PopupBg), 0.4F * em());
    draw_text(block, {x, top + pad}, LineAlign::middle);
    return bottom;
}

}  // namespace dibhr
