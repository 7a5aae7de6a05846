// The homing guide of the Device panel: an animation of the grip pulled out and pushed in, and
// which axes are homed.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr float kHeight = 5.2F;   // of the picture, text lines
constexpr double kOut_s = 1.6;    // pulling the grip out
constexpr double kPause_s = 0.6;  // after each movement
constexpr double kIn_s = 1.2;     // pushing it in
constexpr double kCycle_s = kOut_s + kIn_s + 2.0 * kPause_s;

/// The grip's position, 0: in, 1: all the way out, and which of the two steps is shown.
struct Movement {
    float out{0.0F};
    bool pulling{true};
};

float eased(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return static_cast<float>(s * s * (3.0 - 2.0 * s));
}

Movement movement_at(double t_s) {
    const double t = std::fmod(t_s, kCycle_s);
    if (t < kOut_s + kPause_s) return {eased(t / kOut_s), true};
    return {1.0F - eased((t - kOut_s - kPause_s) / kIn_s), false};
}

ImVec2 between(ImVec2 from, ImVec2 to, float share) {
    return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
}

/// One leg: a thigh from the base to the elbow, and a shin from the elbow to the grip.
void draw_leg(ImDrawList& list, ImVec2 hip, ImVec2 grip, float up, float unit, ImU32 colour) {
    const ImVec2 middle = between(hip, grip, 0.42F);
    const ImVec2 elbow{middle.x, middle.y - up * unit * 0.75F};
    list.AddLine(hip, elbow, colour, unit * 0.16F);
    list.AddLine(elbow, grip, colour, unit * 0.10F);
    list.AddCircleFilled(elbow, unit * 0.12F, colour);
}

void draw_arrow(ImDrawList& list, ImVec2 from, ImVec2 to, float unit, ImU32 colour) {
    const float way = to.x > from.x ? 1.0F : -1.0F;
    list.AddLine(from, {to.x - way * unit * 0.3F, to.y}, colour, unit * 0.12F);
    list.AddTriangleFilled({to.x, to.y}, {to.x - way * unit * 0.45F, to.y - unit * 0.28F},
                           {to.x - way * unit * 0.45F, to.y + unit * 0.28F}, colour);
}

void draw_device(ImDrawList& list, ImVec2 low, ImVec2 high, const Movement& movement) {
    const float unit = (high.y - low.y) / kHeight;
    const float middle = (low.y + high.y) * 0.5F;
    const ImU32 body = ImGui::GetColorU32(ImGuiCol_ButtonActive);
    const ImU32 legs = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    const ImU32 accent = ImGui::GetColorU32(ImGuiCol_CheckMark);
    const float left = (low.x + high.x) * 0.5F - 5.5F * unit;
    const float front = left + 1.8F * unit;
    const float in = front + 1.6F * unit;
    const float out = front + 8.0F * unit;
    const ImVec2 grip{in + (out - in) * movement.out, middle};
    list.AddRectFilled({left, middle - 1.7F * unit}, {front, middle + 1.7F * unit}, body,
                       unit * 0.6F);
    draw_leg(list, {front, middle - 1.1F * unit}, grip, 1.0F, unit, legs);
    draw_leg(list, {front, middle + 1.1F * unit}, grip, -1.0F, unit, legs);
    list.AddCircleFilled(grip, unit * 0.8F, accent, 32);
    const float y = high.y - 0.15F * unit;
    movement.pulling ? draw_arrow(list, {in, y}, {out, y}, unit, accent)
                     : draw_arrow(list, {out, y}, {in, y}, unit, accent);
}

void draw_step(const char* text, bool now) {
    ImGui::PushStyleColor(
        ImGuiCol_Text, ImGui::GetStyleColorVec4(now ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void draw_axis(const HomedAxis& axis) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(axis.name);
    ImGui::TableNextColumn();
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 centre{low.x + line * 0.5F, low.y + line * 0.5F};
    const ImU32 colour =
        ImGui::GetColorU32(axis.homed ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (axis.homed) {
        list.AddCircleFilled(centre, line * 0.32F, colour, 20);
    } else {
        list.AddCircle(centre, line * 0.32F, colour, 20, line * 0.1F);
    }
    ImGui::Dummy({line, line});
    ImGui::SameLine();
    ImGui::TextUnformatted(axis.homed ? "homed" : "not yet");
    ImGui::TableNextColumn();
    const std::string text = formatted("%d counts", axis.counts);
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, room));
    ImGui::TextDisabled("%s", text.c_str());
}

}  // namespace

void draw_homing_guide(const std::vector<HomedAxis>& axes) {
    const Movement movement = movement_at(ImGui::GetTime());
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, kHeight * ImGui::GetTextLineHeight()};
    draw_device(*ImGui::GetWindowDrawList(), low, {low.x + size.x, low.y + size.y}, movement);
    ImGui::Dummy(size);
    draw_step("1  Pull the grip all the way out", movement.pulling);
    draw_step("2  Push it straight in", !movement.pulling);
    if (!ImGui::BeginTable("axes", 3)) return;
    for (const HomedAxis& axis : axes) draw_axis(axis);
    ImGui::EndTable();
}

}  // namespace dibhr
