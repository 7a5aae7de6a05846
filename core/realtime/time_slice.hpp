// How long a thread keeps a processor that others want, too: who takes shorter turns goes first.
#pragma once

#include <sys/types.h>

#include <chrono>

namespace dibhr {

/// For what works long and is not missed at once, such as drawing and decoding: whatever else wakes
/// up, also in other programs, goes first. The kernel's own are 1.4 ms on two cores, 3 ms on many.
inline constexpr std::chrono::microseconds kPatientSlice{50'000};
/// For what is waited for.
inline constexpr std::chrono::microseconds kPromptSlice{100};

/// Asks for slices of that length, 0.1 to 100 ms, for a thread of this process (0: this one), whose
/// priority stays; the threads that it makes later have usual ones. Whether it was granted: not by
/// Linux before 6.12, where all slices are alike, and not for a real-time thread, which needs none.
bool set_time_slice(std::chrono::nanoseconds slice, pid_t thread = 0) noexcept;

}  // namespace dibhr
