// Real-time priority for users whom the system's limits refuse it: RealtimeKit, the service that
// desktops have for sound.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <stop_token>
#include <string>

#include "core/realtime/priority_broker.hpp"

namespace dibhr {

/// Requests the highest priority that RealtimeKit (org.freedesktop.RealtimeKit1 on the system bus)
/// grants, for a thread of this process. As RealtimeKit demands, RLIMIT_RTTIME then bounds how long
/// such a thread runs without a pause: at half of the bound all of them become ordinary threads,
/// before the kernel would end the program. Waits at most `patience`, and ends soon after `stop`.
/// A refusal's answer has the command that helps; `limits_file` is a file for
/// /etc/security/limits.d that grants the priority without RealtimeKit.
[[nodiscard]] Grant ask_realtime_kit(pid_t thread, const std::string& limits_file,
                                     const std::stop_token& stop,
                                     std::chrono::milliseconds patience = std::chrono::seconds(2));

}  // namespace dibhr
