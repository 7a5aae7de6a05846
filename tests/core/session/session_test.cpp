// A session read back: every bit of every tick, what it refers to, and what is said of files that
// are none.
#include "core/session/session.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/session/recorder.hpp"
#include "core/session/same_bits.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Any real there is, and the ones that are easily lost.
class AnyReal {
  public:
    double operator()() {
        constexpr double kAwkward[] = {0.0, -0.0, 1.0, -1.0, 255.0, 1e9, -1e-310, 1e300, 0.1};
        const auto n = bits_();
        if (n % 4 == 0) return kAwkward[n / 4 % std::size(kAwkward)];
        const auto real = std::bit_cast<double>(n);
        return std::isfinite(real) ? real : -0.0;
    }

  private:
    std::mt19937_64 bits_{7};
};

TickRecord any_tick(std::int64_t number, AnyReal& real) {
    TickRecord tick;
    tick.tick = number;
    tick.t_s = static_cast<double>(number) * 0.0010001;
    tick.dt_s = real();
    tick.lateness_us = real();
    tick.update_us = static_cast<double>(number) / 1e3;
    tick.settings = 3;
    tick.frames = {{2, true, false, true}, number / 30, number / 30 + 1, real(), real(), real()};
    tick.blend = real();
    for (auto* vector : {&tick.goal, &tick.spring_newton, &tick.own_newton}) {
        for (double& value : *vector) value = real();
    }
    // Often the same as something else, which is then not stored.
    for (int axis = 0; axis < 3; ++axis) {
        tick.proxy[axis] = number % 3 == 0 ? tick.goal[axis] : real();
        tick.sent_newton[axis] = number % 2 == 0 ? tick.spring_newton[axis] : real();
    }
    tick.moves = static_cast<std::int32_t>(number % 5);
    tick.i = static_cast<std::int32_t>(number) - 1;
    tick.j = 40000;
    const auto bit = [number](int k) { return (number >> k & 1) != 0; };
    tick.contact = bit(0);
    tick.primitive = static_cast<std::uint8_t>(number % 4);
    tick.buttons = static_cast<std::uint8_t>(number % 256);
    tick.cut = static_cast<std::uint8_t>(number % 6);
    tick.device_ready = bit(1);
    tick.stand_in = bit(2);
    tick.restart = bit(3);
    tick.lets_go = bit(4);
    tick.goal_refused = bit(5);
    return tick;
}

template <std::size_t N>
bool same(const double (&a)[N], const double (&b)[N]) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), same_bits);
}

bool same(const TickRecord& a, const TickRecord& b) {
    return a.tick == b.tick && same_bits(a.t_s, b.t_s) && same_bits(a.dt_s, b.dt_s) &&
           same_bits(a.lateness_us, b.lateness_us) && same_bits(a.update_us, b.update_us) &&
           a.settings == b.settings && a.frames == b.frames && same_bits(a.blend, b.blend) &&
           same(a.goal, b.goal) && same(a.proxy, b.proxy) &&
           same(a.spring_newton, b.spring_newton) && same(a.sent_newton, b.sent_newton) &&
           same(a.own_newton, b.own_newton) && a.moves == b.moves && a.i == b.i && a.j == b.j &&
           a.contact == b.contact && a.primitive == b.primitive && a.buttons == b.buttons &&
           a.cut == b.cut && a.surface == b.surface && a.device_ready == b.device_ready &&
           a.stand_in == b.stand_in && a.restart == b.restart && a.lets_go == b.lets_go &&
           a.goal_refused == b.goal_refused;
}

/// A session of `count` ticks and no more.
void record_ticks(const std::filesystem::path& file, std::int64_t count) {
    const auto ring = std::make_unique<TickRing>();
    const Recorder recorder(file, *ring, {});
    for (std::int64_t n = 0; n < count; ++n) push(*ring, tick_record(n));
}

