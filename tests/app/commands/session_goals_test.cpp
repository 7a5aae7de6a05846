// Goals read back from a recorded session.
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/commands/experiment_human.hpp"
#include "core/error.hpp"
#include "core/session/session_file.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A session of 100 ticks that touches from tick `first_contact` on; none when it is negative.
void record(const SessionFolder& folder, std::int64_t first_contact) {
    SessionFile session(folder.file(), {{"columns", "640"}});
    session.begin();
    for (std::int64_t k = 0; k < 100; ++k) {
        TickRecord tick = tick_record(k);
        tick.contact = first_contact >= 0 && k >= first_contact;
        tick.frames.from_frame = k / 33;
        tick.blend = 0.25;
        session.add(tick);
    }
    session.commit();
}

}  // namespace

TEST_CASE("a session's goals begin a little before its first contact", "[session]") {
    const SessionFolder folder;
    record(folder, 40);
    const Session session(folder.file());
    const std::vector<RecordedGoal> goals = read_session_goals(session, 10, 50);
    REQUIRE(goals.size() == 50);
    CHECK(goals[0].goal == Vec3{30.0, 30.1, 30.2});
    CHECK(goals[49].goal.x == 79.0);
    CHECK(goals[49].frame == 2);
    CHECK(goals[0].blend == 0.25);
    CHECK(session.fact("columns") == "640");
    CHECK(read_session_goals(session, 1000, 1000).size() == 100);
}

TEST_CASE("a session without contact, an empty file and a foreign one are refused", "[session]") {
    const SessionFolder folder;
    record(folder, -1);
    for (const auto& file : {folder.file(), folder.path() / "none.dibhr", folder.path()})
        CHECK_THROWS_AS(read_session_goals(Session(file), 10, 50), InputError);
}
