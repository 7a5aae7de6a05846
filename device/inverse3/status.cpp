// The sentences about an Inverse3 for the user.
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

std::string name_of(const Status& status) {
    const std::string kind = status.minverse ? "Minverse" : "Inverse3";
    return status.id.empty() ? kind : kind + " " + status.id;
}

std::string sentence_for(Stage stage, const Status& status) {
    const std::string name = "the " + name_of(status);
    switch (stage) {
        case Stage::looking:
            return status.installed ? "the Haply Inverse Service is not running: start it, with "
                                      "sudo systemctl start haply-inverse-service"
                                    : "the Haply Inverse Service is not installed: get it from "
                                      "Haply (docs.haply.co), and plug in the Inverse3";
        case Stage::too_old:
            return "the Haply Inverse Service is too old" +
                   (status.version.empty() ? std::string{} : " (" + status.version + ")") +
                   ": install version 3.1 or newer";
        case Stage::not_understood:
            return "the Haply Inverse Service sends messages that dibhr does not understand, or "
                   "repeats an old position: no force; update the service or dibhr, and restart "
                   "the service";
        case Stage::no_device:
            return "the Haply Inverse Service has no Inverse3: plug in its USB cable and its "
                   "power";
        case Stage::no_power:
            return name + " has no power: plug in its power adapter";
        case Stage::not_calibrated:
            return name +
                   " is not calibrated: hold the grip on the inkwell until the light stays "
                   "on";
        case Stage::locked:
            return status.minverse ? name + " is locked: attach its grip"
                                   : name + " is not ready: see what the Haply Hub says about it";
        case Stage::in_use:
            return name + " is in use by another program: end that one";
        case Stage::other_frame:
            return name + " has its axes exchanged: set its basis to XYZ in the Haply Hub";
        case Stage::other_preset:
            return name + " keeps the preset " + status.preset +
                   " though the settings ask for another one: choose that in the Haply Hub, or " +
                   status.preset + " on the Device panel";
        case Stage::slow:
            return "the Haply Inverse Service answers too slowly: no force; close other programs, "
                   "or start it again";
        case Stage::force_refused:
            return "the Haply Inverse Service accepts a force in neither of the two formats: no "
                   "force; update the service or dibhr";
        case Stage::ready:
            return "ready to touch";
    }
    return {};
}

}  // namespace dibhr::inverse3
