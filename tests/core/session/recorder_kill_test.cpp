// A recording that is killed: the file opens, is intact, and holds all that was reported written.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/replay/session_replay.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/session/session.hpp"
#include "core/session/surface_reader.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_child.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kLoop_per_ms = 1;
// Faster than one loop: the log is soon long enough to be merged into the file.
constexpr int kFast_per_ms = DIBHR_SANITIZED ? 4 : 20;

/// A program that records at a given rate until it is killed.
class Child {
  public:
    Child(const std::filesystem::path& file, int ticks_per_ms, const std::string& flush)
        : file_(file) {
        const std::string counters = file.string() + ".counters";
        const int shared = ::open(counters.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
        REQUIRE(::ftruncate(shared, sizeof(Counters)) == 0);
        void* const memory = ::mmap(nullptr, sizeof(Counters), PROT_READ, MAP_SHARED, shared, 0);
        ::close(shared);
        REQUIRE(memory != MAP_FAILED);
        counters_ = static_cast<const Counters*>(memory);
        const std::string rate = std::to_string(ticks_per_ms);
        child_ = ::fork();
        REQUIRE(child_ >= 0);
        if (child_ == 0) {
            ::execl(DIBHR_SESSION_CHILD, "session_child", file.c_str(), counters.c_str(),
                    rate.c_str(), flush.c_str(), nullptr);
            ::_exit(127);
        }
    }
    ~Child() {
        kill();
        ::munmap(const_cast<Counters*>(counters_), sizeof(Counters));
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] std::int64_t pushed() const { return counters_->pushed; }
    [[nodiscard]] std::int64_t kept() const { return counters_->kept; }
    [[nodiscard]] bool has_ended() {
        if (child_ > 0 && ::waitpid(child_, nullptr, WNOHANG) == child_) child_ = 0;
        return child_ == 0;
    }
    void kill() {
        if (child_ <= 0) return;
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
        child_ = 0;
    }

  private:
    std::filesystem::path file_;
    const Counters* counters_{nullptr};
    pid_t child_{0};
};

/// At least that many ticks are in the file that is left, and it replays.
void check_what_is_left(const Child& child, std::int64_t certain) {
    CAPTURE(child.file(), certain, child.pushed());
    REQUIRE(std::filesystem::exists(child.file()));
    // As the program finds it, log and all; then with SQLite's own eyes.
    const Session session(child.file());
    CHECK_NOTHROW(session.check());
    CHECK(session.rows() >= certain);
    CHECK(session.missing() == 0);
    CHECK(answer(child.file(), "PRAGMA integrity_check") == "ok");
    CHECK(answer(child.file(),
                 "SELECT count(*) = max(tick) - min(tick) + 1 AND min(tick) = 0 "
                 "FROM tick") == "1");
    MovingSurface surface;
    SessionReplay replay(session, surface, {{}});
    bool same = true;
    while (replay.next()) same = same && same_bits(replay.touch(0), replay.recorded());
    CHECK(same);
    if (!SurfaceReader(session.reader()).any()) return;
    // And by itself: tiles and ticks agree.
    StoredFrames stored(session, {});
    SessionReplay alone(session, stored, {{}});
    while (alone.next())
        same = same && same_bits(alone.touch(0), alone.recorded()) && !alone.left_known(0);
    CHECK(same);
}

/// Kills a recording when `when` becomes true; all that it had reported as written is in the file.
void kill_when(Child& child, const std::function<bool(const Child&)>& when) {
    bool ended = false;
    CHECK(eventually([&] {
        ended = child.has_ended();
        return ended || when(child);
    }));
    CHECK_FALSE(ended);  // by itself
    const std::int64_t kept = child.kept();
    child.kill();
    check_what_is_left(child, kept);
}

}  // namespace

