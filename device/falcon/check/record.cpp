// The record of a check, and what was found.
#include "device/falcon/check/record.hpp"

#include <chrono>
#include <ctime>
#include <string_view>

#include "core/files/output_file.hpp"

namespace dibhr::falcon {

namespace {

struct Named {
    const char* name;      ///< in the record
    const char* question;  ///< for people
};

constexpr std::array<Named, kOpenQuestions> kNamed{{
    {"identity", "What it says it is"},
    {"upload-speed", "Firmware at 142 857 and 140 351 baud"},
    {"stray-bytes", "Stray bytes before the hello's and the A's answer"},
    {"loading-again", "Loading again without a power cycle"},
    {"last-byte", "Byte 14 of a reply"},
    {"reply-rate", "Replies a second"},
    {"event-character", "The event character >"},
    {"homing-bit", "The homing bit cleared"},
    {"end-stops", "Counts at the end stops"},
    {"angle-at-zero", "Thigh angle at count 0"},
    {"after-last-packet", "The force after the last packet"},
    {"torque-scale", "Motor counts a newton metre"},
    {"buttons", "Button bits"},
    {"usb-unplugged", "USB unplugged, power on"},
    {"power-lost", "Power off, USB on"},
}};

constexpr std::array kNamesOfEnds{"done", "skipped", "quit", "failed", "not begun"};
static_assert(kNamesOfEnds.size() == static_cast<std::size_t>(StepEnd::not_begun) + 1);

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

}  // namespace

Json as_json(Vec3 values) {
    return Json::array({values.x, values.y, values.z});
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        if (!text.empty()) text += ' ';
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

void Findings::settle(OpenQuestion question, std::string found) {
    found_.at(static_cast<std::size_t>(question)) = std::move(found);
}

std::string Findings::summary() const {
    std::string text = "What was found\n";
    for (std::size_t k = 0; k < kOpenQuestions; ++k) {
        text += std::string("  ") + kNamed.at(k).question + "\n    " +
                (found_.at(k).empty() ? "still open" : found_.at(k)) + "\n";
    }
    if (settings_.empty()) return text + "No setting follows from it.\n";
    text += "For the settings file\n  [falcon]\n";
    for (const auto& [name, value] : settings_.items()) {
        text += "  " + name + " = " + value.get<std::string>() + "\n";
    }
    return text;
}

void Findings::add_to(Json& record) const {
    Json findings;
    for (std::size_t k = 0; k < kOpenQuestions; ++k) {
        findings[kNamed.at(k).name] = found_.at(k).empty() ? Json() : Json(found_.at(k));
    }
    record["findings"] = findings;
    record["settings"] = settings_;
}

CheckRecord::CheckRecord(std::filesystem::path file, const AttachedFalcon& falcon,
                         const std::vector<std::pair<std::string, std::string>>& facts)
    : file_(std::move(file)) {
    if (file_.empty()) {
        file_ = "falcon-check-" + fit_for_a_file_name(falcon.serial) + "-" +
                utc("%Y-%m-%d-%H%M%S") + ".json";
    }
    head_ = {{"format", "dibhr falcon check"},
             {"format_version", 1},
             {"begun_utc", utc("%Y-%m-%dT%H:%M:%SZ")},
             {"serial", falcon.serial}};
    for (const auto& [name, value] : facts) head_[name] = value;
}

void CheckRecord::add(const char* step, StepEnd end, const std::string& remark, double seconds,
                      const Json& measured) {
    Json part{{"step", step},
              {"end", kNamesOfEnds.at(static_cast<std::size_t>(end))},
              {"seconds", seconds}};
    if (!remark.empty()) part["remark"] = remark;
    part["measured"] = measured;
    steps_.push_back(part);
}

void CheckRecord::write(const Findings& findings) const {
    Json record = head_;
    record["steps"] = steps_;
    findings.add_to(record);
    OutputFile out(file_);
    out.write(json_text(record));
    out.commit();
}

}  // namespace dibhr::falcon
