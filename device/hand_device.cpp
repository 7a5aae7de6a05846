// Makes the device named on the command line.
#include "device/hand_device.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "device/falcon/survey.hpp"
#include "device/falcon_or_mouse.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

HandDevice mouse_hand() {
    HandDevice hand;
    auto mouse = std::make_unique<MouseHand>();
    hand.mouse = mouse.get();
    hand.device = std::move(mouse);
    return hand;
}

HandDevice falcon_hand(const FalconChoice& choice) {
    FirmwareAtHand firmware = firmware_at_hand(choice.firmware);
    HandDevice hand;
    hand.firmware = firmware.image.name;
    hand.firmware_trouble = std::move(firmware.trouble);
    auto both = std::make_unique<FalconOrMouse>(choice.connection, std::move(firmware.image));
    hand.mouse = &both->mouse();
    hand.falcon = &both->falcon();
    hand.device = std::move(both);
    return hand;
}

/// The one that is meant. Throws DeviceError when none is attached, or it is not clear which.
falcon::AttachedFalcon attached_falcon(const std::string& serial) {
    const std::vector<falcon::AttachedFalcon> attached = falcon::attached_falcons();
    if (attached.empty()) {
        throw DeviceError(
            "no Novint Falcon is attached: plug in its USB cable and its power adapter, or use "
            "--device mouse");
    }
    if (serial.empty() && attached.size() > 1) {
        throw DeviceError(std::to_string(attached.size()) + " Novint Falcons are attached (" +
                          serials_of(attached) +
                          "): choose one with --device falcon:SERIAL or in the settings");
    }
    const auto meant = falcon::choose(attached, serial);
    if (!meant) {
        throw DeviceError(falcon::why_none(attached, serial) + " with --device falcon:SERIAL");
    }
    return *meant;
}

/// Throws DeviceError when it refuses to be opened. What it needs after that, firmware or homing,
/// is guided in the window.
HandDevice required_falcon_hand(const FalconChoice& choice) {
    const std::string refusal =
        falcon::why_it_cannot_be_opened(attached_falcon(choice.connection.serial));
    if (!refusal.empty()) throw DeviceError(refusal);
    return falcon_hand(choice);
}

}  // namespace

HandDevice make_hand_device(const std::string& name, const FalconChoice& choice) {
    constexpr std::string_view kGoals = "goals:";
    constexpr std::string_view kFalcon = "falcon:";
    if (name == "mouse") return mouse_hand();
    if (name == "auto") return falcon_hand(choice);
    if (name == "falcon") return required_falcon_hand(choice);
    if (name.starts_with(kFalcon)) {
        FalconChoice chosen = choice;
        chosen.connection.serial = name.substr(kFalcon.size());
        return required_falcon_hand(chosen);
    }
    if (name.starts_with(kGoals)) {
        HandDevice hand;
        hand.device = std::make_unique<GoalStream>(name, read_goals(name.substr(kGoals.size())));
        return hand;
    }
    throw DeviceError("no device is called " + name +
                      "; use auto, mouse, falcon, falcon:SERIAL or goals:FILE");
}

FirmwareAtHand firmware_at_hand(const std::filesystem::path& given) {
    if (!given.empty()) return {falcon::keep_firmware(given), {}};
    try {
        return {falcon::kept_firmware(), {}};
    } catch (const InputError& error) {
        return {{}, error.what()};
    }
}

}  // namespace dibhr