/// What opening and looking through the file is refused with.
std::string refusal_of(const std::filesystem::path& file) {
    try {
        const Session session(file);
        session.check();
        Session::Ticks ticks(session);
        for (TickRecord tick; ticks.next(tick);) {
        }
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

void run_sql(const std::filesystem::path& file, const std::string& sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
    CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
}

}  // namespace

TEST_CASE("whatever reals a tick holds come back bit by bit, with and without its parameters",
          "[session]") {
    const bool known = GENERATE(false, true);
    const SessionFolder folder;
    AnyReal real;
    std::vector<TickRecord> ticks;
    for (std::int64_t n = 0; n < 3000; ++n) ticks.push_back(any_tick(n, real));
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        if (known) recorder.parameters({.version = 3, .touch = {}, .limits = {}, .bump = {}});
        for (const TickRecord& tick : ticks) push(*ring, tick);
    }
    const Session session(folder.file());
    Session::Ticks read(session);
    for (const TickRecord& tick : ticks) {
        TickRecord back;
        REQUIRE(read.next(back));
        CAPTURE(tick.tick);
        REQUIRE(same(tick, back));
    }
    TickRecord none;
    CHECK_FALSE(read.next(none));
}

TEST_CASE("what is no number is recorded as infinity", "[session]") {
    const SessionFolder folder;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        TickRecord tick;
        tick.own_newton[1] = std::numeric_limits<double>::quiet_NaN();
        tick.goal[2] = -std::numeric_limits<double>::infinity();
        push(*ring, tick);
    }
    const Session session(folder.file());
    Session::Ticks read(session);
    TickRecord back;
    REQUIRE(read.next(back));
    CHECK(back.own_newton[1] == std::numeric_limits<double>::infinity());
    CHECK(back.goal[2] == -std::numeric_limits<double>::infinity());
    CHECK_THAT(back.own_newton[0], WithinAbs(0.0, 0.0));
}

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

