// Real-time priority by RealtimeKit: a stand-in of the service on a bus of the test's own.
#include "app/desktop/realtime_kit.hpp"

#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "core/realtime/tick_timer.hpp"
#include "tests/app/program/session_bus.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;

namespace {

constexpr std::int64_t kMostRunning_us = 200'000;
constexpr int kHighest = 20;
constexpr const char* kLimits = "/shared/limits.conf";

struct RealtimeAsked {
    int times{0};
    pid_t thread{0};
    std::uint32_t priority{0};
    rlimit running_time{};  ///< of this process, at the call
};

enum class Manner { grants, refuses, is_silent };

/// Serves on a thread of its own until it is destroyed. Like the real one it makes threads
/// real-time ones by its own right, which only root's tests have.
class RealtimeKitStandIn {
  public:
    RealtimeKitStandIn(const SessionBus& bus, Manner manner)
        : manner_(manner), bus_(bus.connect(), sd_bus_flush_close_unref) {
        REQUIRE(sd_bus_add_filter(bus_.get(), nullptr, &on_message, this) >= 0);
        REQUIRE(sd_bus_request_name(bus_.get(), "org.freedesktop.RealtimeKit1", 0) >= 0);
        thread_ = std::jthread([this](const std::stop_token& stop) {
            constexpr std::uint64_t kLook_us = 10'000;
            while (!stop.stop_requested()) {
                while (sd_bus_process(bus_.get(), nullptr) > 0) continue;
                sd_bus_wait(bus_.get(), kLook_us);
            }
        });
    }
    ~RealtimeKitStandIn() {
        thread_.request_stop();
        thread_.join();
    }
    RealtimeKitStandIn(const RealtimeKitStandIn&) = delete;
    RealtimeKitStandIn& operator=(const RealtimeKitStandIn&) = delete;

    [[nodiscard]] RealtimeAsked asked() const {
        const std::lock_guard lock(mutex_);
        return asked_;
    }

  private:
    static int on_message(sd_bus_message* call, void* self, sd_bus_error* /*error*/) {
        auto& kit = *static_cast<RealtimeKitStandIn*>(self);
        if (sd_bus_message_is_method_call(call, "org.freedesktop.DBus.Properties", "Get") > 0)
            return give_property(call);
        if (sd_bus_message_is_method_call(call, "org.freedesktop.RealtimeKit1",
                                          "MakeThreadRealtime") > 0)
            return kit.make_realtime(call);
        return 0;
    }

    static int give_property(sd_bus_message* call) {
        const char* interface = nullptr;
        const char* name = nullptr;
        if (sd_bus_message_read(call, "ss", &interface, &name) < 0) return 0;
        if (std::string_view(name) == "RTTimeUSecMax")
            sd_bus_reply_method_return(call, "v", "x", kMostRunning_us);
        else
            sd_bus_reply_method_return(call, "v", "i", kHighest);
        return 1;
    }

    int make_realtime(sd_bus_message* call) {
        std::uint64_t thread = 0;
        std::uint32_t priority = 0;
        if (sd_bus_message_read(call, "tu", &thread, &priority) < 0) return 0;
        const std::lock_guard lock(mutex_);
        asked_ = {
            .times = asked_.times + 1, .thread = static_cast<pid_t>(thread), .priority = priority};
        getrlimit(RLIMIT_RTTIME, &asked_.running_time);
        if (manner_ == Manner::is_silent) return 1;
        if (manner_ == Manner::refuses) {
            sd_bus_reply_method_errorf(call, SD_BUS_ERROR_ACCESS_DENIED, "too\nmany");
            return 1;
        }
        const sched_param parameters{static_cast<int>(priority)};
        sched_setscheduler(asked_.thread, SCHED_RR | SCHED_RESET_ON_FORK, &parameters);
        sd_bus_reply_method_return(call, "");
        return 1;
    }

    Manner manner_;
    std::unique_ptr<sd_bus, sd_bus* (*)(sd_bus*)> bus_;
    mutable std::mutex mutex_{};
    RealtimeAsked asked_{};
    std::jthread thread_{};
};

/// The limit of this process, as it was before the test; root may raise it again.
class RunningTimeKept {
  public:
    RunningTimeKept() { getrlimit(RLIMIT_RTTIME, &before_); }
    ~RunningTimeKept() { setrlimit(RLIMIT_RTTIME, &before_); }
    RunningTimeKept(const RunningTimeKept&) = delete;
    RunningTimeKept& operator=(const RunningTimeKept&) = delete;

