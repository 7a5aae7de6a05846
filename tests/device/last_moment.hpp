// Data shared by a program that is about to die and the test that watches it: one page of a file,
// read and written without a system call.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>

namespace dibhr::test {

struct LastMoment {
    // Of the program, just before it goes its way.
    double t_s{0.0};              ///< CLOCK_MONOTONIC
    std::atomic<int> program{0};  ///< its process; 0: not yet

    std::atomic<int> goes_on{0};  ///< how often the test has let the program go on
};

/// The page of a file; null: there can be none.
[[nodiscard]] inline void* map_page(int file) noexcept {
    void* const page =
        mmap(nullptr, sizeof(LastMoment), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    return page == MAP_FAILED ? nullptr : page;
}

/// The same page in every program that opens this file, as zeros at first; null: there can be none.
[[nodiscard]] inline LastMoment* last_moment_in(const char* file) noexcept {
    const int opened = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (opened < 0 || ftruncate(opened, sizeof(LastMoment)) != 0) return nullptr;
    void* const page = map_page(opened);
    close(opened);
    return static_cast<LastMoment*>(page);
}

}  // namespace dibhr::test
