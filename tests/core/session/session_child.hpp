// What a recording program tells of itself while it records, in memory that its test shares.
#pragma once

#include <atomic>
#include <cstdint>

namespace dibhr::test {

struct Counters {
    std::atomic<std::int64_t> pushed{0};  ///< ticks
    std::atomic<std::int64_t> kept{0};    ///< of them, as the recorder's status says
};

}  // namespace dibhr::test
