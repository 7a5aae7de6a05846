// A bare Falcon, a person beside it, and a folder for the record of the check.
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>

#include "device/falcon/check/check.hpp"
#include "tests/device/falcon/check_person.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test::falcon {

using dibhr::CheckResult;
using dibhr::falcon::CheckOptions;

inline bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

struct Checked {
    UsbBench bus{};
    Unit& unit{bus.plug()};
    CheckPerson person{bus, unit};
    CheckOptions options{};
    TemporaryFolder folder{};

    Checked() {
        options.firmware = any_firmware();
        options.record = folder / "record.json";
        options.times = short_times();
    }

    CheckResult run() { return run_check(options, person); }

    [[nodiscard]] std::string record() const { return dibhr::test::read_text(options.record); }
    [[nodiscard]] std::string value(const std::string& path) const {
        return json_value(record(), path);
    }
    [[nodiscard]] double number(const std::string& path) const { return std::stod(value(path)); }
    [[nodiscard]] std::string end_of(int step) const {
        return value("$.steps[" + std::to_string(step) + "].end");
    }
    [[nodiscard]] std::string found(const std::string& question) const {
        return value("$.findings.\"" + question + "\"");
    }
    [[nodiscard]] std::string setting(const std::string& name) const {
        return value("$.settings.\"" + name + "\"");
    }
    /// Skips every step but the one whose title this is, with a Falcon that is homed.
    void only(const std::string& title) {
        person.instead = [this, title](const std::string& question) -> std::optional<std::string> {
            const bool begins_step = question == "Enter = go on, s = skip, q = quit" ||
                                     holds(question, "begin with force");
            if (!begins_step) return std::nullopt;
            const std::size_t step = person.heard.rfind(" of 9: ");
            const bool wanted = person.heard.find(" of 9: " + title + "\n", step) == step;
            return wanted ? "f" : "s";
        };
        start_firmware(unit);
        home(unit);
    }
};

}  // namespace dibhr::test::falcon
