// Numbers that are typed into the rows of the panels.
#include <imgui.h>

#include <array>
#include <string>
#include <utility>

#include "app/panels/widgets.hpp"
#include "tests/app/panels/undrawn_context.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// TypedRows in an ImGui window that is not drawn, with simulated mouse and keys.
class TypedRows {
  public:
    TypedRows() {
        picture();
        picture();
    }

    /// Ctrl+click on a row's first value.
    void click(int row) {
        ImGuiIO& io = ImGui::GetIO();
        const ImVec2 at{0.5F * io.DisplaySize.x, middles_[static_cast<std::size_t>(row)]};
        mouse(at, false, true);
        picture();
        mouse(at, true, true);
        picture();
        mouse(at, false, false);
        picture();
    }
    /// One key in each picture.
    void type(const std::string& text) {
        for (const char key : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(key));
            picture();
        }
    }
    /// A click outside the rows, which ends the typing.
    void leave() {
        mouse({790.0F, 590.0F}, true, false);
        picture();
        mouse({790.0F, 590.0F}, false, false);
        picture();
    }

    double stiffness{2.25};
    std::array<double, 2> range{1.0, 9.0};
    Dragged dragged{};

  private:
    static void mouse(ImVec2 at, bool down, bool control) {
        ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 18700
        io.MousePos = at;
        io.MouseDown[0] = down;
        io.KeyCtrl = control;
#else
        io.AddKeyEvent(ImGuiMod_Ctrl, control);
        io.AddMousePosEvent(at.x, at.y);
        io.AddMouseButtonEvent(0, down);
#endif
    }

    void picture() {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0.0F, 0.0F});
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::Begin("rows", nullptr, ImGuiWindowFlags_NoTitleBar);
        middles_[0] = ImGui::GetCursorScreenPos().y + 0.5F * ImGui::GetFrameHeight();
        number_row({.label = "Stiffness",
                    .format = "%.2f N/mm",
                    .lowest = 0.0,
                    .highest = 4.0,
                    .standard = 1.0},
                   stiffness);
        middles_[1] = ImGui::GetCursorScreenPos().y + 0.5F * ImGui::GetFrameHeight();
        const Dragged now = dragged_row({.label = "Range",
                                         .format = "%.1f",
                                         .lowest = 0.0,
                                         .highest = 10.0,
                                         .speed = 0.1F,
                                         .help = "",
                                         .changed = false},
                                        range);
        if (now != Dragged::nothing) dragged = now;
        ImGui::End();
        ImGui::Render();
    }

    test::UndrawnContext context_{};
    std::array<float, 2> middles_{};
};

}  // namespace

TEST_CASE(
    "a number is typed with a decimal point or a decimal comma, and other text changes nothing",
    "[panels]") {
    const auto [text, value] = GENERATE(table<std::string, double>({
        {"0,7", 0.7},
        {"0.7", 0.7},
        {",7", 0.7},
        {"-0,5", -0.5},
        {"7", 7.0},
        {"1e-2", 0.01},
        {" 0,7 ", 0.7},
        {"1.000,5", 2.25},
        {"1,000.5", 2.25},
        {"0,7,1", 2.25},
        {"0,7 N", 2.25},
        {"1e999", 2.25},
        {"nan", 2.25},
        {"seven", 2.25},
        {",", 2.25},
        {" ", 2.25},
    }));
    CAPTURE(text);
    TypedRows rows;
    rows.click(0);
    rows.type(text);
    rows.leave();
    CHECK(rows.stiffness == value);
    rows.leave();
    CHECK(rows.stiffness == value);
}

TEST_CASE("a row that is left as it was keeps digits that it does not show", "[panels]") {
    TypedRows rows;
    rows.stiffness = 2.0 / 3.0;
    rows.click(0);
    rows.leave();
    CHECK(rows.stiffness == 2.0 / 3.0);
}

TEST_CASE("values side by side are typed likewise, within their range", "[panels]") {
    TypedRows rows;
    rows.click(1);
    rows.type("2,5");
    rows.leave();
    CHECK(rows.range == std::array{2.5, 9.0});
    CHECK(rows.dragged == Dragged::done);
    rows.click(1);
    rows.type("70,5");
    rows.leave();
    CHECK(rows.range == std::array{10.0, 9.0});
}
