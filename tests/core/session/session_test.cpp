// A session read back: its ticks, and the rows to which they refer.
#include "core/session/session.hpp"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/content_hash.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session_schema.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comma_locale.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

TEST_CASE("ticks are read from any time on", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 1000);
    const Session session(folder.file());
    CHECK(session.rows() == 1000);
    CHECK_THAT(session.begin_s(), WithinAbs(0.0, 0.0));
    CHECK_THAT(session.end_s(), WithinAbs(0.999, 1e-12));
    for (const std::int64_t first : {0, 1, 499, 999}) {
        Session::Ticks ticks(session, static_cast<double>(first) * 0.001 - 1e-6);
        TickRecord tick;
        REQUIRE(ticks.next(tick));
        CHECK(tick.tick == first);
    }
    Session::Ticks none(session, 1.0);
    TickRecord tick;
    CHECK_FALSE(none.next(tick));
}

TEST_CASE("a file of before a parameter gives its default, and the others as they were",
          "[session]") {
    const SessionFolder folder;
    SessionParameters recorded{.version = 5, .touch = {}, .limits = {}, .bump = {}};
    recorded.touch.carry = true;
    double unusual = 0.3;
    visit_numbers(recorded,
                  [&unusual](std::string_view, double& number) { number = unusual += 0.01; });
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        recorder.parameters(recorded);
        TickRecord tick = tick_record(0);
        tick.settings = recorded.version;
        push(*ring, tick);
    }
    CHECK(Session(folder.file()).parameters().at(0).touch == recorded.touch);
    CHECK(Session(folder.file()).parameters().at(0).limits == recorded.limits);
    REQUIRE(change(folder.file(), "ALTER TABLE parameters DROP COLUMN damping_cutoff_hz"));
    REQUIRE(change(folder.file(), "ALTER TABLE parameters DROP COLUMN carry"));
    recorded.touch.coupling.damping_cutoff_hz = Coupling{}.damping_cutoff_hz;
    recorded.touch.carry = false;
    CHECK(Session(folder.file()).parameters().at(0).touch == recorded.touch);
    CHECK(Session(folder.file()).parameters().at(0).limits == recorded.limits);
}

TEST_CASE("parameters, files and marks are kept with the tick that first used them", "[session]") {
    const SessionFolder folder;
    const auto depth = folder.path() / "depth.mp4";
    std::ofstream(depth) << "not much of a video";
    SessionParameters first{.version = 5, .touch = {}, .limits = {}, .bump = {}};
    first.touch.algorithm = Algorithm::pga;
    first.touch.shape = {200.0, 1.5};
    first.touch.friction = {0.5, 0.3};
    first.touch.coupling = {0.25, 1.25, 40.0, 0.2};
    first.limits = {3.0, 0.25, 0.75, 0.5, 11.0};
    first.force_enabled = false;
    first.bump.file = folder.path() / "no such bump.png";
    SessionParameters second = first;
    second.version = 6;
    second.touch.algorithm = Algorithm::god_object;
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {{"participant", "nobody"}});
        recorder.media(4, folder.path() / "gone.mp4", depth);
        recorder.parameters(first);
        recorder.parameters({.version = 99, .touch = {}, .limits = {}, .bump = {}});  // never used
        const auto zero = std::chrono::steady_clock::now().time_since_epoch();
        for (std::int64_t n = 10; n < 30; ++n) {
            if (n == 20) recorder.parameters(second);
            TickRecord tick = tick_record(n);
            tick.zero_ns = std::chrono::nanoseconds(zero).count();
            tick.settings = n < 20 ? 5 : 6;
            tick.frames.source = {4, n >= 15, false, true};
            push(*ring, tick);
        }
        REQUIRE(eventually([&] { return recorder.status().rows == 20; }));
        recorder.mark("M1", "it's soft; DROP TABLE tick");
        recorder.set_fact("participant", "P07");
    }
    const Session session(folder.file());
    REQUIRE(session.parameters().size() == 2);
    const SessionParameters& read = session.parameters()[0];
    CHECK(read.version == 5);
    CHECK(read.first_tick == 10);
    CHECK(read.touch == first.touch);
    CHECK_THAT(read.limits.max_force_newton, WithinAbs(3.0, 0.0));
    CHECK_THAT(read.limits.max_change_newton_per_ms, WithinAbs(0.25, 0.0));
    CHECK_THAT(read.limits.ramp_s, WithinAbs(0.75, 0.0));
    CHECK_THAT(read.limits.max_tick_s, WithinAbs(0.5, 0.0));
    CHECK_THAT(read.limits.max_goal_speed_mm_per_ms, WithinAbs(11.0, 0.0));
    CHECK_FALSE(read.force_enabled);
    CHECK(read.bump.file == first.bump.file);
    CHECK(read.bump.sha256.empty());  // it could not be read
    CHECK(session.parameters()[1].first_tick == 20);
    CHECK(session.parameters_of(6)->touch.algorithm == Algorithm::god_object);
    CHECK(session.parameters_of(99) == nullptr);

    REQUIRE(session.sources().size() == 2);
    CHECK(session.sources()[0].first_tick == 10);
    CHECK(session.sources()[1].first_tick == 15);
    const SessionSource* const source = session.source_of({4, true, false, true});
    REQUIRE(source == &session.sources()[1]);
    CHECK(source->depth.file == depth);
    CHECK(source->depth.bytes == 19);
    CHECK(source->depth.sha256 == sha256_of_file(depth));
    CHECK(source->colour.sha256.empty());

    REQUIRE(session.marks().size() == 1);
    CHECK(session.marks()[0].tag == "M1");
    CHECK(session.marks()[0].text == "it's soft; DROP TABLE tick");
    CHECK(session.marks()[0].t_s > 0.0);
    CHECK(session.marks()[0].t_s < 60.0);
    CHECK(session.fact("participant") == "P07");
    CHECK(session.fact("machine-kernel").starts_with("Linux "));
    CHECK(session.fact("started").size() == 20);
}

