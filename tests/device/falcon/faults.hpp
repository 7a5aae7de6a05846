// What can go wrong with a simulated Falcon; every fault is a number that a test or a person sets.
#pragma once

#include <limits>
#include <string_view>

namespace dibhr::test::falcon {

inline constexpr int kForEver = std::numeric_limits<int>::max();

/// Counts say how many times a fault still strikes; kForEver never runs out.
struct Faults {
    // Before the firmware runs.
    int leading_zero{0};      ///< hello answers that begin with a stray 00
    int leading_13{0};        ///< autobaud answers that are 13 41 instead of 41
    int ignored_hellos{0};    ///< hellos without an answer
    int ignored_autobaud{0};  ///< "A"s without an answer
    int corrupt_echo{0};      ///< uploads with one wrong echo, of the byte `echo_fault_at`
    int stop_echo{0};         ///< uploads whose echo ends before the byte `echo_fault_at`
    int echo_fault_at{4321};  ///< byte of the upload

    // While it runs.
    int dropped_replies{0};  ///< replies that never come
    int lost_to_overrun{0};  ///< replies lost in the chip, which reports overrun and framing
    int lost_halves{0};      ///< times the end of a reply and the begin of the next are lost so
    int garbage_before{0};   ///< replies with stray bytes before them, "<" and letters among them
    int garbage_inside{0};   ///< replies broken by stray bytes in their middle
    int merged_replies{0};   ///< replies that wait for the next one and share its packet
    int split_to{0};         ///< data bytes a packet carries at most, the rest a latency time later

    // The bus.
    int stalled_reads{0};   ///< times the IN endpoint stalls; it stays halted until it is cleared
    int frozen_in{0};       ///< not 0: IN transfers never end by themselves
    int frozen_out{0};      ///< not 0: OUT transfers never end by themselves
    int frozen_control{0};  ///< not 0: control transfers never end by themselves
};

/// True while `left` lasts; counts it down.
[[nodiscard]] bool strikes(int& left) noexcept;

/// Sets a fault by its name; false when there is none of that name.
[[nodiscard]] bool set_fault(Faults& faults, std::string_view name, int value) noexcept;

}  // namespace dibhr::test::falcon