  private:
    rlimit before_{};
};

int policy() {
    return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
}

/// The calling thread may not raise its priority any more.
void lose_right_to_priority() {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> rights{};
    CHECK(::syscall(SYS_capget, &header, rights.data()) == 0);
    rights[0].effective &= ~(1U << CAP_SYS_NICE);
    CHECK(::syscall(SYS_capset, &header, rights.data()) == 0);
    const rlimit none{};
    setrlimit(RLIMIT_RTPRIO, &none);
}

/// The answer about a thread, asked on that thread.
Grant ask_about_a_thread() {
    Grant grant;
    std::thread([&grant] { grant = ask_realtime_kit(gettid(), kLimits, {}, 1h); }).join();
    return grant;
}

}  // namespace

TEST_CASE("RealtimeKit makes a thread a real-time one, within the running time that it demands",
          "[desktop][threads]") {
    const RunningTimeKept kept;
    const SessionBus bus;
    const RealtimeKitStandIn kit(bus, Manner::grants);
    const EnvironmentVariable address("DBUS_SYSTEM_BUS_ADDRESS", bus.address().c_str());
    std::thread([&kit] {
        const Grant grant = ask_realtime_kit(gettid(), kLimits, {}, 1h);
        const RealtimeAsked asked = kit.asked();
        CHECK(asked.thread == gettid());
        CHECK(asked.priority == kHighest);
        CHECK(asked.running_time.rlim_max == kMostRunning_us);
        CHECK(asked.running_time.rlim_cur <= kMostRunning_us / 2);
        CAPTURE(grant.answer);
        CHECK(grant.granted == (policy() == SCHED_RR));
        if (!grant.granted) return;  // the stand-in has no such right
        CHECK(grant.answer == "SCHED_RR 20 by RealtimeKit");
        std::raise(SIGXCPU);  // as the kernel does where a thread runs without a pause
        CHECK(policy() == SCHED_OTHER);
    }).join();
}

TEST_CASE("a thread whom the limits refuse priority has RealtimeKit's a little later",
          "[desktop][threads]") {
    const RunningTimeKept kept;
    const SessionBus bus;
    const RealtimeKitStandIn kit(bus, Manner::grants);
    const EnvironmentVariable address("DBUS_SYSTEM_BUS_ADDRESS", bus.address().c_str());
    const PriorityBroker broker([](pid_t thread, const std::stop_token& stop) {
        return ask_realtime_kit(thread, kLimits, stop, 1h);
    });
    std::thread([&kit] {
        lose_right_to_priority();
        const Grant grant = become_realtime("refused").priority->wait();
        CAPTURE(grant.answer);
        CHECK(kit.asked().thread == gettid());
        CHECK(grant.granted == (policy() == SCHED_RR));
    }).join();
    munlockall();
}

TEST_CASE("where RealtimeKit is not there, the refusal says how to install it",
          "[desktop][threads]") {
    const SessionBus bus;
    for (const std::string& at : {bus.address(), std::string("unix:path=/nowhere")}) {
        const EnvironmentVariable address("DBUS_SYSTEM_BUS_ADDRESS", at.c_str());
        const Grant grant = ask_about_a_thread();
        CHECK_FALSE(grant.granted);
        CHECK(contains(grant.answer, "sudo apt install rtkit"));
    }
}

TEST_CASE("where RealtimeKit refuses, the refusal says why and what grants it without",
          "[desktop][threads]") {
    const RunningTimeKept kept;
    const SessionBus bus;
    const RealtimeKitStandIn kit(bus, Manner::refuses);
    const EnvironmentVariable address("DBUS_SYSTEM_BUS_ADDRESS", bus.address().c_str());
    const Grant grant = ask_about_a_thread();
    CHECK_FALSE(grant.granted);
    CHECK(contains(grant.answer, "too many"));
    CHECK(contains(grant.answer, std::string("sudo cp ") + kLimits));
}

TEST_CASE("a RealtimeKit that does not answer holds neither the thread nor the program's end",
          "[desktop][threads]") {
    const RunningTimeKept kept;
    const SessionBus bus;
    const RealtimeKitStandIn kit(bus, Manner::is_silent);
    const EnvironmentVariable address("DBUS_SYSTEM_BUS_ADDRESS", bus.address().c_str());
    auto grant = std::make_shared<SharedGrant>();
    {
        const PriorityBroker broker([](pid_t thread, const std::stop_token& stop) {
            return ask_realtime_kit(thread, kLimits, stop, 1h);
        });
        PriorityBroker::request(gettid(), grant);
        REQUIRE(eventually([&kit] { return kit.asked().times > 0; }));
        CHECK_FALSE(grant->get().granted);
    }
    CHECK(contains(grant->wait().answer, "no answer"));
}
