// What a recording says of the machine it was made on.
#include "core/session/tick_record.hpp"

#include <sys/utsname.h>

#include <fstream>
#include <string>
#include <string_view>

namespace dibhr {

namespace {

/// What follows `separator` in the first line that begins with `name`, without quotation marks.
std::string value_in(const char* file, std::string_view name, char separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t at = line.find(separator);
        if (!line.starts_with(name) || at == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
        const std::size_t end = line.find_last_not_of(" \t\"");
        return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
    }
    return {};
}

}  // namespace

SessionFacts machine_facts() {
    SessionFacts facts;
    const auto add = [&facts](const char* key, const std::string& value) {
        if (!value.empty()) facts[key] = value;
    };
    add("machine-cpu", value_in("/proc/cpuinfo", "model name", ':'));
    add("machine-system", value_in("/etc/os-release", "PRETTY_NAME", '='));
    utsname kernel{};
    if (uname(&kernel) == 0) {
        add("machine-kernel",
            std::string(kernel.sysname) + " " + kernel.release + " " + kernel.machine);
    }
    return facts;
}

}  // namespace dibhr
