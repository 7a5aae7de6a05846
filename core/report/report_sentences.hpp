// The report's sentences: the summary, the remarks, and what each number means.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/report/session_report.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// One paragraph of what happened.
[[nodiscard]] std::string summary_of(const SessionReport& report);

/// What a reader must know before relying on the numbers, one sentence each; none when all is well.
[[nodiscard]] std::vector<std::string> remarks_of(const SessionReport& report);

[[nodiscard]] std::vector<Definition> definitions();

/// "2026-03-01 14:05:09 UTC"; empty when the time is not known.
[[nodiscard]] std::string wall_time_text(double utc_s);

/// "1 contact", "3 contacts".
[[nodiscard]] std::string counted(std::int64_t count, const std::string& thing);

/// "12.4 %" of a share of 0.124.
[[nodiscard]] std::string percent_text(double share);

/// The requested device, and for how much of the time with a surface the mouse replaced it: "Novint
/// Falcon 1234; the mouse replaced it for 37.2 % of the ticks". At least 0.1 % if any.
[[nodiscard]] std::string device_text(const std::string& device, const HandTicks& hand);

/// Of a session's ticks.
[[nodiscard]] HandTicks hand_of(const TickCounts& ticks);

/// The facts of a session; without those of devices where the mouse replaced them in all ticks.
/// `kinds`: names of the kinds of devices, with which the keys of their facts begin: "falcon".
[[nodiscard]] SessionFacts facts_of_hand(SessionFacts facts, const HandTicks& hand,
                                         const std::vector<std::string>& kinds);

}  // namespace dibhr
