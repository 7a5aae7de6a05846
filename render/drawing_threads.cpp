// The threads that software OpenGL draws with, and their share of the processor.
#include "render/drawing_threads.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "core/realtime/time_slice.hpp"

namespace dibhr {

namespace {

constexpr int kLowestNiceness = 19;

/// Whether Mesa's driver llvmpipe named this thread as its own; other drivers have no such threads.
bool draws(const std::filesystem::path& thread) {
    std::ifstream file(thread / "comm");
    std::string name;
    return std::getline(file, name) && name.starts_with("llvmpipe-");
}

/// Calls `act` with the folder in /proc of each of them. None, where they cannot be listed.
template <typename Act>
void each_that_draws(const Act& act) {
    std::error_code none;
    std::filesystem::directory_iterator thread("/proc/self/task", none);
    for (; !none && thread != std::filesystem::directory_iterator(); thread.increment(none))
        if (draws(thread->path())) act(thread->path());
}

/// Time on a processor; 0 where the system does not tell.
double processor_s(const std::filesystem::path& thread) {
    std::ifstream file(thread / "schedstat");
    double used_ns = 0.0;
    return file >> used_ns ? 1e-9 * used_ns : 0.0;
}

}  // namespace

void lower_drawing_priority() {
    const int own = getpriority(PRIO_PROCESS, 0);
    const int niceness = std::min(own + kDrawingNiceness, kLowestNiceness);
    each_that_draws([niceness](const std::filesystem::path& thread) {
        const auto id = std::strtoul(thread.filename().c_str(), nullptr, 10);
        setpriority(PRIO_PROCESS, static_cast<id_t>(id), niceness);
        (void)set_time_slice(kPatientSlice, static_cast<pid_t>(id));
    });
    (void)set_time_slice(kPatientSlice);
}

double drawing_s() {
    double used_s = processor_s("/proc/thread-self");
    each_that_draws([&](const std::filesystem::path& thread) { used_s += processor_s(thread); });
    return used_s;
}

}  // namespace dibhr
