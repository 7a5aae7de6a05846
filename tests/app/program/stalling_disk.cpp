// Preloaded into the program: a disk that stands still. While somebody holds the lock of the file
// $STALL_WHILE, whoever reads, writes or flushes a file whose path contains $STALL_PATH waits.
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

bool is_on_that_disk(int descriptor, const char* part) {
    std::array<char, 64> link{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
    std::array<char, PATH_MAX> path{};
    return readlink(link.data(), path.data(), path.size() - 1) > 0 &&
           std::strstr(path.data(), part) != nullptr;
}

/// In the kernel, as for a disk.
void wait_for_disk(int descriptor) {
    static const char* const part = std::getenv("STALL_PATH");
    static const char* const lock = std::getenv("STALL_WHILE");
    if (part == nullptr || lock == nullptr || !is_on_that_disk(descriptor, part)) return;
    const int held = open(lock, O_RDONLY | O_CLOEXEC);
    if (held < 0) return;
    flock(held, LOCK_SH);
    close(held);
}

template <typename Function>
Function next_of(Function, const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// Names of the C library's.
extern "C" {
ssize_t read(int file, void* to, size_t bytes) {
    static const auto real = next_of(&read, "read");
    wait_for_disk(file);
    return real(file, to, bytes);
}
ssize_t pread64(int file, void* to, size_t bytes, off64_t at) {
    static const auto real = next_of(&pread64, "pread64");
    wait_for_disk(file);
    return real(file, to, bytes, at);
}
ssize_t write(int file, const void* from, size_t bytes) {
    static const auto real = next_of(&write, "write");
    wait_for_disk(file);
    return real(file, from, bytes);
}
ssize_t pwrite64(int file, const void* from, size_t bytes, off64_t at) {
    static const auto real = next_of(&pwrite64, "pwrite64");
    wait_for_disk(file);
    return real(file, from, bytes, at);
}
int fdatasync(int file) {
    static const auto real = next_of(&fdatasync, "fdatasync");
    wait_for_disk(file);
    return real(file);
}
}
