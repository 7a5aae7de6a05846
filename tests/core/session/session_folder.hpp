// A folder of a test's own, ticks to record in it, and plain SQLite to read them.
#pragma once

#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/session/recorder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// A folder and the name of a session in it.
class SessionFolder : public TemporaryFolder {
  public:
    [[nodiscard]] std::filesystem::path file() const { return *this / "touch.dibhr"; }
};

using Row = std::vector<std::string>;

/// Runs a query read-only, without dibhr's code; the first cell of an error is SQLite's
/// message.
inline std::vector<Row> query(const std::filesystem::path& file, const std::string& sql) {
    std::vector<Row> rows;
    sqlite3* database = nullptr;
    sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
    const auto keep = [](void* all, int count, char** cells, char**) {
        Row row;
        for (int k = 0; k < count; ++k) row.emplace_back(cells[k] == nullptr ? "NULL" : cells[k]);
        static_cast<std::vector<Row>*>(all)->push_back(row);
        return 0;
    };
    if (sqlite3_exec(database, sql.c_str(), keep, &rows, nullptr) != SQLITE_OK) {
        rows.push_back({sqlite3_errmsg(database)});
    }
    sqlite3_close(database);
    return rows;
}

/// Changes a file without dibhr's code; false when SQLite fails.
inline bool change(const std::filesystem::path& file, const std::string& sql) {
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    const int answered = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
    sqlite3_close(database);
    return answered == SQLITE_OK;
}

/// The one cell of a query that gives one.
inline std::string answer(const std::filesystem::path& file, const std::string& sql) {
    const auto rows = query(file, sql);
    return rows.empty() || rows[0].empty() ? "" : rows[0][0];
}

/// A record with all fields computed from its number.
inline TickRecord tick_record(std::int64_t number) {
    TickRecord record;
    const auto n = static_cast<double>(number);
    record.tick = number;
    record.t_s = 0.001 * n;
    for (int axis = 0; axis < 3; ++axis) {
        record.goal[axis] = n + 0.1 * axis;
        record.proxy[axis] = n + 0.2 * axis;
        record.spring_newton[axis] = 0.3 * axis;
        record.sent_newton[axis] = 0.4 * axis;
    }
    return record;
}

/// All that is read back, but wall and video time.
inline bool same_record(const TickRecord& a, const TickRecord& b) {
    return a.tick == b.tick && same_bits(a.t_s, b.t_s) && same_bits(a.dt_s, b.dt_s) &&
           same_bits(a.lateness_us, b.lateness_us) && same_bits(a.update_us, b.update_us) &&
           a.settings == b.settings && a.frames == b.frames && same_bits(a.blend, b.blend) &&
           same_bits(a.goal, b.goal) && same_bits(a.proxy, b.proxy) &&
           same_bits(a.spring_newton, b.spring_newton) && same_bits(a.sent_newton, b.sent_newton) &&
           same_bits(a.own_newton, b.own_newton) && a.moves == b.moves && a.i == b.i &&
           a.j == b.j && a.contact == b.contact && a.primitive == b.primitive &&
           a.buttons == b.buttons && a.cut == b.cut && a.surface == b.surface &&
           a.device_ready == b.device_ready && a.mouse_fallback == b.mouse_fallback &&
           a.from_zero == b.from_zero && a.releases_contact == b.releases_contact &&
           a.goal_refused == b.goal_refused && a.catching_up == b.catching_up &&
           a.gliding == b.gliding && a.standstill == b.standstill;
}

/// Pushes a record, waiting for room: nothing is dropped.
inline void push(TickRing& ring, const TickRecord& record) {
    while (ring.size() == ring.room()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    (void)ring.push(record);
}

/// A clock that a test sets, with a count of its readings.
struct HandClock {
    std::atomic<std::chrono::steady_clock::time_point> time{std::chrono::steady_clock::now()};
    std::atomic<int> looks{0};

    [[nodiscard]] Now now() {
        return [this] {
            ++looks;
            return time.load();
        };
    }
    void pass(std::chrono::milliseconds span) { time = time.load() + span; }
};

/// A session of `count` ticks and no more.
inline void record_ticks(const std::filesystem::path& file, std::int64_t count) {
    const auto ring = std::make_unique<TickRing>();
    const Recorder recorder(file, *ring, {});
    for (std::int64_t n = 0; n < count; ++n) push(*ring, tick_record(n));
}

/// What a shell command prints.
inline std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    pclose(pipe);
    return text;
}

}  // namespace dibhr::test
