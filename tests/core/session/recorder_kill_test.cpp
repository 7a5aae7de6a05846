// A recording that is killed: the file opens, is sound, and lacks at most the last half second.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kAtATime = 5;
// Half a second; what is instrumented, and five at a time, takes several times as long.
constexpr auto kMayLack = milliseconds(DIBHR_SANITIZED ? 2000 : 500);
// As fast as so many loops: the log is merged into the file every two seconds.
constexpr int kFast_per_ms = DIBHR_SANITIZED ? 4 : 20;

/// A program that records, as fast as asked for, until it is killed so long after its first tick.
class Child {
  public:
    Child(const std::filesystem::path& file, int ticks_per_ms, milliseconds lives,
          milliseconds flush)
        : file_(file), lives_(lives) {
        const std::string counter = file.string() + ".counter";
        const int shared = ::open(counter.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
        REQUIRE(::ftruncate(shared, sizeof(std::int64_t)) == 0);
        void* const memory =
            ::mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, shared, 0);
        ::close(shared);
        REQUIRE(memory != MAP_FAILED);
        pushed_ = static_cast<const std::atomic<std::int64_t>*>(memory);
        const std::string rate = std::to_string(ticks_per_ms);
        const std::string flush_ms = std::to_string(flush.count());
        child_ = ::fork();
        REQUIRE(child_ >= 0);
        if (child_ == 0) {
            ::execl(DIBHR_SESSION_CHILD, "session_child", file.c_str(), counter.c_str(),
                    rate.c_str(), flush_ms.c_str(), nullptr);
            ::_exit(127);
        }
    }
    ~Child() {
        kill();
        ::munmap(const_cast<std::atomic<std::int64_t>*>(pushed_), sizeof(std::int64_t));
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Looks how far it is so long before its end as may be lacking, and ends it. False once it is
    /// dead.
    bool watch() {
        if (child_ <= 0) return false;
        if (::waitpid(child_, nullptr, WNOHANG) == child_) {
            child_ = 0;
            FAIL_CHECK("the recording program ended by itself");
            return false;
        }
        if (!begin_ && pushed_->load() > 0) begin_ = Clock::now();
        if (!begin_) return true;
        const auto age = Clock::now() - *begin_;
        if (!certain_ && age >= lives_ - kMayLack) {
            certain_ = pushed_->load();
            seen_ = Clock::now();
        }
        // A test that is itself late gives the child the whole time all the same.
        if (age >= lives_ && certain_ && Clock::now() - seen_ >= kMayLack) kill();
        return child_ > 0;
    }

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    /// Ticks that had been pushed so long before the end as may be lacking.
    [[nodiscard]] std::int64_t certain() const { return certain_.value_or(0); }

  private:
    void kill() {
        if (child_ <= 0) return;
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
        child_ = 0;
    }

    std::filesystem::path file_;
    std::optional<Clock::time_point> begin_{};
    milliseconds lives_;
    const std::atomic<std::int64_t>* pushed_{nullptr};
    pid_t child_{0};
    std::optional<std::int64_t> certain_{};
    Clock::time_point seen_{};
};

void check_what_is_left(const Child& child) {
    CAPTURE(child.file(), child.certain());
    REQUIRE(std::filesystem::exists(child.file()));
    // As the program finds it, log and all; then with SQLite's own eyes.
    const Session session(child.file());
    CHECK_NOTHROW(session.check());
    CHECK(session.rows() >= child.certain());
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
}

/// Kills so many recordings on a disk that needs so long to flush.
void kill_recordings(int kills, milliseconds flush) {
    const SessionFolder folder;
    std::mt19937 random(2026);
    std::uniform_int_distribution<int> rate(0, 3);
    const auto may_lack_ms = static_cast<int>(kMayLack.count());
    std::uniform_int_distribution<int> life_ms(may_lack_ms + 50, may_lack_ms + 2500);
    std::int64_t rows = 0;
    for (int done = 0; done < kills;) {
        std::vector<std::unique_ptr<Child>> children;
        for (; done < kills && children.size() < kAtATime; ++done) {
            const int ticks_per_ms = rate(random) == 0 ? kFast_per_ms : 1;
            children.push_back(std::make_unique<Child>(
                folder.path() / ("killed" + std::to_string(done) + ".dibhr"), ticks_per_ms,
                milliseconds(life_ms(random)), flush));
        }
        for (bool alive = true; alive;) {
            alive = false;
            for (const auto& child : children) alive = child->watch() || alive;
            std::this_thread::sleep_for(milliseconds(1));
        }
        for (const auto& child : children) {
            check_what_is_left(*child);
            rows += child->certain();
            std::filesystem::remove(child->file());
        }
    }
    CHECK(rows > kills * 300);  // they did record
}

}  // namespace

TEST_CASE(
    "killed at fifty random moments, a recording is whole up to the last half second and replays",
    "[session]") {
    kill_recordings(DIBHR_SANITIZED ? 15 : 50, milliseconds(0));
}

TEST_CASE("a disk that needs two seconds to flush takes nothing more from a killed recording",
          "[session]") {
    kill_recordings(10, milliseconds(2000));
}