TEST_CASE("of a video that grows the content is known from whoever wrote it, else summed up",
          "[session]") {
    const SessionFolder folder;
    const auto depth = folder.path() / "a.depth.mkv";
    const auto colour = folder.path() / "a.color.mkv";
    std::ofstream(depth) << "head and body";
    std::ofstream(colour) << "of another writer";
    const bool touched_before = GENERATE(true, false);
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        recorder.media(1, colour, depth, {}, true);
        TickRecord tick = tick_record(0);
        tick.frames.source.media = 1;
        if (touched_before) {
            push(*ring, tick);
            REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
        }
        recorder.complete_media({{depth, 13, sha256_of_file(depth, 4), 4}});
        if (!touched_before) push(*ring, tick);
    }
    const Session session(folder.file());
    REQUIRE(session.sources().size() == 1);
    const SessionSource& source = session.sources().front();
    CHECK(source.depth.bytes == 13);
    CHECK(source.depth.sha256 == sha256_of_file(depth, 4));
    CHECK(source.depth.head_bytes == 4);
    CHECK(source.colour.sha256 == sha256_of_file(colour));
    CHECK(source.colour.head_bytes == 0);
}

TEST_CASE("touch maps that were felt are kept whole, however large, by their version",
          "[session][maps]") {
    const SessionFolder folder;
    std::string large(1'300'000, '\0');  // more than a reader takes at once
    for (std::size_t k = 0; k < large.size(); ++k) large[k] = static_cast<char>(k * k / 7);
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        TickRecord tick = tick_record(0);
        tick.frames.source.maps = 3;
        push(*ring, tick);
        recorder.maps(3, {{"friction", 0.0, 2.0, large}, {"height", -32.0, 31.5, "small"}});
        recorder.maps(3, {{"friction", 0.0, 2.0, "told again"}});
        recorder.maps(4, {{"stiffness", 0.5, 1.0, "other"}});
    }
    const Session session(folder.file());
    CHECK(session.sources().at(0).source.maps == 3);
    const std::vector<SessionMap> maps = session.maps_of(3);
    REQUIRE(maps.size() == 2);
    CHECK(maps[0].kind == "friction");
    CHECK(maps[0].png == large);
    CHECK(maps[1].png == "small");
    CHECK(maps[1].lowest == -32.0);
    CHECK(maps[1].highest == 31.5);
    CHECK(session.maps_of(4).at(0).kind == "stiffness");
    CHECK(session.maps_of(5).empty());

    // As recordings of before there were maps.
    REQUIRE(change(folder.file(), "DROP TABLE touch_map"));
    REQUIRE(change(folder.file(), "ALTER TABLE source DROP COLUMN maps"));
    const Session old(folder.file());
    CHECK(old.sources().at(0).source.maps == 0);
    CHECK(old.maps_of(3).empty());
}