TEST_CASE("parameters, files and marks are kept with the tick that first used them", "[session]") {
    const SessionFolder folder;
    const auto depth = folder.path() / "depth.mp4";
    std::ofstream(depth) << "not much of a video";
    SessionParameters first{.version = 5, .touch = {}, .limits = {}, .bump = {}};
    first.touch.algorithm = Algorithm::pga;
    first.touch.shape = {200.0, 1.5};
    first.touch.friction = {0.5, 0.3};
    first.touch.coupling = {0.25, 1.25, 0.2};
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

TEST_CASE("every tick has its wall time", "[session]") {
    const SessionFolder folder;
    const auto wall = [] {
        return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    };
    const double before_s = wall();
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        const auto zero = std::chrono::steady_clock::now();
        for (std::int64_t n = 0; n < 5; ++n) {
            TickRecord tick = tick_record(n);
            const std::chrono::nanoseconds since = std::chrono::steady_clock::now() - zero;
            tick.t_s = static_cast<double>(since.count()) / 1e9;
            tick.zero_ns = std::chrono::nanoseconds(zero.time_since_epoch()).count();
            push(*ring, tick);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
    const double after_s = wall();
    const Session session(folder.file());
    Session::Ticks ticks(session);
    double last_s = before_s - 0.001;
    for (TickRecord tick; ticks.next(tick);) {
        CHECK(tick.utc_s > last_s);
        CHECK(tick.utc_s < after_s + 0.001);
        last_s = tick.utc_s;
    }
    CHECK(last_s > before_s + 0.05);
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

TEST_CASE("a file that is none is refused with one line that says which and what it is",
          "[session]") {
    const SessionFolder folder;
    const auto refusal = [&folder] { return refusal_of(folder.file()); };
    const auto is_one_line = [&folder](const std::string& text) {
        return contains(text, folder.file().string() + ": ") && !contains(text, "\n");
    };
    SECTION("missing") {
        CHECK(refusal() == folder.file().string() + ": no such file; check its name");
    }
    SECTION("a folder") {
        std::filesystem::create_directory(folder.file());
        CHECK(contains(refusal(), "no ordinary file"));
    }
    SECTION("empty") {
        std::ofstream(folder.file()).flush();
        CHECK(contains(refusal(), "it is empty"));
    }
    SECTION("text") {
        std::ofstream(folder.file()) << std::string(5000, 'x');
        CHECK(contains(refusal(), "no SQLite file"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("another program's database") {
        run_sql(folder.file(), "CREATE TABLE song(name TEXT)");
        CHECK(contains(refusal(), "another program's database"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("a newer version") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "PRAGMA user_version = 3");
        CHECK(contains(refusal(), "was recorded by a newer dibhr (format 3, this one reads 2)"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("an older version") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "PRAGMA user_version = 1");
        CHECK(contains(refusal(), "was recorded by an older dibhr (format 1, this one reads 2)"));
    }
    SECTION("of its version, without its tables") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "DROP TABLE clock");
        CHECK(is_one_line(refusal()));
    }
}

TEST_CASE(
    "wherever a session was cut off or overwritten, that is said in one line, or nothing of "
    "it is lost",
    "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 4000);
    std::ifstream stream(folder.file(), std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(stream), {});
    const auto damaged = folder.path() / "damaged.dibhr";
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
        std::string bytes = whole;
        const std::size_t at = place(random);
        if (k % 2 == 0) {
            bytes.resize(at);
        } else {
            for (std::size_t n = at; n < std::min(at + 600, bytes.size()); ++n) {
                bytes[n] = static_cast<char>(random());
            }
        }
        std::ofstream(damaged, std::ios::binary) << bytes;
        const std::string refusal = refusal_of(damaged);
        CAPTURE(k, at, refusal);
        CHECK_FALSE(contains(refusal, "\n"));
        if (k % 2 == 0) CHECK(contains(refusal, damaged.string() + ": "));
        refused += refusal == "nothing" ? 0 : 1;
    }
    CHECK(refused > 150);  // reals in the middle of a row may well be others
}

TEST_CASE("a recording copied without its log says so, and a whole one says nothing", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {{"note", "hello"}});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    const auto copied = folder.path() / "copied.dibhr";
    std::filesystem::copy_file(folder.file(), copied);  // what is left without the log
    const Session broken_off(copied);
    CHECK(broken_off.fact("note") == "hello");
    CHECK(contains(broken_off.warning(), copied.string()));
    CHECK(contains(broken_off.warning(), "copied.dibhr-wal"));
    CHECK_FALSE(contains(broken_off.warning(), "\n"));
    CHECK(Session(folder.file()).warning().empty());  // its log is beside it
    recorder.finish();
    CHECK(Session(folder.file()).warning().empty());
}

TEST_CASE("a file all of whose recording is in a log that is not there names the log",
          "[session]") {
    const SessionFolder folder;
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(folder.file().c_str(), &database) == SQLITE_OK);
    const auto run = [&](const char* sql) {
        CHECK(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    };
    run("PRAGMA journal_mode = WAL");
    run("PRAGMA application_id = 0x64686170; CREATE TABLE session(key, value)");
    const auto copied = folder.path() / "copied.dibhr";
    std::filesystem::copy_file(folder.file(), copied);
    sqlite3_close(database);
    CHECK(contains(refusal_of(copied), "copied.dibhr-wal, which is not here"));
    // Another program's, whole.
    const auto foreign = folder.path() / "foreign.dibhr";
    run_sql(foreign, "PRAGMA journal_mode = WAL; CREATE TABLE a(b)");
    CHECK(contains(refusal_of(foreign), "another program"));
}

TEST_CASE("ticks with numbers that no recording reaches are refused", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const std::string number =
        GENERATE(as<std::string>{}, "9223372036854775807", "-9223372036854775807", "-1");
    run_sql(folder.file(), "UPDATE tick_data SET tick = " + number + " WHERE tick = 9");
    const std::string refusal = refusal_of(folder.file());
    CHECK(contains(refusal, folder.file().string() + ": is damaged"));
    CHECK(contains(refusal, number));
}

TEST_CASE("a mark set before the first tick is one at the first tick", "[session]") {
    const bool alone = GENERATE(false, true);  // seen by the recorder before the tick, or with it
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    {
        Recorder recorder(folder.file(), *ring, {});
        recorder.mark("early", "words");
        if (alone) std::this_thread::sleep_for(std::chrono::milliseconds(60));
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
