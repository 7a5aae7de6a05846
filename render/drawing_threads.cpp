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

}  // namespace

void lower_drawing_priority() {
    const int own = getpriority(PRIO_PROCESS, 0);
    const int niceness = std::min(own + kDrawingNiceness, kLowestNiceness);
    std::error_code none;  // if the threads cannot be listed, they keep their priority
    std::filesystem::directory_iterator thread("/proc/self/task", none);
    for (; !none && thread != std::filesystem::directory_iterator(); thread.increment(none)) {
        if (!draws(thread->path())) continue;
        const auto id = std::strtoul(thread->path().filename().c_str(), nullptr, 10);
        setpriority(PRIO_PROCESS, static_cast<id_t>(id), niceness);
        (void)set_time_slice(kPatientSlice, static_cast<pid_t>(id));
    }
    (void)set_time_slice(kPatientSlice);
}

}  // namespace dibhr