TEST_CASE("the view of a version stays as its first sessions have it, in any locale", "[session]") {
    const auto sum_of = [](const std::string& text) {
        return sha256_of({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    REQUIRE(kSessionSchemaVersion == 4);  // which has that of 2
    const std::string of_first = "cf2a02a5a82bb495b0340a2cd58f2d9a4a9e8d2c5076613c4dcb7e1bb01966b3";
    CHECK(sum_of(tick_view()) == of_first);
    const CommaLocale locale;  // as every program of Qt or GTK has it for its person
    CHECK(sum_of(tick_view()) == of_first);
}

TEST_CASE("every tick has its wall time", "[session]") {
    const SessionFolder folder;
    const auto wall = [] {
        return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    };
    const double before_s = wall();
    double after_s = 0.0;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        const auto zero = std::chrono::steady_clock::now();
        after_s = wall();
        for (std::int64_t n = 0; n < 5; ++n) {
            TickRecord tick = tick_record(n);
            tick.t_s = 0.02 * static_cast<double>(n);  // whenever they are recorded
            tick.zero_ns = std::chrono::nanoseconds(zero.time_since_epoch()).count();
            push(*ring, tick);
        }
    }
    const Session session(folder.file());
    Session::Ticks ticks(session);
    int read = 0;
    for (TickRecord tick; ticks.next(tick); ++read) {
        CHECK(tick.utc_s > before_s + tick.t_s - 0.001);
        CHECK(tick.utc_s < after_s + tick.t_s + 0.001);
    }
    CHECK(read == 5);
}

TEST_CASE("ticks of no clock of this machine count from the moment of their recording on",
          "[session]") {
    const SessionFolder folder;
    const auto wall = [] {
        return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    };
    const double before_s = wall();
    record_ticks(folder.file(), 5);
    const Session session(folder.file());
    const std::optional<double> begin_s = session.utc_at(session.begin_s());
    REQUIRE(begin_s);
    CHECK(*begin_s > before_s - 0.001);
    CHECK(*begin_s < wall() + 0.001);
    CHECK_FALSE(session.utc_at(-1.0));
}

TEST_CASE("a session says how far the wall clock went from the ticks' clock", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 5);
    REQUIRE(change(folder.file(),
                   "DELETE FROM clock; INSERT INTO clock VALUES (1000000000, 1795000000.0, 0, 0)"));
    CHECK_FALSE(Session(folder.file()).drift());
    REQUIRE(change(folder.file(),
                   "INSERT INTO clock VALUES (5000000000, 1795000004.5, 0, 0),"
                   "(11000000000, 1795000010.25, 0, 0)"));
    const Session session(folder.file());
    const std::optional<ClockDrift> drift = session.drift();
    REQUIRE(drift);
    CHECK(drift->gained_s == 0.25);
    CHECK(drift->over_s == 10.0);
    CHECK(session.utc_at(4.0) == 1795000003.0);
    CHECK(session.utc_at(6.0) == 1795000005.5);
}

TEST_CASE("a gap in the ticks is told", "[session]") {
    const SessionFolder folder;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        for (const std::int64_t n : {3, 4, 8, 9}) push(*ring, tick_record(n));
    }
    const Session session(folder.file());
    CHECK(session.rows() == 4);
    CHECK(session.missing() == 3);
}

TEST_CASE("a mark set before the first tick is one at the first tick", "[session]") {
    const bool alone = GENERATE(false, true);  // seen by the recorder before the tick, or with it
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    {
        HandClock clock;
        Recorder recorder(folder.file(), *ring, {}, nullptr, clock.now());
        recorder.mark("early", "words");
        const int looks = clock.looks;
        // Of what it has to write the recorder notes when it began.
        if (alone) REQUIRE(eventually([&] { return clock.looks > looks; }));
        TickRecord tick = tick_record(7);
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        constexpr double kAge_s = 5.0;
        tick.t_s = kAge_s;
        tick.zero_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count() -
                       std::int64_t{5'000'000'000};
        push(*ring, tick);
    }
    const Session session(folder.file());
    REQUIRE(session.marks().size() == 1);
    CHECK(session.marks()[0].tag == "early");
    CHECK(session.marks()[0].text == "words");
    CHECK(same_bits(session.marks()[0].t_s, session.begin_s()));
}
