// What an hour of recording costs: bytes, memory, time of the recorder's thread. Some of it is
// recorded here, faster than it was; DIBHR_TEST_RECORD_MINUTES=60 records an hour.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/own_memory.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr double kMostBytesPerHour = 0.6e9;
constexpr double kMostShareOfCore = 0.1;
constexpr std::int64_t kTicksPerMinute = 60'000;
constexpr std::int64_t kSomeTicks = 16'000;

std::int64_t ticks_asked_for(std::int64_t usual) {
    const char* const minutes = std::getenv("DIBHR_TEST_RECORD_MINUTES");
    return minutes == nullptr ? usual : std::max(std::atol(minutes), 1L) * kTicksPerMinute;
}

/// Time on a core of this process's thread of that name; nothing when there is none.
std::optional<double> thread_seconds(const std::string& name) {
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream comm(task.path() / "comm");
        std::string found;
        std::getline(comm, found);
        std::ifstream schedule(task.path() / "schedstat");
        double ns = 0.0;
        if (found == name && schedule >> ns) return ns * 1e-9;
    }
    return std::nullopt;
}

struct Cost {
    double bytes_per_hour{0.0};
    double share_of_core{0.0};  ///< of the recorder's thread, had it been at 1 kHz
    double grown_bytes{0.0};
    RecorderStatus status{};
    std::int64_t missing{-1};
};

Cost cost_of(Exploration& hand, std::int64_t ticks) {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Cost cost;
    {
        Recorder recorder(folder.file(), *ring, {});
        recorder.parameters(hand.parameters);
        double before = 0.0;
        for (std::int64_t k = 0; k < ticks; ++k) {
            push(*ring, hand.next());
            if (k == ticks / 2) before = static_cast<double>(resident_bytes());
        }
        REQUIRE(eventually([&recorder, ticks] {
            const RecorderStatus status = recorder.status();
            return static_cast<std::int64_t>(status.rows + status.dropped) == ticks;
        }));
        cost.grown_bytes = static_cast<double>(resident_bytes()) - before;
        const auto seconds = thread_seconds("dibhr-recorder");
        REQUIRE(seconds.has_value());
        cost.share_of_core = *seconds / (static_cast<double>(ticks) * 1e-3);
        cost.status = recorder.finish();
    }
    const auto empty_file = folder / "empty.dibhr";
    record_ticks(empty_file, 0);  // of which there is one, however long it is recorded
    const auto bytes = static_cast<double>(std::filesystem::file_size(folder.file()) -
                                           std::filesystem::file_size(empty_file));
    cost.bytes_per_hour = bytes / static_cast<double>(ticks) * 60.0 * kTicksPerMinute;
    const Session session(folder.file());
    cost.missing = session.missing() + ticks - session.rows();
    return cost;
}

/// In contact; every force meets the device's limit; and no value follows from others: damping acts
/// in z, too, and the device adds a force.
enum class Kind { light, limited, worst };

void touch_as(Kind kind, Exploration& hand) {
    if (kind == Kind::light) return;
    hand.parameters.touch.coupling.stiffness_newton_per_mm = 20.0;
    hand.parameters.touch.coupling.damping_newton_s_per_m = 2.0;
    if (kind == Kind::limited) return;
    hand.tremor_px = 0.5;
    hand.own_force_newton = {0.1 / 3.0, -0.2 / 3.0, 0.1 / 7.0};
}

std::string in_words(const Cost& cost) {
    std::ostringstream numbers;
    numbers << "an hour: " << cost.bytes_per_hour / 1e9
            << " GB; recorder at 1 kHz: " << 100.0 * cost.share_of_core
            << " % of a core; memory grew by " << cost.grown_bytes / 1e6
            << " MB; ring's high water " << cost.status.high_water;
    return numbers.str();
}

}  // namespace

TEST_CASE("an hour of any touch needs at most 0.6 GB, no more memory, and drops nothing",
          "[session]") {
    MovingSurface surface;
    for (const Kind kind : {Kind::light, Kind::limited, Kind::worst}) {
        Exploration hand(surface);
        touch_as(kind, hand);
        const Cost cost = cost_of(hand, ticks_asked_for(kSomeTicks));
        CAPTURE(in_words(cost));
        CHECK(cost.status.failure.empty());
        CHECK(cost.status.dropped == 0);
        CHECK(cost.missing == 0);
        CHECK(cost.bytes_per_hour <= kMostBytesPerHour);
        if (!DIBHR_SANITIZED) CHECK(cost.grown_bytes < 32e6);  // which keep what was freed
    }
}

TEST_CASE("an hour of any touch needs at most a tenth of a core", "[session][bench]") {
    MovingSurface surface;
    for (const Kind kind : {Kind::light, Kind::limited, Kind::worst}) {
        Exploration hand(surface);
        touch_as(kind, hand);
        const Cost cost = cost_of(hand, ticks_asked_for(kTicksPerMinute));
        WARN(in_words(cost));
        CHECK(cost.share_of_core <= kMostShareOfCore);
    }
}
