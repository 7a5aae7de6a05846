// The queue of commands from panels and keys.
#include "app/panels/commands.hpp"

#include <chrono>
#include <variant>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("a command that is asked for twice before it is done is done once, in its place",
          "[commands]") {
    CommandQueue queue;
    queue.push(LoadBump{"first.png"});
    queue.push(Action::take_screenshot);
    queue.push(LoadBump{"last.png"});
    const std::vector<WindowCommand> asked = queue.take();
    REQUIRE(asked.size() == 2);
    CHECK(std::get<LoadBump>(asked[0]).file == "last.png");
    CHECK(std::get<Action>(asked[1]) == Action::take_screenshot);
    CHECK(queue.empty());
    queue.push(LoadBump{"next.png"});  // after it was taken
    CHECK(queue.take().size() == 1);
}

TEST_CASE("each action counts: two quick presses of a key are a start and an end", "[commands]") {
    CommandQueue queue;
    queue.push(Action::record);
    queue.push(Action::mark);
    queue.push(Action::record);
    const std::vector<WindowCommand> asked = queue.take();
    REQUIRE(asked.size() == 3);
    CHECK(std::get<Action>(asked[0]) == Action::record);
    CHECK(std::get<Action>(asked[1]) == Action::mark);
    CHECK(std::get<Action>(asked[2]) == Action::record);
}

TEST_CASE("each moment that is marked counts", "[commands]") {
    const std::chrono::steady_clock::time_point first{std::chrono::seconds(1)};
    const std::chrono::steady_clock::time_point second{std::chrono::seconds(2)};
    CommandQueue queue;
    queue.push(MarkMoment{first});
    queue.push(MarkMoment{second});
    const std::vector<WindowCommand> asked = queue.take();
    REQUIRE(asked.size() == 2);
    CHECK(std::get<MarkMoment>(asked[0]).at == first);
    CHECK(std::get<MarkMoment>(asked[1]).at == second);
}
