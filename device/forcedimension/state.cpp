// The state of a Force Dimension arm as data for the panel, the session and its reports.
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/forcedimension/forcedimension_device.hpp"
#include "device/forcedimension/models.hpp"

namespace dibhr::forcedimension {

namespace {

std::string watchdog_text(const Status& status) {
    return status.watchdog_ms > 0.0 ? number_text(status.watchdog_ms, 1) + " ms" : "none";
}

std::vector<DeviceLine> lines_of(const Status& status, const PoseAges& recent) {
    std::vector<DeviceLine> lines =
        exchange_lines(status, recent,
                       "Time for setting a force and reading a position: above 2 ms springs are "
                       "softer, above 5 ms there is no force",
                       "arm");
    lines.push_back({"Watchdog", watchdog_text(status),
                     "The arm itself takes its force off when dibhr sends nothing for so long"});
    if (!is_known(status.type)) {
        lines.push_back({.text = "dibhr does not know this type of arm: its force is limited to " +
                                 number_text(model_of(status.type).force_newton, 0) + " N."});
    }
    if (status.failed_calls > 0) {
        lines.push_back(
            {.label = "Link", .text = std::to_string(status.failed_calls) + " calls failed"});
    }
    return lines;
}

}  // namespace

DeviceState state_of(const Status& status, const PoseAges& recent) {
    const Stage stage = status.stage;
    const bool known = status.type >= 0;
    DeviceState state{status};
    state.stage = static_cast<int>(stage);
    state.absent = stage == Stage::looking;
    state.ready = stage == Stage::ready;
    state.needs_person = !state.absent && !state.ready;
    state.may_be_ready = state.ready || known;
    state.id = status.serial;
    state.full_name = known ? "Force Dimension " + name_of_type(status.type) : "";
    state.facts = {
        {"controller", status.controller_version ? number_text(*status.controller_version, 2) : ""},
        {"library", status.library},
        {"serial", status.serial},
        {"type", known ? std::to_string(status.type) : ""},
        {"watchdog-ms", number_text(status.watchdog_ms, 1)}};
    state.offer = status.offer;
    state.name_line = {
        .label = "Force Dimension",
        .text = known ? name_of_type(status.type) + " " + status.serial : "none attached"};
    if (!status.library.empty())
        state.lines.push_back({.label = "Library", .text = status.library});
    if (!state.ready) return state;
    for (DeviceLine& line : lines_of(status, recent)) state.lines.push_back(std::move(line));
    return state;
}

}  // namespace dibhr::forcedimension
