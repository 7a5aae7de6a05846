// Opens arms, prepares them, and stops them.
#include "device/forcedimension/arm.hpp"

#include "device/forcedimension/models.hpp"
#include "device/hand/udev_rule.hpp"

namespace dibhr::forcedimension {

Arm::~Arm() {
    library_->stop(id_);
    library_->close(id_);
}

void Arm::identify(Status& status) const {
    status.type = library_->type(id_);
    const auto serial = library_->serial(id_);
    status.serial = serial ? std::to_string(*serial) : std::string{};
    status.controller_version = library_->controller_version(id_);
}

void Arm::prepare(Status& status) const {
    status.watchdog_ms = library_->start_watchdog(id_);
    status.unguarded =
        status.watchdog_ms > 0.0
            ? std::string{}
            : name_of(status) + " has no watchdog: if dibhr is killed, switch the arm off";
    status.clamped = library_->set_max_force(id_, model_of(status.type).force_newton);
    if (library_->has_gripper(id_)) library_->emulate_button(id_);
}

bool Arm::switch_force_on() const {
    return library_->hold_weight(id_) && library_->set_force(id_, Vec3{0.0}) &&
           library_->enable_force(id_, true);
}

bool ArmSearch::has_next() const noexcept {
    return by_type_ ? known_type(static_cast<std::size_t>(place_)) != 0 : place_ < count_;
}

std::unique_ptr<Arm> ArmSearch::next() {
    while (has_next()) {
        const int place = place_++;
        const auto id = by_type_ ? library_->open_type(known_type(static_cast<std::size_t>(place)))
                                 : library_->open(place);
        if (!id) {
            // Most of the types are not attached.
            const int error = library_->last_error();
            if (!by_type_ || error == kDeviceInUse) last_error_ = error;
            continue;
        }
        auto arm = std::make_unique<Arm>(library_, *id);
        // A Falcon that the system's list of USB devices does not show.
        if (library_->type(*id) != kFalconType) return arm;
    }
    return nullptr;
}

NoArm why_no_arm(const ArmSearch& search, const UsbBus& bus, const std::string& serial) {
    if (search.last_error() == kDeviceInUse)
        return {Stage::cannot_open,
                "the Force Dimension arm is in use by another program: end that one"};
    if (!bus.refused_node.empty())
        return {Stage::no_permission,
                sentence_for(Stage::no_permission, {}) + ": " +
                    how_to_get_permission("70-dibhr-forcedimension.rules", "the arm")};
    if (search.count() > 0 && search.last_error() != 0)
        return {Stage::cannot_open, sentence_for(Stage::cannot_open, {}) + " (error " +
                                        std::to_string(search.last_error()) + ")"};
    if (!serial.empty())
        return {Stage::looking, "no Force Dimension arm with serial " + serial +
                                    " is attached: see dibhr devices for those that are"};
    return {Stage::looking, sentence_for(Stage::looking, {})};
}

std::string why_no_library(const UsbBus& bus) {
    if (!bus.has_arm) return {};
    return "a Force Dimension arm is attached, and its maker's library is not installed: get the "
           "SDK from forcedimension.com, and name its folder in FDSDK or on the Device panel";
}

}  // namespace dibhr::forcedimension
