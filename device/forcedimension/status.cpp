// The sentences about a Force Dimension arm for the user.
#include "device/forcedimension/status.hpp"

#include "device/forcedimension/models.hpp"

namespace dibhr::forcedimension {

namespace {

constexpr const char* kSwitchOn = "choose Switch the force on, on the Device panel";

std::string force_off_sentence(const std::string& name, ForceOff cause) {
    switch (cause) {
        case ForceOff::button:
            return name +
                   " has its force off, because its force button was pressed: press it "
                   "again, or " +
                   kSwitchOn;
        case ForceOff::velocity:
            return name +
                   " switched its force off, because it moved too fast: hold the grip, then " +
                   kSwitchOn;
        case ForceOff::watchdog:
            return name +
                   " switched its force off, because dibhr sent nothing for too long: the "
                   "force comes back by itself";
        case ForceOff::dead_man:
            return name + " has its force off, because nobody holds its grip: hold the grip";
        case ForceOff::unplugged:
            return name +
                   " switched its force off, because its USB connection was lost: " + kSwitchOn;
        case ForceOff::none:
        case ForceOff::software:
            return name + " has its force off: " + kSwitchOn;
    }
    return {};
}

}  // namespace

std::string name_of(const Status& status) {
    if (status.type < 0) return "the Force Dimension arm";
    return "the " + name_of_type(status.type) + (status.serial.empty() ? "" : " " + status.serial);
}

std::string sentence_for(Stage stage, const Status& status) {
    const std::string name = name_of(status);
    switch (stage) {
        case Stage::looking:
            return "no Force Dimension arm is attached: plug in its USB cable and its power";
        case Stage::no_permission:
            return "a Force Dimension arm is attached, and you may not open it";
        case Stage::cannot_open:
            return name + " cannot be opened: switch it off and on, and plug it in again";
        case Stage::no_power:
            return name + " has no power: switch it on";
        case Stage::not_initialised:
            return name +
                   " does not know its position: keep hands and objects away from the arm, "
                   "then initialise it on the Device panel, or with dibhr devices --initialise";
        case Stage::initialising:
            return name + " moves by itself to its stops: keep hands away until it stands still";
        case Stage::fault:
            return name + " reports a fault: switch it off and on";
        case Stage::force_off:
            return force_off_sentence(name, status.cause);
        case Stage::slow:
            return name +
                   " answers too slowly: no force; close other programs, or use another USB "
                   "port";
        case Stage::ready:
            return "ready to touch";
    }
    return {};
}

}  // namespace dibhr::forcedimension
