// Counters of a recording program, in memory that its test shares.
#pragma once

#include <atomic>
#include <cstdint>

namespace dibhr::test {

struct Counters {
    std::atomic<std::int64_t> pushed{0};  ///< ticks
    std::atomic<std::int64_t> kept{0};    ///< written, by the recorder's status
};

}  // namespace dibhr::test
