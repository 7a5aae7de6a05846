// The recorder: every tick once, in order, in a file that SQLite's own shell reads.
#include "core/session/recorder.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

namespace {

using dibhr::Recorder;
using dibhr::SessionFacts;
using dibhr::TickRecord;
using dibhr::TickRing;
using dibhr::test::answer;
using dibhr::test::eventually;
using dibhr::test::HandClock;
using dibhr::test::output_of;
using dibhr::test::push;
using dibhr::test::query;
using dibhr::test::Row;
using dibhr::test::SessionFolder;
using dibhr::test::tick_record;

std::vector<std::string> files_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    return names;
}

std::atomic<int> log_flushes{0};

}  // namespace

/// In place of the C library's: counts the flushes of a log that are none of SQLite's own, which
/// opens its files for writing.
extern "C" int fdatasync(int file) {
    std::error_code ignored;
    const auto name =
        std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), ignored);
    if (name.string().ends_with("-wal") && (::fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY)
        ++log_flushes;
    return static_cast<int>(::syscall(SYS_fdatasync, file));
}

TEST_CASE("ticks pushed at full speed in bursts are all recorded, in order", "[session]") {
    constexpr std::int64_t kBursts = 8;
    constexpr std::int64_t kBurst = 5000;
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    {
        const Recorder recorder(folder.file(), *ring, {});
        for (std::int64_t burst = 0; burst < kBursts; ++burst) {
            for (std::int64_t n = 0; n < kBurst; ++n) {
                push(*ring, tick_record(burst * kBurst + n));
            }
            REQUIRE(eventually([&] { return ring->size() == 0; }));
        }
    }
    const auto all = std::to_string(kBursts * kBurst);
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == all);
    CHECK(answer(folder.file(), "SELECT max(tick) - min(tick) + 1 FROM tick") == all);
    CHECK(answer(folder.file(), "SELECT value FROM session WHERE key = 'row_count'") == all);
    CHECK(answer(folder.file(), "PRAGMA integrity_check") == "ok");
}

TEST_CASE("every field of a tick comes back under the output rows' names", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    TickRecord record;
    record.tick = 7;
    record.t_s = 0.1;
    record.settings = 12;
    record.frames = {{3, true, false, true}, 75, 76, 2.5, 2.54, 0.04};
    record.blend = 0.25;
    double next = 1.0 / 3.0;
    for (auto* vector : {&record.goal, &record.proxy, &record.spring_newton, &record.sent_newton,
                         &record.own_newton}) {
        for (int axis = 0; axis < 3; ++axis) (*vector)[axis] = next += 1.0;
    }
    record.dt_s = 0.0011;
    record.lateness_us = 12.5;
    record.update_us = 0.25;
    record.moves = 3;
    record.i = 17;
    record.j = 18;
    record.contact = true;
    record.primitive = 2;
    record.buttons = 5;
    record.cut = 5;
    record.mouse_fallback = true;
    record.from_zero = true;
    push(*ring, record);
    { const Recorder recorder(folder.file(), *ring, {}); }
    CHECK(
        query(
            folder.file(),
            "SELECT tick, contact, primitive, i, j, moves, ns, frame, to_frame, settings, buttons, "
            "tick.cut, cut.name FROM tick JOIN cut ON code = tick.cut") ==
        std::vector<Row>{
            {"7", "1", "edge", "17", "18", "3", "250", "75", "76", "12", "5", "5", "goal jumped"}});
    CHECK(query(folder.file(),
                "SELECT surface, ready, stand_in, restart, lets_go, refused FROM tick") ==
          std::vector<Row>{{"1", "1", "1", "1", "0", "0"}});
    CHECK(query(folder.file(),
                "SELECT source.media, fill_holes, remove_spikes, smooth_steps FROM tick "
                "JOIN source ON source.id = tick.source") ==
          std::vector<Row>{{"3", "1", "0", "1"}});
    CHECK(answer(folder.file(),
                 "SELECT t = 0.1 AND video_s = 2.51 AND blend = 0.25 AND dt_s = 0.0011 "
                 "AND lateness_us = 12.5 FROM tick") == "1");
    // 1/3 + 1, + 1, ... in the same order of additions, so that not a bit may be lost.
    std::string condition;
    double value = 1.0 / 3.0;
    for (const char* name : {"gx", "gy", "gz", "px", "py", "pz", "fx", "fy", "fz", "cx", "cy", "cz",
                             "ox", "oy", "oz"}) {
        value += 1.0;
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), "%s%s = %.17g", condition.empty() ? "" : " AND ",
                      name, value);
        condition += text.data();
    }
    CAPTURE(condition);
    CHECK(answer(folder.file(), "SELECT " + condition + " FROM tick") == "1");
}

TEST_CASE("a primitive is recorded by its name, and one that is none of them as none",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    for (const int primitive : {0, 1, 2, 3, 200}) {
        TickRecord record;
        record.tick = primitive;
        record.primitive = static_cast<std::uint8_t>(primitive);
        push(*ring, record);
    }
    { const Recorder recorder(folder.file(), *ring, {}); }
    CHECK(answer(folder.file(), "SELECT group_concat(primitive, ' ') FROM tick") ==
          "none triangle edge vertex none");
}

