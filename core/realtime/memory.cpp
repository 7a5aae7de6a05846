// Prepares the heap, locks the memory of the process, and returns what it does not use.
#include "core/realtime/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

namespace {

/// Holds all that a recording of 4K takes.
constexpr int kReserve_bytes = 1 << 30;
/// glibc's largest. The images of 4K lie in the heap, then; larger ones have pages of their own.
constexpr int kLargestInHeap_bytes = 32 << 20;
constexpr std::size_t kBlock_bytes = kLargestInHeap_bytes / 2;
constexpr int kUsualPad_bytes = 1 << 20;
constexpr std::uintptr_t kLargePage_bytes = 2 << 20;

/// On fault: a page is locked when it is first used, so that what drivers and decoders only reserve
/// takes no memory.
constexpr int kLocked = MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT;

/// There is one in a process.
struct Heap {
    /// While mlockall() runs, the system fills every page that another thread unlocks: whoever
    /// locks or unlocks holds this.
    std::mutex locking{};
    char* begin{nullptr};  ///< of the large pages; null: not prepared
};

Heap& heap() {
    static Heap heap;
    return heap;
}

/// A field of /proc/self/status; 0: there is none.
unsigned long long status_value(std::string_view name, int base) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name)) return std::strtoull(line.c_str() + name.size(), nullptr, base);
    return 0;
}

bool may_lock_anything() {
    constexpr int kCapIpcLock = 14;
    return ((status_value("CapEff:", 16) >> kCapIpcLock) & 1U) != 0;
}

// With a small limit MCL_FUTURE would make later allocations of every thread fail, which is worse
// than a page fault now and then: so the limit must hold all the memory there is, and the reserve.
bool limit_is_ample(rlim_t limit_bytes) {
    if (limit_bytes == RLIM_INFINITY) return true;
    const auto pages = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES));
    return limit_bytes >= pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kReserve_bytes;
}

bool is_unlimited(decltype(RLIMIT_AS) resource) {
    rlimit limit{};
    return getrlimit(resource, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

/// Whether reserved addresses count against no limit.
bool may_reserve() {
    std::ifstream overcommit("/proc/sys/vm/overcommit_memory");
    int never = 2;
    overcommit >> never;
    return never != 2 && is_unlimited(RLIMIT_AS) && is_unlimited(RLIMIT_DATA);
}

char* end_of_heap() {
    return static_cast<char*>(sbrk(0));
}

/// Of the part in large pages.
std::size_t bytes_of_heap() {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(end_of_heap() - heap().begin, 0));
}

/// Extends the heap by the reserve, in large pages. Its end moves when no free block is as large as
/// the wanted one, here or in another thread.
void extend_heap() {
    mallopt(M_TOP_PAD, kReserve_bytes);
    const char* const end = end_of_heap();
    std::vector<void*> blocks;
    blocks.reserve(mallinfo2().fordblks / kBlock_bytes + 2);
    while (end_of_heap() == end && blocks.size() < blocks.capacity())
        blocks.push_back(std::malloc(kBlock_bytes));
    madvise(heap().begin, bytes_of_heap(), MADV_HUGEPAGE);
    for (void* block : blocks) std::free(block);
    // At a limit that is set later, or that the system has, all of it can be used.
    mallopt(M_TOP_PAD, kUsualPad_bytes);
}

}  // namespace

void prepare_heap() {
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, kLargestInHeap_bytes / 2);
    mallopt(M_TRIM_THRESHOLD, 2 * kLargestInHeap_bytes);
    if (!may_reserve()) return;
    mallopt(M_MMAP_THRESHOLD, kLargestInHeap_bytes);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    const auto end = reinterpret_cast<std::uintptr_t>(end_of_heap());
    heap().begin = end_of_heap() + (kLargePage_bytes - end % kLargePage_bytes);
    extend_heap();
}

void return_unused_memory() {
    if (heap().begin == nullptr) {
        malloc_trim(0);
        return;
    }
    const std::lock_guard lock(heap().locking);
    // Of locked memory the system takes no pages back.
    const bool is_locked = status_value("VmLck:", 10) > 0;
    if (is_locked) munlock(heap().begin, bytes_of_heap());
    malloc_trim(0);
    extend_heap();
    malloc_trim(kReserve_bytes);  // but for the reserve: extending used a page of each free block
    if (is_locked) mlock2(heap().begin, bytes_of_heap(), MLOCK_ONFAULT);
}

Grant ask_for_memory_lock() {
    rlimit allowed{};
    getrlimit(RLIMIT_MEMLOCK, &allowed);
    if (!limit_is_ample(allowed.rlim_cur) && !may_lock_anything()) {
        return {false, "refused: only " + std::to_string(allowed.rlim_cur / 1024) +
                           " KiB may be locked; needs memlock unlimited in "
                           "/etc/security/limits.conf"};
    }
    const std::lock_guard lock(heap().locking);
    if (mlockall(kLocked) == 0) return {true, "locked"};
    return {false, std::string("refused: ") + std::strerror(errno)};
}

}  // namespace dibhr
