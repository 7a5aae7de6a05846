// The table of the Falcon's numbers.
#include "app/settings/falcon_settings.hpp"

#include <array>

namespace dibhr {

namespace {

using Settings = FalconSettings;

constexpr double kMillimetres = 1000.0;  // in a metre

// The constants of the mechanism: libnifalcon's set, see device/falcon/README.md; the helps give
// Martin & Hillier's where it differs. The ranges keep a mechanism that can be built.
constexpr std::array kNumbers{
    FalconNumber{FalconTopic::workspace, "scale", "Scale", "x %.2f", 1.0, 0.1, 10.0,
                 "Image millimetres a hand millimetre. A larger image is softer under the hand: "
                 "more than 1 N a hand millimetre is never felt",
                 [](Settings& s) -> double& { return s.workspace.scale; }},
    FalconNumber{FalconTopic::workspace, "offset-x", "Offset right", "%.1f mm", 1.0, -200.0, 200.0,
                 "Where in the image the hand's centre is, from the image's middle",
                 [](Settings& s) -> double& { return s.workspace.offset_mm.x; }},
    FalconNumber{FalconTopic::workspace, "offset-y", "Offset up", "%.1f mm", 1.0, -200.0, 200.0,
                 "Where in the image the hand's centre is, from the image's middle",
                 [](Settings& s) -> double& { return s.workspace.offset_mm.y; }},
    FalconNumber{FalconTopic::workspace, "offset-z", "Offset out", "%.1f mm", 1.0, -200.0, 200.0,
                 "How far above the middle of the relief the hand's centre is",
                 [](Settings& s) -> double& { return s.workspace.offset_mm.z; }},
    FalconNumber{
        FalconTopic::workspace, "centre-z", "Centre", "%.0f mm", 1.0, 90.0, 150.0,
        "Of the usable volume, out of the base. Demos use 110 to 125 mm; the grip is fully "
        "in at about 75 and fully out at 170 mm",
        [](Settings& s) -> double& { return s.workspace.centre_z_mm; }},
    FalconNumber{FalconTopic::workspace, "radius", "Radius", "%.0f mm", 1.0, 10.0, 55.0,
                 "Of the usable volume; beyond it a soft boundary pushes back. CHAI3D: 40 mm for "
                 "full quality",
                 [](Settings& s) -> double& { return s.workspace.radius_mm; }},
    FalconNumber{FalconTopic::workspace, "boundary-stiffness", "Boundary", "%.2f N/mm", 1.0, 0.0,
                 0.5, "How hard the boundary of the usable volume is; 0: none",
                 [](Settings& s) -> double& { return s.workspace.boundary_newton_per_mm; }},
    // No source is above 10000, so a higher scale is a mistake in the making.
    FalconNumber{FalconTopic::motors, "counts-per-newton-metre", "Torque scale", "%.0f / N m", 1.0,
                 1000.0, 10000.0,
                 "Motor counts a newton metre at the thigh. Nobody has measured it: 10000 is "
                 "libnifalcon's, 6616 Martin & Hillier's, about 3600 fits Novint's driver. Weigh "
                 "the force with a scale and set it here",
                 [](Settings& s) -> double& { return s.motors.counts_per_newton_metre; }},
    FalconNumber{FalconTopic::motors, "full-scale-counts", "Full scale", "%.0f", 1.0, 0.0, 4095.0,
                 "Most counts that a motor is sent; Novint's driver ends at 4095",
                 [](Settings& s) -> double& { return s.motors.full_scale_counts; }},
    FalconNumber{FalconTopic::geometry, "gear", "Gear", "%.3f", 1.0, 4.0, 12.0,
                 "Motor turns a turn of the thigh. libnifalcon: 110 / 14.25; Martin & Hillier: "
                 "7.62",
                 [](Settings& s) -> double& { return s.geometry.gear; }},
    FalconNumber{
        FalconTopic::geometry, "angle-at-zero", "Angle at 0", "%.1f deg", 1.0, 0.0, 70.0,
        "Of the thigh, at encoder count 0. libnifalcon: 35; Martin & Hillier: 50, of which "
        "a user measured 40",
        [](Settings& s) -> double& { return s.geometry.angle_at_zero_deg; }},
    FalconNumber{FalconTopic::geometry, "thigh", "Thigh (a)", "%.2f mm", kMillimetres, 0.04, 0.09,
                 "Length of the thigh; both sources 60 mm",
                 [](Settings& s) -> double& { return s.geometry.thigh_m; }},
    FalconNumber{FalconTopic::geometry, "shin", "Shin (b)", "%.2f mm", kMillimetres, 0.07, 0.15,
                 "Length of the shin's parallelogram; both sources 102.5 mm",
                 [](Settings& s) -> double& { return s.geometry.shin_m; }},
    FalconNumber{FalconTopic::geometry, "shin-end-d", "Shin end (d)", "%.2f mm", kMillimetres, 0.0,
                 0.03, "Joint at one end of the shin. libnifalcon: 11.25; Martin & Hillier: 11.5",
                 [](Settings& s) -> double& { return s.geometry.shin_end_d_m; }},
    FalconNumber{FalconTopic::geometry, "shin-end-e", "Shin end (e)", "%.2f mm", kMillimetres, 0.0,
                 0.03, "Joint at the other end. libnifalcon: 11.25; Martin & Hillier: 11.5",
                 [](Settings& s) -> double& { return s.geometry.shin_end_e_m; }},
    FalconNumber{FalconTopic::geometry, "platform-radius", "Platform (c)", "%.2f mm", kMillimetres,
                 0.0, 0.03,
                 "Of the joints on the grip's platform. libnifalcon: 14.43; Martin & Hillier: 15.7",
                 [](Settings& s) -> double& { return s.geometry.platform_radius_m; }},
    FalconNumber{FalconTopic::geometry, "base-radius", "Base (r)", "%.2f mm", kMillimetres, 0.02,
                 0.06, "Of the joints on the base. libnifalcon: 40.0; Martin & Hillier: 36.6",
                 [](Settings& s) -> double& { return s.geometry.base_radius_m; }},
    FalconNumber{FalconTopic::geometry, "platform-shift", "Platform (f)", "%.2f mm", kMillimetres,
                 -0.04, 0.04,
                 "Tangential; only f - s counts. libnifalcon: -25.0; Martin & Hillier: 26.2",
                 [](Settings& s) -> double& { return s.geometry.platform_shift_m; }},
    FalconNumber{FalconTopic::geometry, "base-shift", "Base (s)", "%.2f mm", kMillimetres, -0.04,
                 0.04, "Tangential. libnifalcon: -23.09; Martin & Hillier: 27.2",
                 [](Settings& s) -> double& { return s.geometry.base_shift_m; }},
};

}  // namespace

std::span<const FalconNumber> falcon_numbers() noexcept {
    return kNumbers;
}

falcon::Tuning tuning_of(const FalconSettings& settings, std::uint32_t centred) noexcept {
    falcon::Tuning tuning;
    tuning.geometry = settings.geometry;
    tuning.motors = settings.motors;
    tuning.workspace = settings.workspace;
    tuning.clutch_buttons = buttons_for(ButtonAction::clutch, settings.buttons);
    tuning.force_off_buttons = buttons_for(ButtonAction::force_off, settings.buttons);
    tuning.centred = centred;
    return tuning;
}

}  // namespace dibhr