TEST_CASE("killed at random moments, a recording has all that it said was in it, and replays",
          "[session]") {
    constexpr int kKills = 12;
    constexpr int kAtATime = 4;
    const SessionFolder folder;
    std::mt19937 random(2026);
    for (int killed = 0; killed < kKills; killed += kAtATime) {
        std::vector<std::unique_ptr<Child>> children;
        for (int k = killed; k < killed + kAtATime; ++k)
            children.push_back(std::make_unique<Child>(
                folder.path() / ("killed" + std::to_string(k) + ".dibhr"), kLoop_per_ms, "works"));
        for (const auto& child : children) {
            const auto kept = static_cast<std::int64_t>(random() % 400);
            const auto beyond = static_cast<std::int64_t>(random() % 150);
            kill_when(*child, [=](const Child& now) {
                return now.kept() > kept && now.pushed() >= now.kept() + beyond % 80;
            });
        }
    }
}

TEST_CASE("killed while its log is merged into the file, a recording has all that it said was in",
          "[session]") {
    const SessionFolder folder;
    std::mt19937 random(2027);
    for (int k = 0; k < 2; ++k) {
        Child child(folder.path() / ("merged" + std::to_string(k) + ".dibhr"), kFast_per_ms,
                    "works");
        // Only merging makes the file itself longer than its empty tables.
        std::optional<std::uintmax_t> empty;
        const auto waits = random() % 20'000;
        unsigned looks = 0;
        kill_when(child, [&](const Child& now) {
            if (now.kept() == 0) return false;
            const std::uintmax_t bytes = std::filesystem::file_size(now.file());
            if (!empty) empty = bytes;
            if (bytes <= *empty) return false;
            while (++looks < waits) std::this_thread::yield();
            return true;
        });
    }
}

TEST_CASE("a disk that flushes nothing takes nothing from a killed recording", "[session]") {
    const SessionFolder folder;
    Child child(folder.file(), kLoop_per_ms, "hangs");
    // Of a few transactions, while it has been flushing since the first second.
    kill_when(child, [](const Child& now) { return now.kept() > 1500; });
}

namespace {

/// Kills recordings on such a disk; all ticks pushed half a second before are in the file.
void kill_recordings(int kills, const std::string& flush) {
    constexpr int kAtATime = 5;
    constexpr milliseconds kMayLack(500);
    struct Doomed {
        std::unique_ptr<Child> child{};
        Clock::time_point looked_at{}, dies{};
        std::int64_t certain{-1};
    };
    const SessionFolder folder;
    std::mt19937 random(2026);
    std::int64_t rows = 0;
    for (int done = 0; done < kills;) {
        std::vector<Doomed> doomed;
        for (; done < kills && doomed.size() < kAtATime; ++done) {
            const int ticks_per_ms = random() % 4 == 0 ? kFast_per_ms : kLoop_per_ms;
            doomed.push_back({std::make_unique<Child>(
                folder.path() / ("killed" + std::to_string(done) + ".dibhr"), ticks_per_ms,
                flush)});
        }
        for (Doomed& one : doomed) {
            REQUIRE(eventually([&] { return one.child->pushed() > 0; }));
            one.looked_at = Clock::now() + milliseconds(50 + random() % 2500);
            one.dies = one.looked_at + kMayLack;
        }
        for (bool alive = true; alive;) {
            alive = false;
            for (Doomed& one : doomed) {
                const auto now = Clock::now();
                if (one.certain < 0 && now >= one.looked_at) {
                    one.certain = one.child->pushed();
                    one.dies = now + kMayLack;
                }
                if (one.certain >= 0 && now >= one.dies) one.child->kill();
                alive = alive || !one.child->has_ended();
            }
            std::this_thread::yield();
        }
        for (const Doomed& one : doomed) {
            check_what_is_left(*one.child, one.certain);
            rows += one.certain;
            std::filesystem::remove(one.child->file());
        }
    }
    CHECK(rows > kills * 300);  // they did record
}

}  // namespace

TEST_CASE("killed at any moment, a recording lacks at most the last half second",
          "[session][realtime]") {
    kill_recordings(20, "works");
}

TEST_CASE("nor does it lack more on a disk that needs two seconds to flush",
          "[session][realtime]") {
    kill_recordings(10, "2000");
}
