// The record of a check.
#include "device/falcon/check/record.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <ctime>

#include "core/files/output_file.hpp"

namespace dibhr::falcon {

namespace {

/// Now, in UTC, as strftime() has it.
std::string utc(const char* format) {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 64> text{};
    const std::size_t size = std::strftime(text.data(), text.size(), format, &parts);
    return {text.data(), size};
}

/// A serial is whatever the device says: letters, digits and dashes of it.
std::string fit_for_a_file_name(const std::string& serial) {
    std::string name;
    for (const char c : serial) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
        name += plain ? c : '_';
    }
    return name.empty() ? "unknown" : name;
}

const char* name_of(StepEnd end) {
    switch (end) {
        case StepEnd::done:
            return "done";
        case StepEnd::skipped:
            return "skipped";
        case StepEnd::quit:
            return "quit";
        case StepEnd::failed:
            return "failed";
        case StepEnd::not_begun:
            return "not begun";
    }
    return "";
}

}  // namespace

CheckRecord::CheckRecord(std::filesystem::path file, const AttachedFalcon& falcon,
                         const std::vector<std::pair<std::string, std::string>>& facts)
    : file_(std::move(file)) {
    if (file_.empty()) {
        file_ = "falcon-check-" + fit_for_a_file_name(falcon.serial) + "-" +
                utc("%Y-%m-%d-%H%M%S") + ".json";
    }
    head_.add("format", "dibhr falcon check")
        .add("format_version", 1)
        .add("begun_utc", utc("%Y-%m-%dT%H:%M:%SZ"))
        .add("serial", falcon.serial);
    for (const auto& [name, value] : facts) head_.add(name, value);
}

void CheckRecord::add(const char* step, StepEnd end, const std::string& remark, double seconds,
                      const Measured& measured) {
    Measured part;
    part.add("step", step).add("end", name_of(end)).add("seconds", seconds);
    if (!remark.empty()) part.add("remark", remark);
    part.add("measured", measured);
    steps_.add(part);
}

void CheckRecord::write(const Findings& findings) const {
    Measured record = head_;
    record.add("steps", steps_);
    findings.add_to(record);
    OutputFile out(file_);
    out.write(record.text() + "\n");
    out.commit();
}

}  // namespace dibhr::falcon
