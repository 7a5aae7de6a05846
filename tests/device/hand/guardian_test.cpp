// When a guardian speaks, how often, and what it keeps: on simulated time, which it has part in.
#include "device/hand/guardian.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::Guardian;
using dibhr::StopPacket;
using dibhr::test::let_pass;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kZero = "zero.";

StopPacket zero() {
    StopPacket stop_packet{.channel = StopPacket::Channel::stream};
    stop_packet.set_message(
        std::span(reinterpret_cast<const std::uint8_t*>(kZero.data()), kZero.size()));
    return stop_packet;
}

/// A connection of the program, and the device at its other end.
class Device {
  public:
    Device() { REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()) == 0); }
    ~Device() {
        ::close(ends_[0]);
        forget();
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] int of_program() const noexcept { return ends_[1]; }
    /// The program closes its end.
    void forget() noexcept {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

    /// Whether something comes, or the other end goes, within that time.
    [[nodiscard]] bool hears(milliseconds within) const {
        pollfd end{ends_[0], POLLIN, 0};
        return ::poll(&end, 1, static_cast<int>(within.count())) == 1;
    }
    /// All that has come; nothing: nobody is at the other end any more.
    [[nodiscard]] std::optional<std::string> heard() const {
        std::array<char, 256> bytes{};
        const ssize_t size = ::recv(ends_[0], bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (size == 0) return std::nullopt;
        return std::string(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    }

  private:
    std::array<int, 2> ends_{};
};

/// A forked process of the test, which ends with this.
class Program {
  public:
    explicit Program(const std::function<void()>& run) : process_(::fork()) {
        REQUIRE(process_ >= 0);
        if (process_ > 0) return;
        run();
        ::_exit(0);
    }
    ~Program() {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

  private:
    pid_t process_;
};

void beat_for(Guardian& guardian, milliseconds span) {
    for (const auto end = Clock::now() + span; Clock::now() < end;) {
        guardian.beat();
        let_pass(milliseconds(12));
    }
}

}  // namespace

TEST_CASE("a guardian says nothing while its program lives, and speaks when it has been silent",
          "[guardian]") {
    const Device device;
    Guardian guardian("device");
    REQUIRE(guardian.fault().empty());
    guardian.watch(device.of_program(), zero());
    beat_for(guardian, std::chrono::seconds(5));
    CHECK_FALSE(device.hears(milliseconds(0)));
    CHECK_FALSE(guardian.has_sent());

    guardian.beat();
    const auto last_beat = Clock::now();
    REQUIRE(device.hears(std::chrono::seconds(10)));
    // 50 ms after it has seen a beat; it looks every 10 ms.
    CHECK(Clock::now() - last_beat >= milliseconds(50));
    CHECK(Clock::now() - last_beat <= milliseconds(61));
    CHECK(guardian.has_sent());
    for (int times = 0; times < 5; ++times) {
        CHECK(device.heard() == kZero);
        if (times < 4) CHECK(device.hears(milliseconds(6)));  // every 5 ms
    }
    // Over a stream nothing gets lost, and answers would pile up.
    CHECK_FALSE(device.hears(std::chrono::seconds(2)));

    guardian.dismiss();
    CHECK_FALSE(guardian.has_sent());
    CHECK_FALSE(device.hears(std::chrono::seconds(2)));
}

TEST_CASE("a guardian that has been told of another connection guards that one", "[guardian]") {
    const Device first;
    const Device second;
    Guardian guardian("device");
    guardian.watch(first.of_program(), zero());
    guardian.dismiss();
    guardian.watch(second.of_program(), zero());
    CHECK(second.hears(std::chrono::seconds(1)));
    CHECK_FALSE(first.hears(milliseconds(0)));
}

TEST_CASE("a guardian that was parted from says zero five times, and another one guards the next",
          "[guardian]") {
    Device first;
    const Device second;
    Guardian guardian("device");
    CHECK_FALSE(guardian.died());
    guardian.watch(first.of_program(), zero());
    guardian.detach();
    first.forget();
    std::string all;
    while (first.hears(std::chrono::seconds(10))) {
        const auto heard = first.heard();
        if (!heard) break;
        all += *heard;
    }
    CHECK(all == "zero.zero.zero.zero.zero.");
    guardian.watch(second.of_program(), zero());
    CHECK(guardian.fault().empty());
    CHECK(second.hears(std::chrono::seconds(1)));
}

TEST_CASE("when its program ends without a word the guardian says zero five times, and goes",
          "[guardian]") {
    Device device;
    const pid_t program = ::fork();
    REQUIRE(program >= 0);
    if (program == 0) {
        Guardian guardian("device");
        guardian.watch(device.of_program(), zero());
        ::_exit(guardian.fault().empty() ? 0 : 1);
    }
    device.forget();
    int status = -1;
    REQUIRE(::waitpid(program, &status, 0) == program);
    CHECK(status == 0);
    std::string all;
    while (device.hears(std::chrono::seconds(10))) {
        const auto heard = device.heard();
        if (!heard) break;
        all += *heard;
    }
    CHECK(all == "zero.zero.zero.zero.zero.");
    CHECK_FALSE(device.heard().has_value());
}

TEST_CASE("a guardian keeps nothing of the program's open, and nothing that it was dismissed from",
          "[guardian]") {
    Device device;
    SECTION("what was open before it") {
        const Guardian guardian("device");
        CHECK(guardian.fault().empty());
        device.forget();
        CHECK(device.hears(std::chrono::seconds(1)));
        CHECK_FALSE(device.heard().has_value());
    }
    SECTION("what it is given, until it is dismissed") {
        Guardian guardian("device");
        guardian.watch(device.of_program(), zero());
        device.forget();
        CHECK_FALSE(device.hears(milliseconds(0)));
        guardian.dismiss();
        CHECK(device.hears(milliseconds(0)));
        CHECK_FALSE(device.heard().has_value());
    }
    CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);  // no child is left
}

TEST_CASE("however many guardians there were, an alarm reaches the one that there is",
          "[guardian]") {
    for (int k = 0; k < 20; ++k) const Guardian gone("device");
    Device device;
    const Program program([&device] {  // it has been where the others were
        Guardian guardian("device");
        guardian.watch(device.of_program(), zero());
        guardian.beat();
        Guardian::alarm();
        beat_for(guardian, std::chrono::hours(1));
    });
    device.forget();
    REQUIRE(device.hears(std::chrono::seconds(10)));
    CHECK(device.heard().value_or("").starts_with(kZero));
}
