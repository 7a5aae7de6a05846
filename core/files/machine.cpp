// Reads /etc, /proc, uname and the environment.
#include "core/files/machine.hpp"

#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>

namespace dibhr {

namespace {

/// What follows `key` and `separator` in the first line that begins with it.
std::string line_of(const char* file, std::string_view key, char separator) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t at = line.find(separator);
        if (!line.starts_with(key) || at == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
        if (begin == std::string::npos) return {};
        return line.substr(begin, line.find_last_not_of(" \t\"") - begin + 1);
    }
    return {};
}

}  // namespace

Machine this_machine() {
    Machine machine{.system = line_of("/etc/os-release", "PRETTY_NAME", '='),
                    .cpu = line_of("/proc/cpuinfo", "model name", ':')};
    utsname kernel{};
    if (uname(&kernel) == 0)
        machine.kernel = std::string(kernel.sysname) + " " + kernel.release + " " + kernel.machine;
    return machine;
}

std::string_view environment_variable(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::filesystem::path home_folder() {
    const std::string_view folder = environment_variable("HOME");
    return folder.starts_with('/') ? folder : "/";
}

std::filesystem::path program_folder(const char* variable, const std::filesystem::path& usual) {
    const std::string_view folder = environment_variable(variable);
    return (folder.starts_with('/') ? std::filesystem::path(folder) : home_folder() / usual) /
           "dibhr";
}

}  // namespace dibhr