TEST_CASE("the session says what it is, its schema, its units and the facts it was given",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    {
        const Recorder recorder(
            folder.file(), *ring,
            {{"program", "dibhr 0.1.0"}, {"device", "mouse'); DROP TABLE tick"}});
        CHECK(answer(folder.file(), "SELECT value FROM session WHERE key = 'complete'") == "0");
    }
    const auto fact = [&](const std::string& key) {
        return answer(folder.file(), "SELECT value FROM session WHERE key = '" + key + "'");
    };
    CHECK(fact("program") == "dibhr 0.1.0");
    CHECK(fact("device") == "mouse'); DROP TABLE tick");
    CHECK(fact("schema_version") == "4");
    CHECK(fact("complete") == "1");
    CHECK(fact("units").find("newtons") != std::string::npos);
    CHECK(answer(folder.file(), "PRAGMA application_id") == std::to_string(0x64686170));
    CHECK(answer(folder.file(), "PRAGMA user_version") == "4");
    // Every column of tick is explained, and nothing else is.
    CHECK(answer(folder.file(),
                 "SELECT count(*) FROM pragma_table_info('tick') JOIN tick_column USING (name)") ==
          answer(folder.file(), "SELECT count(*) FROM tick_column"));
    CHECK(answer(folder.file(), "SELECT count(*) FROM pragma_table_info('tick')") ==
          answer(folder.file(), "SELECT count(*) FROM tick_column"));
}

TEST_CASE("a closed session is one file, which SQLite's own shell reads", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    push(*ring, tick_record(41));
    { const Recorder recorder(folder.file(), *ring, {}); }
    CHECK(files_in(folder.path()) == std::vector<std::string>{"touch.dibhr"});
    if (output_of("command -v sqlite3").empty()) {
        WARN("the sqlite3 shell is not installed: read through its library only");
        return;
    }
    CHECK(output_of("sqlite3 -readonly '" + folder.file().string() +
                    "' 'select tick, gx, gy from tick'") == "41|41.0|41.1\n");
}

TEST_CASE("ticks are in the file a tenth of a second later, while the recording goes on",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    HandClock clock;
    const Recorder recorder(folder.file(), *ring, {}, nullptr, clock.now());
    CHECK(recorder.status().recording);
    push(*ring, tick_record(1));
    CHECK(eventually([&] { return ring->size() == 0; }));
    // It looks whether it is time, again and again.
    const auto looks_again = [&clock] {
        const int before = clock.looks;
        return eventually([&] { return clock.looks >= before + 2; });
    };
    CHECK(looks_again());
    clock.pass(std::chrono::milliseconds(99));
    CHECK(looks_again());
    CHECK(recorder.status().rows == 0);
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == "0");
    clock.pass(std::chrono::milliseconds(1));
    CHECK(eventually([&] { return recorder.status().rows == 1; }));
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == "1");
    CHECK(recorder.status().bytes > 0);
    CHECK(recorder.status().failure.empty());
}

TEST_CASE("a tick the ring had no room for is counted, in the status and in the file",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    std::int64_t next = 0;
    while (ring->push(tick_record(next++))) {
    }
    const auto before = ring->dropped();
    std::optional<Recorder> recorder(std::in_place, folder.file(), *ring, SessionFacts{});
    CHECK(eventually([&] { return recorder->status().rows == 16384; }));
    std::uint64_t dropped = 0;
    constexpr std::int64_t kMore = 100'000;
    for (const std::int64_t end = next + kMore; next < end; ++next) {
        dropped += ring->push(tick_record(next)) ? 0 : 1;
    }
    CHECK(eventually([&] { return recorder->status().dropped == dropped; }));
    recorder.reset();
    CHECK(ring->dropped() - before == dropped);
    CHECK(answer(folder.file(), "SELECT value FROM session WHERE key = 'dropped_count'") ==
          std::to_string(dropped));
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") ==
          std::to_string(16384 + kMore - static_cast<std::int64_t>(dropped)));
}

TEST_CASE("while ticks are recorded, what they were logged in is merged into the file and cut",
          "[session]") {
    constexpr std::uintmax_t kLong = 3 << 20;  // the keeper cuts from 4 MiB on
    const SessionFolder folder;
    const std::filesystem::path log = folder.file().string() + "-wal";
    const auto ring = std::make_unique<TickRing>();
    const Recorder recorder(folder.file(), *ring, {});
    std::int64_t tick = 0;
    std::uintmax_t longest = 0;
    const auto is_cut = [&] {
        // Ten times as many as a loop of 1 kHz: a transaction ends in a pause of the log's keeper.
        for (int k = 0; k < 20; ++k) push(*ring, tick_record(tick++));
        const std::uintmax_t bytes = std::filesystem::file_size(log);
        longest = std::max(longest, bytes);
        return longest > kLong && bytes < longest / 4;
    };
    const bool cut = eventually(is_cut);
    CAPTURE(longest, std::filesystem::file_size(log));
    CHECK(cut);
    CHECK(answer(folder.file(), "PRAGMA integrity_check") == "ok");
}

TEST_CASE("while a recording goes on its log is flushed to the disk again and again", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    const int before = log_flushes;
    const Recorder recorder(folder.file(), *ring, {});
    push(*ring, tick_record(1));
    CHECK(eventually([&] { return log_flushes >= before + 2; }));
}
