// What a program that is going to die tells of it: one page of a file, written without a system
// call.
#pragma once

#include <atomic>

namespace dibhr::test {

struct LastMoment {
    double t_s{0.0};              ///< CLOCK_MONOTONIC
    std::atomic<int> program{0};  ///< its process; 0: not yet
};

}  // namespace dibhr::test
