// GOALS.csv: what is accepted, and what is refused with file, line, column and what to do.
#include "device/goal_stream.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/device/small_relief.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::GoalStream;
using dibhr::TimedGoal;

/// A file of its own, gone with the test.
class GoalsFile {
  public:
    explicit GoalsFile(const std::string& text) { std::ofstream(path(), std::ios::binary) << text; }
    [[nodiscard]] std::filesystem::path path() const { return folder_ / "goals.csv"; }

  private:
    dibhr::test::TemporaryFolder folder_{};
};

std::vector<TimedGoal> goals_of(const std::string& text) {
    return dibhr::read_goals(GoalsFile(text).path());
}

/// The message reading `file` is refused with: one line; empty when it is accepted.
std::string message_for(const std::filesystem::path& file) {
    std::string message;
    try {
        static_cast<void>(dibhr::read_goals(file));
    } catch (const dibhr::InputError& error) {
        message = error.what();
    }
    REQUIRE(message.find('\n') == std::string::npos);
    return message;
}

/// What `text` is refused with, without the file's name in front.
std::string refusal_of(const std::string& text) {
    const GoalsFile file(text);
    const std::string name = file.path().string() + ":";
    const std::string message = message_for(file.path());
    if (message.empty()) return {};
    REQUIRE(message.starts_with(name));
    return message.substr(name.size());
}

}  // namespace

TEST_CASE("goals are read with every digit", "[goals]") {
    const auto goals = goals_of("t,x,y,z\n0,1,2,3\n0.001,0.1,-2.5e-3,1.7976931348623157e308\n");
    REQUIRE(goals.size() == 2);
    CHECK(goals[1].t_s == 0.001);
    CHECK(goals[1].goal_in_grid.x == 0.1);
    CHECK(goals[1].goal_in_grid.y == -2.5e-3);
    CHECK(goals[1].goal_in_grid.z == 1.7976931348623157e308);
}

TEST_CASE("columns may stand in any order, and more than four are no matter", "[goals]") {
    const auto goals = goals_of("z,who,x,t,y\n3,anna,1,0,2\n");
    REQUIRE(goals.size() == 1);
    CHECK_THAT(goals[0].t_s, WithinAbs(0.0, 0.0));
    CHECK_THAT(goals[0].goal_in_grid.x, WithinAbs(1.0, 0.0));
    CHECK_THAT(goals[0].goal_in_grid.y, WithinAbs(2.0, 0.0));
    CHECK_THAT(goals[0].goal_in_grid.z, WithinAbs(3.0, 0.0));
}

TEST_CASE("files as spreadsheets and Windows write them are read", "[goals]") {
    const auto text =
        GENERATE(as<std::string>{}, "\xEF\xBB\xBFt,x,y,z\r\n0,1,2,3\r\n",
                 " t , x,y ,z \n 0, 1 ,2,\t3 ", "t,x,y,z\n\n0,1,2,3\n\n\n", "t,x,y,z,\n0,1,2,3,\n");
    CAPTURE(text);
    const auto goals = goals_of(text);
    REQUIRE(goals.size() == 1);
    CHECK_THAT(goals[0].goal_in_grid.x, WithinAbs(1.0, 0.0));
    CHECK_THAT(goals[0].goal_in_grid.z, WithinAbs(3.0, 0.0));
}

TEST_CASE("equal times are accepted, falling ones are refused", "[goals]") {
    CHECK(refusal_of("t,x,y,z\n0,1,2,3\n0,1,2,3\n").empty());
    CHECK(refusal_of("t,x,y,z\n1,1,2,3\n0.5,1,2,3\n") ==
          "3: column t: time falls; sort the rows by time");
}

TEST_CASE("a missing or doubled column is named", "[goals]") {
    const std::string advice = " is missing; the first line must name the columns t,x,y,z";
    CHECK(refusal_of("t,x,z\n0,1,3\n") == "1: column y" + advice);
    CHECK(refusal_of("0,1,2,3\n") == "1: column t" + advice);
    CHECK(refusal_of("T,X,Y,Z\n0,1,2,3\n") == "1: column t" + advice);
    CHECK(refusal_of("t,x,y,z,x\n0,1,2,3,4\n") == "1: column x stands twice; keep one of them");
}

