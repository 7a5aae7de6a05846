// The record of a check, and its findings.
#include "device/hand/check/record.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <thread>
#include <utility>

#include "core/files/machine.hpp"
#include "core/files/output_file.hpp"

namespace dibhr {

namespace {

constexpr std::array kNamesOfEnds{"done", "skipped", "let go", "quit", "failed", "not begun"};
static_assert(kNamesOfEnds.size() == static_cast<std::size_t>(CheckEnd::not_begun) + 1);

/// Facts that are not known are left out.
Json machine_facts() {
    const Machine machine = this_machine();
    Json facts{{"cpus", std::thread::hardware_concurrency()}};
    const auto add = [&facts](const char* key, const std::string& value) {
        if (!value.empty()) facts[key] = value;
    };
    add("system", machine.system);
    add("kernel", machine.kernel);
    add("cpu", machine.cpu);
    return facts;
}

/// The current time, formatted by strftime().
std::string moment(const char* format, std::tm* (*in_zone)(const std::time_t*, std::tm*)) {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    in_zone(&now, &parts);
    std::array<char, 64> text{};
    const std::size_t size = std::strftime(text.data(), text.size(), format, &parts);
    return {text.data(), size};
}

std::string utc(const char* format) {
    return moment(format, gmtime_r);
}

/// A serial can hold any character: all but letters, digits and dashes are replaced.
std::string fit_for_a_file_name(const std::string& serial) {
    std::string name;
    for (const char c : serial) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
        name += plain ? c : '_';
    }
    return name.empty() ? "unknown" : name;
}

}  // namespace

std::string CheckFindings::summary() const {
    std::string text = "What was found\n";
    for (std::size_t k = 0; k < found_.size(); ++k) {
        text += std::string("  ") + questions_[k].question + "\n    " +
                (found_.at(k).empty() ? "still open" : found_.at(k)) + "\n";
    }
    if (settings_.empty()) return text + "No setting follows from it.\n";
    text += "For the settings file\n  [" + std::string(table_) + "]\n";
    for (const auto& [name, value] : settings_.items()) {
        text += "  " + name + " = " + value.get<std::string>() + "\n";
    }
    return text;
}

void CheckFindings::add_to(Json& record) const {
    Json findings;
    for (std::size_t k = 0; k < found_.size(); ++k) {
        findings[questions_[k].name] = found_.at(k).empty() ? Json() : Json(found_.at(k));
    }
    record["findings"] = findings;
    record["settings"] = settings_;
}

CheckRecord::CheckRecord(std::filesystem::path file, const CheckedDevice& device,
                         const std::vector<std::pair<std::string, std::string>>& facts)
    : file_(std::move(file)) {
    if (file_.empty()) {
        file_ = device.kind + "-check-" + fit_for_a_file_name(device.name) + "-" +
                utc("%Y-%m-%d-%H%M%S") + ".json";
    }
    head_ = {{"format", "dibhr " + device.kind + " check"},
             {"format_version", 1},
             {"begun_utc", utc("%Y-%m-%dT%H:%M:%SZ")},
             {"begun_local", moment("%Y-%m-%dT%H:%M:%S%z", localtime_r)},
             {device.name_key, device.name}};
    for (const auto& [name, value] : facts) head_[name] = value;
    head_["machine"] = machine_facts();
}

void CheckRecord::add(const char* step, CheckEnd end, const std::string& remark, double seconds,
                      const Json& measured) {
    Json part{{"step", step},
              {"end", kNamesOfEnds.at(static_cast<std::size_t>(end))},
              {"seconds", seconds}};
    if (!remark.empty()) part["remark"] = remark;
    part["measured"] = measured;
    steps_.push_back(part);
}

void CheckRecord::write(const CheckFindings& findings) const {
    Json record = head_;
    record["steps"] = steps_;
    findings.add_to(record);
    if (!legend_.is_null()) record["legend"] = legend_;
    write_file(file_, json_text(record));
}

}  // namespace dibhr
