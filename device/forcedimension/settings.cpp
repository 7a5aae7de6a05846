// The table of a Force Dimension arm's settings, and the tuning and limits that follow from it.
#include "device/forcedimension/settings.hpp"

#include "device/forcedimension/forcedimension_device.hpp"

namespace dibhr::forcedimension {

namespace {

constexpr const char* kWorkspace = "Force Dimension workspace";
constexpr const char* kButtons = "Force Dimension buttons";
constexpr const char* kConnection = "Force Dimension library";

}  // namespace

std::vector<DeviceRow> ForceDimensionSettings::rows() {
    constexpr const char* kCentre =
        "Centre of the workspace, from the arm's origin, in the directions of your hand";
    Vec3& centre_mm = tuning.centre_mm;
    std::vector<DeviceRow> rows{
        {"device", kConnection, "Serial: the first one found",
         "Which arm, when several are attached: its serial number, as dibhr devices prints it",
         &device, 0.0, 63.0},
        {"library", kConnection, "Library: where it is installed",
         "The maker's library libdrd.so.3, or the folder of its SDK; or a record that was made "
         "with "
         "dibhr devices --record, which is then played as a device",
         &library, 0.0, 127.0},
        scale_row(kWorkspace, workspace.scale),
        box_row(kWorkspace, box_mm),
        {"centre-x", kWorkspace, "Centre right", kCentre, &centre_mm.x, -150.0, 150.0, "%.0f mm"},
        {"centre-y", kWorkspace, "Centre up", kCentre, &centre_mm.y, -150.0, 150.0, "%.0f mm"},
        {"centre-z", kWorkspace, "Centre out", kCentre, &centre_mm.z, -150.0, 150.0, "%.0f mm"},
    };
    add_offset_rows(rows, kWorkspace,
                    "Where in the image the workspace's centre is, from the image's middle",
                    "How far above the middle of the relief the workspace's centre is");
    add_buttons(rows, kDeviceButtons, kButtons);
    return rows;
}

std::vector<DeviceTopic> ForceDimensionSettings::topics() const {
    return {{.name = kWorkspace,
             .fit_help = "The scale at which the comfortable box reaches the whole image"},
            {.name = kButtons},
            {.name = kConnection,
             .remark = "The library is its maker's. You accept its licence; do not pass it on.",
             .connection = true}};
}

DeviceLimits ForceDimensionSettings::limits() const {
    return at_scale(specification_of().limits, workspace.scale);
}

ConnectionOptions connection_of(const ForceDimensionSettings& settings) {
    ConnectionOptions connection;
    connection.serial = settings.device;
    connection.library = settings.library;
    return connection;
}

Tuning tuning_of(const ForceDimensionSettings& settings, const HandTuning& hand) noexcept {
    return with_hand_tuning(settings.tuning, settings, hand);
}

}  // namespace dibhr::forcedimension
