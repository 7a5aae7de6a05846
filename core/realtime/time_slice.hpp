// How long a thread keeps a contended processor: threads with shorter slices run first.
#pragma once

#include <sys/types.h>

#include <chrono>

namespace dibhr {

/// For long work that is not urgent, such as drawing and decoding: other threads that wake up, also
/// of other programs, run first. The kernel's default is 1.4 ms on two cores, 3 ms on many.
inline constexpr std::chrono::microseconds kPatientSlice{50'000};
/// For urgent work.
inline constexpr std::chrono::microseconds kPromptSlice{100};

/// Requests slices of this length, 0.1 to 100 ms, for a thread of this process (0: the calling
/// one). Its priority stays, and threads that it makes later have the default. False: not granted,
/// as by Linux before 6.12, where all slices are alike, and for a real-time thread, which needs
/// none.
bool set_time_slice(std::chrono::nanoseconds slice, pid_t thread = 0) noexcept;

}  // namespace dibhr
