// The way of the keyboard through the panels, laid out without a window.
#include "app/window/keyboard_focus.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>
#include <vector>

#include "app/panels/items.hpp"
#include "tests/app/panels/undrawn_context.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using dibhr::test::UndrawnContext;

namespace {

/// A toolbar of two buttons, and a panel with a check box, a list and perhaps a third item.
class Panels {
  public:
    Panels() { ImGui::GetIO().UserData = &focus; }

    void draw(int times = 1) {
        for (int k = 0; k < times; ++k) draw_once();
    }
    void press(int key, bool shift = false) {
        taken = focus.take({.key = key, .shift = shift}, false);
        draw(3);
    }
    [[nodiscard]] const std::string& label() const { return focus.words().label; }
    [[nodiscard]] const std::string& value() const { return focus.words().value; }

    KeyboardFocus focus{};
    bool taken{false};
    bool checked{false};
    bool has_third{true};
    bool can_play{true};
    int opened{0};
    int chosen{0};

  private:
    void draw_once() {
        ImGui::NewFrame();
        focus.begin();
        ImGui::Begin("Tools", nullptr, ImGuiWindowFlags_NoTitleBar);
        if (item::button("Open##tool")) ++opened;
        ImGui::BeginDisabled(!can_play);
        item::button("Play");
        ImGui::EndDisabled();
        ImGui::End();
        ImGui::Begin("Panel", nullptr, ImGuiWindowFlags_NoTitleBar);
        item::checkbox("Loop", &checked);
        constexpr const char* kNames[] = {"Bark", "Ice", "Wool"};
        item::list_box("##material", "Material", kNames, chosen);
        if (has_third) item::button("Third");
        ImGui::End();
        focus.end(1.0F);
        ImGui::EndFrame();
    }

    UndrawnContext context_{};
};

}  // namespace

TEST_CASE("the keyboard is in the picture until it is asked for", "[focus]") {
    Panels panels;
    panels.press(GLFW_KEY_TAB);
    CHECK_FALSE(panels.taken);
    CHECK(panels.label().empty());
    panels.focus.go_to_area(1);
    panels.draw(2);
    CHECK(panels.label() == "Open");
    CHECK(panels.focus.words().kind == "button");
    panels.focus.leave();
    panels.draw();
    CHECK(panels.label().empty());
    CHECK_FALSE(panels.focus.on());
}

TEST_CASE("the keyboard goes from area to area and behind the last one back to the picture",
          "[focus]") {
    Panels panels;
    for (const char* const label : {"Open", "Loop"}) {
        panels.focus.go_to_area(1);
        panels.draw(2);
        CHECK(panels.label() == label);
    }
    panels.focus.go_to_area(-1);
    panels.draw(2);
    CHECK(panels.label() == "Open");
    panels.focus.go_to_area(2);
    panels.draw(2);
    CHECK_FALSE(panels.focus.on());
    panels.focus.go_to_area(-1);
    panels.draw(2);
    CHECK(panels.label() == "Loop");
}

TEST_CASE("Tab and arrows visit every item once in order and Tab goes around", "[focus]") {
    Panels panels;
    panels.focus.go_to_area(1);
    panels.draw(2);
    std::vector<std::string> visited{panels.label()};
    for (int k = 0; k < 5; ++k) {
        panels.press(GLFW_KEY_TAB);
        visited.push_back(panels.label());
    }
    CHECK(visited == std::vector<std::string>{"Open", "Play", "Loop", "Material", "Third", "Open"});
    panels.press(GLFW_KEY_TAB, true);
    CHECK(panels.label() == "Third");
    panels.press(GLFW_KEY_DOWN);
    CHECK(panels.label() == "Third");
    panels.press(GLFW_KEY_UP);
    CHECK(panels.label() == "Material");
    panels.press(GLFW_KEY_HOME);
    CHECK(panels.label() == "Loop");
    panels.press(GLFW_KEY_END);
    CHECK(panels.label() == "Third");
    panels.can_play = false;
    panels.press(GLFW_KEY_PAGE_UP);
    panels.press(GLFW_KEY_DOWN);
    CHECK(panels.label() == "Loop");
}

TEST_CASE("Space and Enter press what has the keyboard and no key within a picture is lost",
          "[focus]") {
    Panels panels;
    panels.focus.go_to_area(1);
    panels.draw(2);
    panels.press(GLFW_KEY_SPACE);
    panels.press(GLFW_KEY_ENTER);
    CHECK(panels.opened == 2);
    for (const int key :
         {GLFW_KEY_SPACE, GLFW_KEY_SPACE, GLFW_KEY_TAB, GLFW_KEY_TAB, GLFW_KEY_SPACE})
        CHECK(panels.focus.take({.key = key}, false));
    panels.draw(8);
    CHECK(panels.opened == 4);
    CHECK(panels.checked);
    CHECK(panels.label() == "Loop");
    CHECK(panels.value() == "on");
    CHECK_FALSE(panels.focus.busy());
}

TEST_CASE("an open list takes the keyboard at its choice and gives it back", "[focus]") {
    Panels panels;
    panels.chosen = 1;
    panels.focus.go_to_area(2);
    panels.focus.go_to_area(0);
    panels.draw(2);
    while (panels.label() != "Material") panels.press(GLFW_KEY_TAB);
    panels.press(GLFW_KEY_ENTER);
    panels.draw(2);
    CHECK(panels.label() == "Ice");
    panels.press(GLFW_KEY_DOWN);
    CHECK(panels.label() == "Wool");
    panels.press(GLFW_KEY_TAB);
    CHECK(panels.label() == "Bark");
    panels.press(GLFW_KEY_TAB, true);
    panels.press(GLFW_KEY_ENTER);
    panels.draw(2);
    CHECK(panels.chosen == 2);
    CHECK(panels.label() == "Material");
    CHECK(panels.value() == "Wool");
}

TEST_CASE("an item that disappears leaves the keyboard with the one before it", "[focus]") {
    Panels panels;
    panels.focus.go_to_area(-1);
    panels.draw(2);
    panels.press(GLFW_KEY_END);
    REQUIRE(panels.label() == "Third");
    panels.has_third = false;
    panels.draw(2);
    CHECK(panels.label() == "Material");
}
