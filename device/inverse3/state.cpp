// The state of an Inverse3 as data for the panel, the session and its reports.
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/inverse3/inverse3_device.hpp"

namespace dibhr::inverse3 {

namespace {

std::string id_text(const Status& status) {
    if (status.id.empty()) return "none attached";
    const char* const hand = status.handedness == Handedness::left    ? ", left hand"
                             : status.handedness == Handedness::right ? ", right hand"
                                                                      : "";
    return status.id + hand;
}

std::string dialect_text(const Status& status) {
    if (!status.dialect) return "not known yet";
    return std::string(name_of(*status.dialect)) +
           (status.dialect_confirmed ? ", confirmed" : ", not confirmed yet");
}

std::string grip_text(const GripStatus& grip) {
    std::string text = grip.wired ? "wired" : grip.awake ? "awake" : "asleep: press its button";
    if (grip.battery) text += ", battery " + number_text(100.0 * *grip.battery, 0) + " %";
    return text;
}

std::vector<DeviceLine> lines_of(const Status& status, const PoseAges& recent) {
    std::vector<DeviceLine> lines =
        exchange_lines(status, recent,
                       "Time from a message to the service's answer: above 2 ms springs are "
                       "softer, above 5 ms there is no force",
                       "service");
    lines.push_back({"Forces", dialect_text(status),
                     "In which format the service gets a force, and whether it has confirmed one"});
    if (!status.preset.empty()) {
        lines.push_back(
            {.label = "Preset",
             .text = status.preset + (status.other_preset ? ", though another is asked for" : "")});
    }
    if (status.grip) lines.push_back({.label = "Grip", .text = grip_text(*status.grip)});
    if (status.unrequested + status.not_understood > 0) {
        lines.push_back({.label = "Link",
                         .text = std::to_string(status.unrequested) + " not asked for, " +
                                 std::to_string(status.not_understood) + " not understood"});
    }
    return lines;
}

}  // namespace

DeviceState state_of(const Status& status, const PoseAges& recent) {
    const Stage stage = status.stage;
    DeviceState state{status};
    state.stage = static_cast<int>(stage);
    state.absent = stage == Stage::looking || stage == Stage::no_device;
    state.ready = stage == Stage::ready;
    state.needs_person = !state.absent && !state.ready;
    state.may_be_ready = !status.id.empty();
    state.id = status.id;
    state.full_name = "Haply " + name_of(status);
    state.facts = {{"dialect", status.dialect ? name_of(*status.dialect) : ""},
                   {"id", status.id},
                   {"preset-read", status.preset},
                   {"service", status.version}};
    state.name_line = {.label = status.minverse ? "Minverse" : "Inverse3", .text = id_text(status)};
    if (!status.version.empty())
        state.lines.push_back({.label = "Service", .text = status.version});
    if (!state.ready) return state;
    for (DeviceLine& line : lines_of(status, recent)) state.lines.push_back(std::move(line));
    return state;
}

}  // namespace dibhr::inverse3
