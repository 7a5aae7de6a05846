// The table of a Touch's settings, and the tuning and limits that follow from it.
#include "device/openhaptics/settings.hpp"

#include "device/openhaptics/openhaptics_device.hpp"

namespace dibhr::openhaptics {

namespace {

constexpr const char* kWorkspace = "Touch workspace";
constexpr const char* kButtons = "Touch buttons";
constexpr const char* kConnection = "Touch connection";

}  // namespace

std::vector<DeviceRow> OpenhapticsSettings::rows() {
    constexpr double kLongestPath = 127.0;
    std::vector<DeviceRow> rows{
        {"name", kConnection, "Name: the default one",
         "Which device: the name given in 3D Systems' setup program", &name, 0.0, 63.0},
        {"library", kConnection, "Library: where it is installed",
         "The file libHD.so.3.4 of OpenHaptics, or its folder; or a record that was made with "
         "dibhr devices --record",
         &library, 0.0, kLongestPath},
        scale_row(kWorkspace, workspace.scale),
        {"radius", kWorkspace, "Radius",
         "Radius of the volume that the hand reaches; the image is fitted to it. CHAI3D: 75 mm for "
         "the Touch",
         &workspace.radius_mm, 20.0, 200.0, "%.0f mm"},
    };
    add_offset_rows(
        rows, kWorkspace,
        "Where in the image the middle of the hand's workspace is, from the image's middle",
        "How far above the middle of the relief the middle of the workspace is");
    add_buttons(rows, kDeviceButtons, kButtons);
    return rows;
}

std::vector<DeviceTopic> OpenhapticsSettings::topics() const {
    return {{.name = kWorkspace, .fit_help = "The scale at which the hand reaches the whole image"},
            {.name = kButtons},
            {.name = kConnection, .connection = true}};
}

DeviceLimits OpenhapticsSettings::limits() const {
    return at_scale(specification_of().limits, workspace.scale);
}

ConnectionOptions connection_of(const OpenhapticsSettings& settings) {
    return {.name = settings.name, .library = settings.library};
}

Tuning tuning_of(const OpenhapticsSettings& settings, const HandTuning& hand) noexcept {
    return with_hand_tuning(Tuning{}, settings, hand);
}

}  // namespace dibhr::openhaptics
