// The state of an Inverse3 as data for the panel, the session and its reports.
#include <string>
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

/// The histogram's last bin has no upper end.
std::string age_text(double ms) {
    return ms > PoseAges::kLongest_ms ? "20 ms or more" : number_text(ms, 2) + " ms";
}

void add_exchange(const Status& status, const PoseAges& recent, std::vector<DeviceLine>& lines) {
    lines.push_back({"Exchanges",
                     number_text(status.exchanges_per_s, 0) + " per second, " +
                         number_text(status.exchange_ms, 1) + " ms each",
                     "Time from a message to the service's answer: above 2 ms springs are softer, "
                     "above 5 ms there is no force"});
    if (status.softened) {
        lines.push_back({.text = "The service answers slowly: springs are softer, so that they do "
                                 "not swing."});
    }
    if (recent.count() > 0) {
        lines.push_back({"Age of the pose",
                         age_text(recent.quantile_ms(0.5)) + ", 99 % below " +
                             age_text(recent.quantile_ms(0.99)),
                         "Age of the position that a tick uses, in the last second. A position "
                         "older than 20 ms gives no force"});
    }
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
    if (state.ready) add_exchange(status, recent, state.lines);
    return state;
}

}  // namespace dibhr::inverse3
