// The memory of a process with a prepared heap: kept for the next frames, returned on request.
#include "core/realtime/memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/own_memory.hpp"

using namespace dibhr;
using dibhr::test::resident_bytes;

namespace {

constexpr std::size_t kFrame = std::size_t{8} << 20;  // bytes
constexpr std::size_t kFrames = 24;
const long page_count = static_cast<long>(kFrames * kFrame) / sysconf(_SC_PAGESIZE);

const bool heap_is_prepared = (prepare_heap(), true);  // before a second thread

std::size_t most_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

/// Whether the page at that place is locked, or would be when it is used.
bool is_locked(const void* place) {
    const auto at = reinterpret_cast<std::uintptr_t>(place);
    std::ifstream maps("/proc/self/smaps");
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        char* end = nullptr;
        const std::uintptr_t from = std::strtoull(line.c_str(), &end, 16);
        if (*end == '-') here = from <= at && at < std::strtoull(end + 1, nullptr, 16);
        if (here && line.starts_with("VmFlags:")) return line.find(" lo") != std::string::npos;
    }
    return false;
}

/// Until its end.
struct MemoryLock {
    Grant grant = ask_for_memory_lock();

    MemoryLock() = default;
    ~MemoryLock() { munlockall(); }
    MemoryLock(const MemoryLock&) = delete;
    MemoryLock& operator=(const MemoryLock&) = delete;
};

/// Every page is written.
std::vector<std::vector<char>> frames() {
    return std::vector<std::vector<char>>(kFrames, std::vector<char>(kFrame, 'x'));
}

template <typename Work>
long page_faults(const Work& work) {
    rusage before{};
    rusage after{};
    getrusage(RUSAGE_SELF, &before);
    work();
    getrusage(RUSAGE_SELF, &after);
    return after.ru_minflt - before.ru_minflt;
}

/// What the system gives at this moment.
bool has_large_pages() {
    void* const place = ::mmap(nullptr, kFrames * kFrame, PROT_READ | PROT_WRITE,
                               MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(place != MAP_FAILED);
    madvise(place, kFrames * kFrame, MADV_HUGEPAGE);
    const long faults = page_faults([place] { std::memset(place, 1, kFrames * kFrame); });
    ::munmap(place, kFrames * kFrame);
    return faults < page_count / 20;
}

/// So many, below the heap: mlockall() takes a while until it comes to the heap.
class LowMappings {
  public:
    LowMappings() {
        void* const wanted = reinterpret_cast<void*>(std::uintptr_t{1} << 32);
        begin_ = ::mmap(wanted, bytes_, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        REQUIRE(begin_ != MAP_FAILED);
        for (std::size_t at = 0; at < bytes_; at += 2 * page_)
            REQUIRE(::mprotect(static_cast<char*>(begin_) + at, page_, PROT_NONE) == 0);
    }
    ~LowMappings() { ::munmap(begin_, bytes_); }
    LowMappings(const LowMappings&) = delete;
    LowMappings& operator=(const LowMappings&) = delete;

  private:
    std::size_t page_ = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    std::size_t bytes_ = 20'000 * page_;
    void* begin_{nullptr};
};

}  // namespace

TEST_CASE("new frames lie in large pages, the next ones in the same", "[memory]") {
    REQUIRE(heap_is_prepared);
    const bool large = has_large_pages();
    return_unused_memory();
    const long first = page_faults(frames);
    if (large) CHECK(first < page_count / 20);
    CHECK(page_faults(frames) < first + 20);
    CHECK(page_faults(frames) < page_count / 100);
}

TEST_CASE("memory that is used no more is returned on request, locked or not", "[memory]") {
    std::optional<MemoryLock> lock;
    if (GENERATE(false, true)) {
        lock.emplace();
        WARN("the memory is " << lock->grant.answer);
    }
    const std::size_t used = [] {
        const auto frames = ::frames();
        return resident_bytes();
    }();
    return_unused_memory();
    CHECK(resident_bytes() < used - (kFrames - 2) * kFrame);
}

TEST_CASE("memory stays locked when unused memory was returned", "[memory]") {
    const MemoryLock lock;
    if (!lock.grant.granted) {
        SUCCEED(lock.grant.answer);
        return;
    }
    const auto used = frames();
    return_unused_memory();
    const auto later = frames();
    for (const auto* frame : {&used.front(), &used.back(), &later.front(), &later.back()})
        CHECK(is_locked(frame->data()));
}

TEST_CASE("memory that is locked and returned at once is not filled", "[memory]") {
    const MemoryLock lock;
    if (!lock.grant.granted) {
        SUCCEED(lock.grant.answer);
        return;
    }
    const LowMappings mappings;
    frames();
    const std::size_t before = most_resident_bytes();
    std::thread other([] {
        for (int k = 0; k < 20; ++k) {
            frames();
            return_unused_memory();
        }
    });
    for (int k = 0; k < 100; ++k) (void)ask_for_memory_lock();
    other.join();
    CHECK(most_resident_bytes() < before + 4 * kFrame);
}

TEST_CASE("at a limit that is set later nearly all of the memory can be used", "[memory]") {
    constexpr std::size_t kLimit = std::size_t{3} << 30;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const rlimit limit{kLimit, kLimit};
        setrlimit(RLIMIT_DATA, &limit);
        std::vector<void*> blocks;  // else the compiler may leave the allocations out
        blocks.reserve(2 * kLimit / kFrame);
        do blocks.push_back(std::malloc(kFrame));
        while (blocks.back() != nullptr);
        _exit(blocks.size() * kFrame > kLimit / 10 * 9 ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}
