// Sessions of every schema that there was, kept as SQL in tests/data/sessions, and of one to come.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/session/session.hpp"
#include "core/session/session_schema.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// Makes the session of that name in tests/data/sessions.
void make_session(const SessionFolder& folder, const std::string& name) {
    const auto sql = std::filesystem::path(DIBHR_SOURCE_DIR) / "tests/data/sessions" / name;
    REQUIRE(change(folder.file(), read_text(sql)));
}

std::vector<TickRecord> ticks_from(const Session& session, double from_s = 0.0) {
    std::vector<TickRecord> all;
    Session::Ticks ticks(session, from_s);
    for (TickRecord tick; ticks.next(tick);) all.push_back(tick);
    return all;
}

std::string error_of(const std::filesystem::path& file) {
    try {
        (void)ticks_from(Session(file));
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// A cell of the view `tick`, as text.
std::string cell(const Session& session, const std::string& column, int tick) {
    Statement row = session.reader().rows("SELECT " + column +
                                          " FROM tick WHERE tick = " + std::to_string(tick));
    REQUIRE(row.next());
    return row.has(0) ? row.text(0) : "NULL";
}

}  // namespace

TEST_CASE("a session of the first schema is read, and stays as it is", "[session]") {
    const SessionFolder folder;
    make_session(folder, "schema_1.sql");
    const std::string before = sha256_of_file(folder.file());
    {
        const Session session(folder.file());
        session.check();
        CHECK(session.fact("note") == "of the first day");
        CHECK(session.rows() == 3);
        CHECK(session.missing() == 1);
        CHECK(session.begin_s() == 0.001);
        CHECK(session.end_s() == 0.004);
        CHECK(session.parameters().empty());
        CHECK(session.sources().empty());
        CHECK(session.marks().empty());
        CHECK(session.maps_of(1).empty());
        CHECK(late_ticks(session.reader()) == 1);
        CHECK(hand_ticks(session.reader()).all == 3);
        CHECK(contains(session.warning(), folder.file().string() + ": is of format 1"));
        CHECK(contains(session.warning(), "exported, but not replayed"));

        const std::vector<TickRecord> ticks = ticks_from(session);
        REQUIRE(ticks.size() == 3);
        const TickRecord& first = ticks[0];
        CHECK(first.tick == 1);
        CHECK(first.t_s == 0.001);
        CHECK(first.dt_s == 0.001);
        CHECK(first.lateness_us == 2.5);
        CHECK(first.update_us == 0.7);
        CHECK(same_bits(first.goal, {10.5, 12.25, -3.5}));
        CHECK(same_bits(first.proxy, {10.5, 12.25, 100.0}));
        CHECK(same_bits(first.spring_newton, {0.0, 0.0, 7.3}));
        CHECK(same_bits(first.sent_newton, {0.0, 0.0, 3.65}));
        CHECK(same_bits(first.own_newton, Vec3(0.0)));
        CHECK(first.contact);
        CHECK(first.primitive == 1);
        CHECK(first.i == 10);
        CHECK(first.j == 12);
        CHECK(first.moves == 3);
        CHECK(first.buttons == 1);
        CHECK(first.blend == 0.25);
        CHECK(first.frames.from_frame == 1);
        CHECK(first.frames.to_frame == 2);
        CHECK(first.video_s == 0.04);
        CHECK(first.surface);
        CHECK(first.device_ready);
        CHECK_FALSE(first.catching_up);
        CHECK(ticks[1].cut == 3);
        CHECK(ticks[2].tick == 4);
        CHECK(ticks_from(session, 0.002).size() == 2);
        CHECK(cell(session, "utc_s", 1) == "NULL");
    }
    CHECK(sha256_of_file(folder.file()) == before);
}

TEST_CASE("what came after a session was recorded is off in it, by any view", "[session]") {
    const SessionFolder folder;
    make_session(folder, GENERATE("schema_2_first_view.sql", "schema_2_first.sql"));
    const Session session(folder.file());
    session.check();
    CHECK(session.warning().empty());
    CHECK(session.rows() == 80);
    CHECK(session.missing() == 0);
    REQUIRE(session.parameters().size() == 2);
    const SessionParameters& parameters = session.parameters()[1];
    CHECK(parameters.first_tick == 60);
    CHECK(parameters.touch.algorithm == Algorithm::dibhr);
    CHECK(parameters.touch.friction.static_coefficient == 0.0);
    CHECK(parameters.touch.coupling.stiffness_newton_per_mm == 5.0);
    CHECK(parameters.touch.coupling.damping_cutoff_hz == 0.0);
    CHECK(parameters.touch.coupling.unseen_share == 1.0);
    CHECK(parameters.touch.shape.bump_size_px == 0.0);
    CHECK_FALSE(parameters.touch.carry);
    CHECK(parameters.limits.max_force_newton == 4.0);
    CHECK(parameters.limits.watched == DeviceDynamics{});
    REQUIRE(session.sources().size() == 1);
    CHECK(session.sources()[0].source == FrameSource{.media = 1});
    CHECK(session.sources()[0].depth.file == "/films/hill_depth.png");
    CHECK(session.sources()[0].depth.head_bytes == 0);
    REQUIRE(session.marks().size() == 1);
    CHECK(session.marks()[0].tag == "M1");
    REQUIRE(session.utc_at(session.begin_s()));
    CHECK(ticks_from(session)[0].utc_s == *session.utc_at(session.begin_s()));
}

TEST_CASE("a walk that two versions recorded, each with its own view, has the same ticks in both",
          "[session]") {
    const SessionFolder early;
    const SessionFolder late;
    make_session(early, "schema_2_first_view.sql");
    make_session(late, "schema_2_first.sql");
    const std::vector<TickRecord> first = ticks_from(Session(early.file()));
    const std::vector<TickRecord> second = ticks_from(Session(late.file()));
    REQUIRE(first.size() == 80);
    REQUIRE(second.size() == first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        CAPTURE(first[k].tick);
        CHECK(same_record(first[k], second[k]));
    }
    CHECK(first[0].from_zero);
    CHECK(first[0].buttons == 1);
    CHECK(first[0].contact);
    CHECK(first[0].primitive == 1);
    CHECK(first[0].i == 17);
    CHECK(same_bits(first[0].proxy, {17.384999999999998, 15.3125, 94.77}));
    CHECK(first[39].cut == 3);
    CHECK_FALSE(first[39].device_ready);
    CHECK(first[39].surface);
    CHECK(same_bits(first[51].own_newton, {0.1, -0.2, 1.0 / 3.0}));
    CHECK(same_bits(first[69].sent_newton, first[69].spring_newton));
    CHECK_FALSE(first[69].gliding);
    CHECK_FALSE(first[75].surface);
    CHECK(first[78].mouse_fallback);
    CHECK(first[79].t_s == 0.0800000000001);
}

TEST_CASE("a session of a schema to come is read as far as it is understood", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const std::string next = "PRAGMA user_version = " + std::to_string(kSessionSchemaVersion + 1);
    SECTION("with nothing new") {
        REQUIRE(change(folder.file(), next));
        CHECK(contains(Session(folder.file()).warning(),
                       "by a newer dibhr (format " + std::to_string(kSessionSchemaVersion + 1) +
                           ", this one reads " + std::to_string(kSessionSchemaVersion) + ")"));
        CHECK(
            contains(Session(folder.file()).warning(), "no table or column of it is unknown here"));
    }
    SECTION("with tables and columns, and ticks coded otherwise") {
        REQUIRE(change(folder.file(),
                       "CREATE TABLE surface_tile(tick, x, y, levels BLOB);"
                       "ALTER TABLE mark ADD COLUMN utc_s REAL;"
                       "ALTER TABLE tick_data ADD COLUMN glove;" +
                           next));
        const std::string view =
            answer(folder.file(), "SELECT sql FROM sqlite_master WHERE name = 'tick'");
        std::string coded = view;
        coded.replace(coded.find("CAST(d.gx AS REAL)"), 18, "CAST(d.gx / 2.0 AS REAL)");
        REQUIRE(
            change(folder.file(), "UPDATE tick_data SET gx = gx * 2.0; DROP VIEW tick;" + coded));
        CHECK(contains(Session(folder.file()).warning(),
                       "; not read: mark.utc_s, tick_data.glove, surface_tile; update dibhr"));
    }
    const Session session(folder.file());
    session.check();
    const std::vector<TickRecord> ticks = ticks_from(session);
    REQUIRE(ticks.size() == 10);
    CHECK(ticks[7].goal.x == 7.0);
    CHECK_FALSE(contains(session.warning(), "\n"));
}

TEST_CASE("what no reader can take of a schema to come is refused, with the next step",
          "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const auto& [sql, words] = GENERATE(from_range(std::vector<std::pair<std::string, std::string>>{
        {"DROP VIEW tick", "its tables"},
        {"DROP TABLE pair", "its tables"},
        {"DROP VIEW tick; CREATE VIEW tick AS SELECT tick, t FROM tick_data", "no such column"},
        {"DROP VIEW tick; CREATE VIEW tick AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL "
         "SELECT x + 1 FROM c) SELECT x AS t, x AS tick FROM c",
         "would not end"}}));
    CAPTURE(sql);
    REQUIRE(change(folder.file(), sql + "; PRAGMA user_version = 99"));
    const std::string error = error_of(folder.file());
    CHECK(contains(error, folder.file().string() + ": "));
    CHECK(contains(error, words));
    CHECK(contains(error, "update dibhr"));
    CHECK_FALSE(contains(error, "\n"));
}
