// The state of a Touch as data for the panel, the session and its reports.
#include <cmath>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/openhaptics/openhaptics_device.hpp"

namespace dibhr::openhaptics {

namespace {

constexpr const char* kUnguarded =
    "3D Systems' library owns the Touch: when dibhr is killed, only the Touch's own watchdog ends "
    "the force";

bool is_open(Stage stage) noexcept {
    return stage > Stage::looking;
}

/// Rounded: another last digit each second would have the window drawn each second.
std::string rate_text(double per_s) {
    return number_text(10.0 * std::round(0.1 * per_s), 0) + " per second";
}

std::vector<DeviceLine> lines_of(const Status& status) {
    std::vector<DeviceLine> lines{
        {"Driver", status.driver + ", library " + status.version,
         "Versions that 3D Systems' library reports"},
        {"Servo ticks", rate_text(status.ticks_per_s),
         "How often 3D Systems' library takes a force"},
        {"Force", number_text(status.limit_newton, 2) + " N at most",
         "The force that the motors stand for ever; lower while they are warm"},
        {"Motors",
         status.reports_heat ? number_text(100.0 * status.warmest, 0) + " % warm"
                             : "temperature not reported",
         "Of the warmest motor, as the library predicts it: from 70 % on the force is lower"}};
    if (status.errors > 0)
        lines.push_back(
            {.label = "Errors",
             .text = std::to_string(status.errors) + ", the last one: " + status.last_error});
    return lines;
}

}  // namespace

DeviceState state_of(const Status& status) {
    const Stage stage = status.stage;
    DeviceState state{status};
    state.stage = static_cast<int>(stage);
    state.absent = !is_open(stage);
    state.ready = stage == Stage::ready;
    state.needs_person = is_open(stage) && !state.ready;
    state.may_be_ready = is_open(stage);
    state.id = status.serial;
    if (!status.model.empty()) state.full_name = "3D Systems " + status.model;
    state.facts = {{"driver", status.driver},
                   {"library-version", status.version},
                   {"model", status.model},
                   {"serial", status.serial}};
    state.name_line = {.label = "Touch", .text = is_open(stage) ? status.serial : "none attached"};
    if (is_open(stage)) {
        state.unguarded = kUnguarded;
        state.lines = lines_of(status);
    }
    return state;
}

}  // namespace dibhr::openhaptics
