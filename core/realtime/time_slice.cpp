// By sched_setattr(2), which the C library did not have before 2.41.
#include "core/realtime/time_slice.hpp"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace dibhr {

namespace {

/// The kernel's struct sched_attr, in its first version.
struct Attributes {
    std::uint32_t size{sizeof(Attributes)};
    std::uint32_t policy{0};
    std::uint64_t flags{0};
    std::int32_t nice{0};
    std::uint32_t priority{0};
    std::uint64_t runtime_ns{0};  ///< of ordinary threads: the slice
    std::uint64_t deadline_ns{0};
    std::uint64_t period_ns{0};
};
static_assert(sizeof(Attributes) == 48);

constexpr std::uint64_t kResetOnFork = 1;

bool read(pid_t thread, Attributes& attributes) noexcept {
    return syscall(SYS_sched_getattr, thread, &attributes, sizeof(attributes), 0) == 0 &&
           (attributes.policy == SCHED_OTHER || attributes.policy == SCHED_BATCH);
}

}  // namespace

bool set_time_slice(std::chrono::nanoseconds slice, pid_t thread) noexcept {
    Attributes attributes;
    if (!read(thread, attributes)) return false;
    attributes.size = sizeof(attributes);
    attributes.flags |= kResetOnFork;
    attributes.runtime_ns = static_cast<std::uint64_t>(slice.count());
    if (syscall(SYS_sched_setattr, thread, &attributes, 0) != 0) return false;
    Attributes granted;
    return read(thread, granted) && granted.runtime_ns == attributes.runtime_ns;
}

}  // namespace dibhr
