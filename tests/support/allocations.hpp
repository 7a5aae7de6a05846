// Counts allocations. A program that lists allocations.cpp among its sources has its operator new
// replaced.
#pragma once

namespace dibhr::test {

/// Of this thread since it began.
[[nodiscard]] int allocations_so_far() noexcept;

/// How often `work` allocates on this thread.
template <typename Work>
[[nodiscard]] int allocations_in(Work&& work) {
    const int before = allocations_so_far();
    work();
    return allocations_so_far() - before;
}

}  // namespace dibhr::test
