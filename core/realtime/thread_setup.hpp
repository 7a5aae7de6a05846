// Asks the system for what a 1 kHz thread needs, and says what it answered.
#pragma once

#include <string>

namespace dibhr {

/// Granted, or why not, in words for the Loop panel.
struct Grant {
    bool granted{false};
    std::string answer{};  ///< "SCHED_FIFO 80", "refused: needs rtprio in /etc/security/..."
};

struct RealtimeGrants {
    Grant priority{};
    Grant memory_lock{};
};

/// Names the calling thread (15 characters are kept), makes its sleeps exact, asks for SCHED_FIFO,
/// and locks the process's memory when the limit allows it without starving other threads. Threads
/// made by the caller do not inherit the priority. A refusal is no error.
[[nodiscard]] RealtimeGrants become_realtime(const char* thread_name);

}  // namespace dibhr
