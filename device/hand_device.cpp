// Makes the device named on the command line.
#include "device/hand_device.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "device/device_or_mouse.hpp"
#include "device/falcon/survey.hpp"
#include "device/goal_stream.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr {

namespace {

HandDevice mouse_hand() {
    HandDevice hand;
    auto mouse = std::make_unique<MouseHand>();
    hand.mouse = mouse.get();
    hand.device = std::move(mouse);
    return hand;
}

/// Those that `looks_for` names, and the mouse.
struct LooksFor {
    bool falcon{true};
    bool inverse3{true};
};
HandDevice device_hand(const DeviceChoice& choice, LooksFor looks_for) {
    HandDevice hand;
    std::unique_ptr<falcon::FalconDevice> falcon;
    std::unique_ptr<inverse3::Inverse3Device> inverse3;
    if (looks_for.falcon) {
        FirmwareAtHand firmware = firmware_at_hand(choice.falcon.firmware);
        hand.firmware = firmware.image.name;
        hand.firmware_trouble = std::move(firmware.trouble);
        falcon = std::make_unique<falcon::FalconDevice>(choice.falcon.connection,
                                                        std::move(firmware.image));
    }
    if (looks_for.inverse3) inverse3 = std::make_unique<inverse3::Inverse3Device>(choice.inverse3);
    auto all = std::make_unique<DeviceOrMouse>(std::move(falcon), std::move(inverse3));
    hand.mouse = &all->mouse();
    hand.falcon = all->falcon();
    hand.inverse3 = all->inverse3();
    hand.device = std::move(all);
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
HandDevice required_falcon_hand(const DeviceChoice& choice) {
    const std::string refusal =
        falcon::why_it_cannot_be_opened(attached_falcon(choice.falcon.connection.serial));
    if (!refusal.empty()) throw DeviceError(refusal);
    return device_hand(choice, {.inverse3 = false});
}

/// Throws DeviceError when the service does not have it. What it needs after that, power or
/// calibration, is told in the window.
HandDevice required_inverse3_hand(const DeviceChoice& choice) {
    const std::string refusal =
        inverse3::why_none(inverse3::survey_service(choice.inverse3), choice.inverse3.device);
    if (!refusal.empty()) throw DeviceError(refusal);
    return device_hand(choice, {.falcon = false});
}

constexpr std::string_view kGoals = "goals:";
constexpr std::string_view kFalcon = "falcon:";
constexpr std::string_view kInverse3 = "inverse3:";

/// What follows `kind` in the name; empty: nothing does.
std::string after(std::string_view kind, std::string_view name) {
    return name.starts_with(kind) ? std::string(name.substr(kind.size())) : std::string{};
}

}  // namespace

bool names_device(const std::string& name) {
    constexpr std::array<std::string_view, 4> kPlain{"auto", "mouse", "falcon", "inverse3"};
    return std::find(kPlain.begin(), kPlain.end(), name) != kPlain.end() ||
           !after(kGoals, name).empty() || !after(kFalcon, name).empty() ||
           !after(kInverse3, name).empty();
}

bool moves_hand(const std::string& name) {
    return name != "mouse" && after(kGoals, name).empty();
}

HandDevice make_hand_device(const std::string& name, const DeviceChoice& choice) {
    if (!names_device(name)) {
        throw DeviceError("no device is called " + name + "; use " + kDeviceNames);
    }
    DeviceChoice chosen = choice;
    if (name == "mouse") return mouse_hand();
    if (name == "auto") return device_hand(choice, {});
    if (std::string file = after(kGoals, name); !file.empty()) {
        HandDevice hand;
        hand.device = std::make_unique<GoalStream>(name, read_goals(file));
        return hand;
    }
    if (std::string serial = after(kFalcon, name); !serial.empty()) {
        chosen.falcon.connection.serial = std::move(serial);
    }
    if (std::string id = after(kInverse3, name); !id.empty())
        chosen.inverse3.device = std::move(id);
    return name.starts_with("falcon") ? required_falcon_hand(chosen)
                                      : required_inverse3_hand(chosen);
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
