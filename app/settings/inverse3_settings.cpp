// The table of the Inverse3's numbers, and what the device makes of the settings.
#include "app/settings/inverse3_settings.hpp"

#include "device/inverse3/frame.hpp"

namespace dibhr {

namespace {

using Settings = Inverse3Settings;
constexpr auto kWorkspace = Inverse3Topic::workspace;

// device/inverse3/README.md, Conversation, has where the centre comes from.
constexpr std::array kNumbers{
    Inverse3Number{kWorkspace, "scale", "Scale", "x %.2f", 1.0, 0.1, 10.0,
                   "Image millimetres a hand millimetre. A larger image is softer under the hand: "
                   "more than 1 N a hand millimetre is never felt",
                   [](Settings& s) -> double& { return s.tuning.workspace.scale; }},
    Inverse3Number{kWorkspace, "box", "Comfortable box", "%.0f mm", 1.0, inverse3::kSmallestBox_mm,
                   inverse3::kLargestBox_mm,
                   "Edge of the box that your hand moves in without effort; the image is fitted to "
                   "it",
                   [](Settings& s) -> double& { return s.box_mm; }},
    Inverse3Number{kWorkspace, "tilt", "Tilt", "%.0f deg", 1.0, 0.0, 90.0,
                   "How far the image leans back under your hand: 0 upright before you, 90 flat on "
                   "the table",
                   [](Settings& s) -> double& { return s.tuning.tilt_deg; }},
    Inverse3Number{kWorkspace, "centre-x", "Centre right", "%.0f mm", 1.0, -250.0, 250.0,
                   "Of the comfortable box, from the device's origin",
                   [](Settings& s) -> double& { return s.tuning.centre_mm.x; }},
    Inverse3Number{kWorkspace, "centre-y", "Centre forward", "%.0f mm", 1.0, -300.0, 200.0,
                   "Of the comfortable box, from the device's origin; 0 for the presets that have "
                   "their origin in the middle",
                   [](Settings& s) -> double& { return s.tuning.centre_mm.y; }},
    Inverse3Number{kWorkspace, "centre-z", "Centre up", "%.0f mm", 1.0, -250.0, 400.0,
                   "Of the comfortable box, from the device's origin; 0 for the presets that have "
                   "their origin in the middle",
                   [](Settings& s) -> double& { return s.tuning.centre_mm.z; }},
    Inverse3Number{kWorkspace, "offset-x", "Offset right", "%.1f mm", 1.0, -200.0, 200.0,
                   "Where in the image the box's centre is, from the image's middle",
                   [](Settings& s) -> double& { return s.tuning.workspace.offset_mm.x; }},
    Inverse3Number{kWorkspace, "offset-y", "Offset up", "%.1f mm", 1.0, -200.0, 200.0,
                   "Where in the image the box's centre is, from the image's middle",
                   [](Settings& s) -> double& { return s.tuning.workspace.offset_mm.y; }},
    Inverse3Number{kWorkspace, "offset-z", "Offset out", "%.1f mm", 1.0, -200.0, 200.0,
                   "How far above the middle of the relief the box's centre is",
                   [](Settings& s) -> double& { return s.tuning.workspace.offset_mm.z; }},
};

}  // namespace

std::span<const Inverse3Number> inverse3_numbers() noexcept {
    return kNumbers;
}

inverse3::ConnectionOptions connection_of(const Inverse3Settings& settings) {
    inverse3::ConnectionOptions connection;
    connection.device = settings.device;
    connection.port = static_cast<std::uint16_t>(settings.port);
    connection.older_port = static_cast<std::uint16_t>(settings.older_port);
    if (settings.dialect == Dialect::vector) connection.dialect = inverse3::ForceDialect::vector;
    if (settings.dialect == Dialect::values) connection.dialect = inverse3::ForceDialect::values;
    if (!settings.preset.empty()) connection.preset = std::string_view(settings.preset);
    return connection;
}

inverse3::Tuning tuning_of(const Inverse3Settings& settings, double max_force_newton,
                           std::uint32_t centred) noexcept {
    inverse3::Tuning tuning = settings.tuning;
    tuning.max_force_newton = max_force_newton;
    tuning.clutch_buttons = buttons_for(ButtonAction::clutch, settings.buttons);
    tuning.force_off_buttons = buttons_for(ButtonAction::force_off, settings.buttons);
    tuning.centred = centred;
    return tuning;
}

}  // namespace dibhr
