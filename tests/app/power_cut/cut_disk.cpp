// A disk whose power is cut, in place of the C library's calls; linked, or preloaded.
#include "tests/app/power_cut/cut_disk.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <string>

namespace {

template <typename Function>
Function next_of(Function, const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string path_of(int file) {
    std::array<char, PATH_MAX> path{};
    const std::string link = "/proc/self/fd/" + std::to_string(file);
    return readlink(link.c_str(), path.data(), path.size() - 1) > 0 ? path.data() : "";
}

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

class Disk {
  public:
    void begin() {
        under_ = variable("CUT_UNDER");
        kept_ = variable("CUT_KEPT");
        at_ = std::atoi(variable("CUT_AT").c_str());
        unsetenv("LD_PRELOAD");  // what the program starts itself is on another disk
    }
    void tell() {
        if (!under_.empty()) std::ofstream(kept_ + "/steps") << steps_;
    }
    void step(const std::string& path) {
        if (under_.empty() || !path.starts_with(under_)) return;
        const std::scoped_lock lock(mutex_);
        if (steps_ == at_) kill(getpid(), SIGKILL);
        ++steps_;
    }
    /// The step, and what it leaves on the disk.
    void flush(int file) {
        const std::string path = under_.empty() ? std::string() : path_of(file);
        if (under_.empty() || !path.starts_with(under_)) return;
        const std::scoped_lock lock(mutex_);
        step(path);
        // A descriptor of each: none of their numbers is another one's later, and none is closed,
        // which would let go of SQLite's locks.
        struct stat found {};
        fstat(file, &found);
        int& own = opened_[found.st_ino];
        if (own == 0)
            own = open(("/proc/self/fd/" + std::to_string(file)).c_str(), O_RDONLY | O_CLOEXEC);
        dibhr::test::note_flushed(own, kept_);
    }

  private:
    std::recursive_mutex mutex_{};
    std::string under_{}, kept_{};
    int at_{-1};
    int steps_{0};
    std::map<ino_t, int> opened_{};
};

/// Never destroyed: what is written last is written when all else is.
Disk& disk() {
    static Disk* const one = new Disk;
    return *one;
}

}  // namespace

namespace dibhr::test {

void begin_cut() {
    disk().begin();
}

void tell_steps() {
    disk().tell();
}

}  // namespace dibhr::test

// Names of the C library's.
extern "C" {
ssize_t write(int file, const void* from, size_t bytes) {
    static const auto real = next_of(&write, "write");
    disk().step(path_of(file));
    return real(file, from, bytes);
}
ssize_t pwrite64(int file, const void* from, size_t bytes, off64_t at) {
    static const auto real = next_of(&pwrite64, "pwrite64");
    disk().step(path_of(file));
    return real(file, from, bytes, at);
}
int ftruncate64(int file, off64_t size) noexcept {
    static const auto real = next_of(&ftruncate64, "ftruncate64");
    disk().step(path_of(file));
    return real(file, size);
}
int fsync(int file) {
    disk().flush(file);  // the test's own waits for no disk
    return 0;
}
int fdatasync(int file) {
    disk().flush(file);
    return 0;
}
int rename(const char* from, const char* to) noexcept {
    static const auto real = next_of(&rename, "rename");
    disk().step(to);
    return real(from, to);
}
int renameat2(int from_in, const char* from, int to_in, const char* to, unsigned flags) noexcept {
    static const auto real = next_of(&renameat2, "renameat2");
    disk().step(to);
    return real(from_in, from, to_in, to, flags);
}
int unlink(const char* name) noexcept {
    static const auto real = next_of(&unlink, "unlink");
    disk().step(name);
    return real(name);
}
}