TEST_CASE("a value that is no finite number is refused with its line and column", "[goals]") {
    struct Case {
        std::string row;
        std::string refusal;
    };
    const auto advice = std::string(" is not a finite number; give one such as 12.5");
    const auto bad = GENERATE_COPY(values<Case>({
        {"0,nan,2,3", "3: column x: 'nan'" + advice},
        {"0,1,-inf,3", "3: column y: '-inf'" + advice},
        {"0,1,2,3px", "3: column z: '3px'" + advice},
        {"0,1,2,1 000", "3: column z: '1 000'" + advice},
        {"zero,1,2,3", "3: column t: 'zero'" + advice},
        {"0,0x10,2,3", "3: column x: '0x10'" + advice},
        {"0,1,2,\x01", "3: column z: '?'" + advice},
        {"0,1,2,", "3: column z: no value; give a number"},
        {"0,1", "3: column y: no value; give a number"},
        {"0,1e999,2,3", "3: column x: '1e999' is out of range; give a smaller number"},
    }));
    CAPTURE(bad.row);
    CHECK(refusal_of("t,x,y,z\n0,1,2,3\n" + bad.row + "\n") == bad.refusal);
}

TEST_CASE("a value of great length does not make a message of great length", "[goals]") {
    CHECK(refusal_of("t,x,y,z\n0,1,2," + std::string(100000, 'q') + "\n").size() < 200);
}

TEST_CASE("a file without rows is refused", "[goals]") {
    CHECK(refusal_of("t,x,y,z\n").find("holds no goals") != std::string::npos);
    CHECK(refusal_of("t,x,y,z\n\r\n \n").find("holds no goals") != std::string::npos);
    CHECK(refusal_of("").find("column t is missing") != std::string::npos);
}

TEST_CASE("a file that is not there, or is a folder, is named with what to do", "[goals]") {
    CHECK(message_for("nowhere/goals.csv") ==
          "nowhere/goals.csv: cannot be opened (No such file or directory); "
          "give a CSV file with the columns t,x,y,z");
    const dibhr::test::TemporaryFolder folder;
    CHECK(message_for(folder.path()) ==
          folder.path().string() + ": is a folder; give a CSV file with the columns t,x,y,z");
}

TEST_CASE("goals are read in blocks, in order of time also from one to the next", "[goals]") {
    const GoalsFile file("t,x,y,z\n0,1,2,3\n1,4,5,6\n\n2,7,8,9\n3,1,1,1\n4,2,2,2\n");
    dibhr::GoalReader reader(file.path());
    std::vector<TimedGoal> block;
    std::vector<double> times_s;
    double share = reader.share_read();
    while (reader.next(2, block)) {
        CHECK(block.size() <= 2);
        for (const TimedGoal& goal : block) times_s.push_back(goal.t_s);
        CHECK(reader.share_read() > share);
        share = reader.share_read();
    }
    CHECK(times_s == std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0});
    CHECK_THAT(share, WithinAbs(1.0, 0.0));
    CHECK(block.empty());

    const GoalsFile falling("t,x,y,z\n0,1,2,3\n1,4,5,6\n0.5,7,8,9\n");
    dibhr::GoalReader first_two(falling.path());
    REQUIRE(first_two.next(2, block));
    CHECK_THROWS_AS(first_two.next(2, block), dibhr::InputError);
}

TEST_CASE("a goal stream gives one row a tick, for ever, whatever the tick and the force",
          "[goals]") {
    GoalStream stream("goals:walk.csv", goals_of("t,x,y,z\n0,1,2,3\n5,4,5,6\n5,7,8,9\n"));
    CHECK(stream.specification().name == "goals:walk.csv");
    const auto relief = dibhr::test::flat();
    for (int k = 0; k < 10; ++k) {
        const auto reading = stream.read({0.001 * k, relief.surface(), 0.1});
        stream.send({1.0, 2.0, 3.0});
        CHECK(reading.ready);
        CHECK(reading.buttons == 0);
        CHECK_THAT(reading.goal_in_grid.x, WithinAbs(1.0 + 3.0 * (k % 3), 0.0));
    }
}
