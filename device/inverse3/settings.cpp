// The table of an Inverse3's settings, and the tuning and limits that follow from it.
#include "device/inverse3/settings.hpp"

#include <string_view>

#include "device/inverse3/inverse3_device.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr const char* kWorkspace = "Inverse3 workspace";
constexpr const char* kButtons = "Inverse3 buttons";
constexpr const char* kService = "Inverse3 service";

}  // namespace

// README.md, Protocol, has the source of the default centre.
std::vector<DeviceRow> Inverse3Settings::rows() {
    constexpr double kLowestPort = 1.0;
    constexpr double kHighestPort = 65535.0;
    std::vector<DeviceRow> rows{
        {"device", kService, "Name: the first one found",
         "Which Inverse3, when several are attached: its name, left or right", &device, 0.0, 63.0},
        {"port", "", "Port", "Of the service's WebSocket", &port, kLowestPort, kHighestPort},
        {"older-port", "", "Older port", "Where older services have HTTP", &older_port, kLowestPort,
         kHighestPort},
        {"dialect", kService, "Format of forces",
         "Sources differ on the format of a force. dibhr tries that of the service's version "
         "first, and the other one if the service confirms no force",
         DeviceEnum(dialect)},
        {"preset", kService, "Preset: defaults",
         "Mount, axes and origin: defaults, arm_front, led_front, arm_front_centered, "
         "led_front_centered; the centre above depends on the preset",
         &preset, 0.0, 31.0},
        scale_row(kWorkspace, workspace.scale),
        box_row(kWorkspace, box_mm),
        {"tilt", kWorkspace, "Tilt",
         "How far the image leans back under your hand: 0 upright before you, 90 flat on the table",
         &tuning.tilt_deg, 0.0, 90.0, "%.0f deg"},
        {"centre-x", kWorkspace, "Centre right",
         "Centre of the comfortable box, from the device's origin", &tuning.centre_mm.x, -250.0,
         250.0, "%.0f mm"},
        {"centre-y", kWorkspace, "Centre forward",
         "Centre of the comfortable box, from the device's origin; 0 for the presets that have "
         "their origin in the middle",
         &tuning.centre_mm.y, -300.0, 200.0, "%.0f mm"},
        {"centre-z", kWorkspace, "Centre up",
         "Centre of the comfortable box, from the device's origin; 0 for the presets that have "
         "their origin in the middle",
         &tuning.centre_mm.z, -250.0, 400.0, "%.0f mm"},
    };
    add_offset_rows(rows, kWorkspace,
                    "Where in the image the box's centre is, from the image's middle",
                    "How far above the middle of the relief the box's centre is");
    add_buttons(rows, kDeviceButtons, kButtons);
    return rows;
}

std::vector<DeviceTopic> Inverse3Settings::topics() const {
    return {{.name = kWorkspace,
             .fit_help = "The scale at which the comfortable box reaches the whole image"},
            {.name = kButtons},
            {.name = kService, .connection = true}};
}

DeviceLimits Inverse3Settings::limits() const {
    return at_scale(specification_of().limits, workspace.scale);
}

ConnectionOptions connection_of(const Inverse3Settings& settings) {
    ConnectionOptions connection;
    connection.device = settings.device;
    connection.port = static_cast<std::uint16_t>(settings.port);
    connection.older_port = static_cast<std::uint16_t>(settings.older_port);
    if (settings.dialect == Dialect::vector) connection.dialect = ForceDialect::vector;
    if (settings.dialect == Dialect::values) connection.dialect = ForceDialect::values;
    if (!settings.preset.empty()) connection.preset = std::string_view(settings.preset);
    return connection;
}

Tuning tuning_of(const Inverse3Settings& settings, const HandTuning& hand) noexcept {
    return with_hand_tuning(settings.tuning, settings, hand);
}

}  // namespace dibhr::inverse3
