// Slices of the processor, read from the kernel.
#include "core/realtime/time_slice.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdio>
#include <thread>

#include "core/realtime/tick_timer.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

/// Linux has slices for each thread since 6.12.
bool has_slices() {
    utsname system{};
    uname(&system);
    int major = 0;
    int minor = 0;
    std::sscanf(system.release, "%d.%d", &major, &minor);
    return major > 6 || (major == 6 && minor >= 12);
}

TEST_CASE("a thread takes turns as long as it asks for, and keeps its priority", "[threads]") {
    std::thread([] {
        setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 3);
        CHECK(set_time_slice(kPatientSlice) == has_slices());
        CHECK(set_time_slice(kPromptSlice) == has_slices());
        CHECK((sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) == SCHED_OTHER);
        CHECK(getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))) == 3);
    }).join();
}

TEST_CASE(
    "slices out of the kernel's range are not granted as they are, those of others not at all",
    "[threads]") {
    std::thread([] { CHECK_FALSE(set_time_slice(std::chrono::seconds(5))); }).join();
    CHECK_FALSE(set_time_slice(kPatientSlice, 0x3fffffff));  // there is no such thread
}

TEST_CASE("a real-time thread needs no slices", "[threads]") {
    std::thread([] {
        const RealtimeGrants grants = become_realtime("slices");
        if (grants.priority->get().granted) CHECK_FALSE(set_time_slice(kPatientSlice));
    }).join();
    SUCCEED();
}

}  // namespace
}  // namespace dibhr
