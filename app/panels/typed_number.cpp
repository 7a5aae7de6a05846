// Reads the typed text from ImGui's text field, which replaces the item meanwhile.
#include "app/panels/typed_number.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

using Halves = std::array<int, 2>;  ///< of a double: ImGui stores 32-bit numbers only

void keep_before(double value) {
    const auto halves = std::bit_cast<Halves>(value);
    ImGui::GetStateStorage()->SetInt(ImGui::GetID("before, low"), halves[0]);
    ImGui::GetStateStorage()->SetInt(ImGui::GetID("before, high"), halves[1]);
}

double kept_before() {
    return std::bit_cast<double>(
        Halves{ImGui::GetStateStorage()->GetInt(ImGui::GetID("before, low")),
               ImGui::GetStateStorage()->GetInt(ImGui::GetID("before, high"))});
}

/// The text that ImGui's field starts with.
std::array<char, 64> text_of(double value, const char* format) {
    std::array<char, 32> digits{};
    format = ImParseFormatTrimDecorations(format, digits.data(), digits.size());
    std::array<char, 64> text{};
    ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), ImGuiDataType_Double,
                                &value, format);
    ImStrTrimBlanks(text.data());
    return text;
}

double typed(ImGuiID id, const char* name, const char* format) {
    const double before = kept_before();
    const std::array<char, 64> begun = text_of(before, format);
    std::array<char, 64> text = begun;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImRect box{corner,
                     {corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()}};
    ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
    if (ImGui::ItemAdd(box, id, nullptr, ImGuiItemFlags_Inputable))
        ImGui::TempInputText(box, id, name, text.data(), static_cast<int>(text.size()),
                             ImGuiInputTextFlags_AutoSelectAll);
    if (text == begun) return before;
    std::replace(text.begin(), text.end(), ',', '.');
    ImStrTrimBlanks(text.data());
    return number_of_text(text.data()).value_or(before);
}

}  // namespace

bool number_item(const char* name, const char* format, double& value,
                 const std::function<void()>& draw) {
    const ImGuiID id = ImGui::GetID(name);
    const double before = value;
    if (ImGui::TempInputIsActive(id)) {
        value = typed(id, name, format);
        return true;
    }
    draw();
    if (!ImGui::TempInputIsActive(id)) return false;
    keep_before(before);
    return true;
}

}  // namespace dibhr
