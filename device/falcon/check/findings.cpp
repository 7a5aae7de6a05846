// What README.md leaves open, and what was found.
#include "device/falcon/check/findings.hpp"

#include <algorithm>

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

}  // namespace

void Findings::settle(OpenQuestion question, std::string found) {
    found_.at(static_cast<std::size_t>(question)) = std::move(found);
}

void Findings::set(const std::string& name, const std::string& value) {
    const auto known = std::find_if(settings_.begin(), settings_.end(),
                                    [&](const auto& setting) { return setting.first == name; });
    if (known == settings_.end()) {
        settings_.emplace_back(name, value);
    } else {
        known->second = value;
    }
}

std::string Findings::summary() const {
    std::string text = "What was found\n";
    for (std::size_t k = 0; k < kOpenQuestions; ++k) {
        text += std::string("  ") + kNamed.at(k).question + "\n    " +
                (found_.at(k).empty() ? "still open" : found_.at(k)) + "\n";
    }
    if (settings_.empty()) return text + "No setting follows from it.\n";
    text += "For the settings file\n  [falcon]\n";
    for (const auto& [name, value] : settings_) {
        text.append("  ").append(name).append(" = ").append(value).append("\n");
    }
    return text;
}

void Findings::add_to(Measured& record) const {
    Measured findings;
    for (std::size_t k = 0; k < kOpenQuestions; ++k) {
        if (found_.at(k).empty()) {
            findings.add_null(kNamed.at(k).name);
        } else {
            findings.add(kNamed.at(k).name, found_.at(k));
        }
    }
    Measured settings;
    for (const auto& [name, value] : settings_) settings.add(name, value);
    record.add("findings", findings).add("settings", settings);
}

}  // namespace dibhr::falcon
