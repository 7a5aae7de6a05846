// What the fact sheet leaves open, and what was found.
#include "device/falcon/check/findings.hpp"

#include <algorithm>

namespace dibhr::falcon {

namespace {

struct Named {
    const char* name;      ///< in the record
    const char* question;  ///< for people
};

constexpr std::array<Named, kOpenQuestions> kNamed{{
    {"identity", "What it says it is (section 2)"},
    {"upload-speed", "Firmware at 142 857 and 140 351 baud (section 6)"},
    {"stray-bytes", "Stray bytes before the hello's and the A's answer (section 6)"},
    {"loading-again", "Loading again without a power cycle (section 6)"},
    {"last-byte", "Byte 14 of a reply (section 8)"},
    {"reply-rate", "Replies a second (section 11)"},
    {"event-character", "The event character > (sections 3 and 11)"},
    {"homing-bit", "The homing bit cleared (section 9)"},
    {"end-stops", "Counts at the end stops (section 10)"},
    {"angle-at-zero", "Thigh angle at count 0 (section 10)"},
    {"after-last-packet", "The force after the last packet (section 11)"},
    {"torque-scale", "Motor counts a newton metre (section 11)"},
    {"buttons", "Button bits (section 8)"},
    {"usb-unplugged", "USB unplugged, power on (section 5)"},
    {"power-lost", "Power off, USB on (sections 1 and 5)"},
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
