// Sessions of a test's own, made by the real recorder.
#include "tests/core/report/made_session.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "core/haptics/surface.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace fs = std::filesystem;

TickRecord tick_above(std::int64_t number) {
    TickRecord tick;
    tick.tick = number;
    tick.t_s = 0.001 * static_cast<double>(number);
    tick.dt_s = 0.001;
    tick.settings = 1;
    tick.frames.source.media = 1;
    tick.frames.to_frame = 1;
    tick.frames.to_s = 1.0;
    tick.frames.span_s = 1.0;
    tick.goal = tick.proxy = {100.0, 100.0, 60.0};
    return tick;
}

TickRecord tick_in_contact(std::int64_t number, double x, double y, double sent_newton) {
    TickRecord tick = tick_above(number);
    tick.contact = true;
    tick.primitive = static_cast<std::uint8_t>(PrimitiveKind::triangle);
    tick.proxy = {x, y, 50.0};
    tick.goal = {x, y, 40.0};
    tick.spring_newton[2] = 0.5;
    tick.sent_newton[2] = sent_newton;
    return tick;
}

std::vector<TickRecord> ticks_touching(std::int64_t count, std::int64_t first, std::int64_t end) {
    std::vector<TickRecord> ticks;
    for (std::int64_t k = 0; k < count; ++k) {
        ticks.push_back(k >= first && k < end ? tick_in_contact(k, 100.0, 100.0) : tick_above(k));
    }
    return ticks;
}

void record(const fs::path& file, const MadeSession& session) {
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(file, *ring, session.facts);
    SessionParameters parameters;
    parameters.version = 1;
    parameters.touch.coupling.pixel_pitch_mm = 0.1;
    parameters.touch.coupling.damping_cutoff_hz = 47.5;
    recorder.parameters(parameters);
    recorder.media(1, session.colour, session.depth);
    if (session.also) session.also(recorder);
    for (const TickRecord& tick : session.ticks) {
        while (!ring->push(tick)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const RecorderStatus status = recorder.finish();
    INFO(status.failure);
    REQUIRE(status.failure.empty());
}

std::string json_at(const fs::path& file, const std::string& path) {
    const std::string json = read_text(file);
    sqlite3* database = nullptr;
    sqlite3_stmt* question = nullptr;
    std::string answer;
    sqlite3_open(":memory:", &database);
    sqlite3_prepare_v2(database, "SELECT json_extract(?1, ?2)", -1, &question, nullptr);
    sqlite3_bind_text(question, 1, json.c_str(), -1, SQLITE_STATIC);
    sqlite3_bind_text(question, 2, path.c_str(), -1, SQLITE_STATIC);
    if (sqlite3_step(question) != SQLITE_ROW) {
        answer = sqlite3_errmsg(database);
    } else if (sqlite3_column_text(question, 0) != nullptr) {
        answer = reinterpret_cast<const char*>(sqlite3_column_text(question, 0));
    }
    sqlite3_finalize(question);
    sqlite3_close(database);
    return answer;
}

}  // namespace dibhr::test
