// The state of a Falcon as data for the panel, the session and its reports.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/falcon/falcon_device.hpp"

namespace dibhr::falcon {

namespace {

std::string serial_text(const Status& status) {
    if (!status.serial.empty()) return status.serial;
    return status.stage == Stage::looking ? "none attached" : "attached";
}

DeviceProgress loading(const Status& status) {
    const std::string tries =
        status.load_try > 1 ? ", try " + std::to_string(status.load_try) : std::string{};
    return {status.loaded, number_text(100.0 * status.loaded, 0) + " %" + tries};
}

std::vector<HomedAxis> axes_of(const Reply& reply) {
    constexpr std::array kAxes{"Top", "Right", "Left"};
    std::vector<HomedAxis> axes;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
        axes.push_back({kAxes[axis], (reply.homed >> axis & 1U) != 0, reply.encoder[axis]});
    return axes;
}

std::vector<DeviceLine> exchange_lines(const Status& status) {
    // Rounded: another last digit each second would have the window drawn each second.
    const double replies_per_s = 10.0 * std::round(0.1 * status.replies_per_s);
    std::vector<DeviceLine> lines{
        {.label = "Replies", .text = number_text(replies_per_s, 0) + " per second"}};
    if (status.resent + status.line_errors + status.bytes_discarded > 0) {
        lines.push_back({.label = "Link",
                         .text = std::to_string(status.resent) + " sent again, " +
                                 std::to_string(status.line_errors) + " line errors, " +
                                 std::to_string(status.bytes_discarded) + " bytes lost"});
    }
    return lines;
}

}  // namespace

DeviceState state_of(const Status& status) {
    using Colour = DeviceLamp::Colour;
    constexpr const char* kLogo = "Logo";
    const Stage stage = status.stage;
    const bool homing = stage == Stage::homing;
    const bool ready = stage == Stage::ready;
    DeviceState state{status};
    state.stage = static_cast<int>(stage);
    state.absent = stage == Stage::looking;
    state.needs_person = !state.absent && !ready;
    state.may_be_ready = ready || homing;
    state.ready = ready;
    state.id = status.serial;
    state.facts = {{"serial", status.serial}};
    state.name_line = {.label = "Falcon", .text = serial_text(status)};
    state.firmware = DeviceFirmware{.needed = stage == Stage::no_firmware};
    if (stage == Stage::loading) state.progress = loading(status);
    if (homing) {
        state.homing = axes_of(status.reply);
        state.lamp = state.pushing_lamp = DeviceLamp{kLogo, Colour::red, "red: not homed yet"};
    }
    if (ready) {
        state.lamp = DeviceLamp{kLogo, Colour::blue, "blue: ready"};
        state.pushing_lamp = DeviceLamp{kLogo, Colour::green, "green: force"};
    }
    if (homing || ready) state.lines = exchange_lines(status);
    return state;
}

}  // namespace dibhr::falcon
