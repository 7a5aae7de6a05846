// The table of a Falcon's settings, and the tuning and limits that follow from it.
#include "device/falcon/settings.hpp"

#include "device/falcon/falcon_device.hpp"

namespace dibhr::falcon {

namespace {

constexpr const char* kWorkspace = "Workspace";
constexpr const char* kButtons = "Buttons";
constexpr const char* kCalibration = "Calibration";
constexpr const char* kConnection = "Connection";

}  // namespace

// The constants of the mechanism are libnifalcon's, see README.md; the help texts give Martin &
// Hillier's where they differ. The ranges allow only mechanisms that can be built. The constants
// convert force to torques and counts to millimetres: they change what a newton and a stiffness
// really are.
std::vector<DeviceRow> FalconSettings::rows() {
    constexpr double kMillimetres = 1000.0;  // in a metre
    constexpr const char* kAside =
        "Where the centre of the workspace lies, from the middle of the image";
    Vec3& offset_mm = workspace.offset_mm;
    std::vector<DeviceRow> rows{
        {"serial", kConnection, "Serial: the first one found",
         "Which Falcon, when several are attached", &connection.serial, 0.0, 63.0},
        {"event-character", kConnection, "Event character",
         "The USB chip passes a reply on at its last byte instead of a millisecond later; not "
         "tried on a real Falcon yet",
         &connection.event_character},
        {"slower-upload", kConnection, "Slower firmware loading",
         "140 351 baud instead of 142 857; both are reported to work", &connection.slower_upload},
        scale_row(kWorkspace, workspace.scale),
        offset_row("offset-x", "Offset right", kWorkspace, offset_mm.x, kAside),
        offset_row("offset-y", "Offset up", kWorkspace, offset_mm.y, kAside),
        offset_row("offset-z", "Offset out", kWorkspace, offset_mm.z,
                   "How far the centre of the workspace lies above the middle of the relief"),
        {"centre-z", kWorkspace, "Centre",
         "Centre of the usable volume, measured out of the base. Demos use 110 to 125 mm; the grip "
         "is fully in at about 75 and fully out at 170 mm",
         &workspace.centre_z_mm, 90.0, 150.0, "%.0f mm", 1.0,
         Protection{WeakerWhen::other, "Falcon's boundary, centre [mm]"}},
        {"radius", kWorkspace, "Radius",
         "Radius of the usable volume; beyond it a soft boundary pushes back. CHAI3D: 40 mm for "
         "full quality",
         &workspace.radius_mm, 10.0, 55.0, "%.0f mm", 1.0,
         Protection{WeakerWhen::higher, "Falcon's boundary, radius [mm]"}},
        {"boundary-stiffness", kWorkspace, "Boundary",
         "How hard the boundary of the usable volume is; 0: none",
         &workspace.boundary_newton_per_mm, 0.0, 0.5, "%.2f N/mm", 1.0,
         Protection{WeakerWhen::lower, "Falcon's boundary [N/mm]"}},
        // No source is above 10000, so a higher scale is a mistake.
        {"counts-per-newton-metre", kCalibration, "Torque scale",
         "Motor counts per newton metre at the thigh. Nobody has measured it: 10000 is "
         "libnifalcon's, 6616 Martin & Hillier's, about 3600 fits Novint's driver. Weigh the force "
         "with a scale and set it here",
         &motors.counts_per_newton_metre, 1000.0, 10000.0, "%.0f / N m", 1.0,
         Protection{WeakerWhen::higher, "Falcon's torque scale"}},
        {"full-scale-counts", kCalibration, "Full scale",
         "Greatest count that is sent to a motor; Novint's driver stops at 4095",
         &motors.full_scale_counts, 0.0, 4095.0, "%.0f"},
        {"gear", kCalibration, "Gear",
         "Turns of the motor per turn of the thigh. libnifalcon: 110 / 14.25; Martin & Hillier: "
         "7.62",
         &geometry.gear, 4.0, 12.0, "%.3f", 1.0, Protection{WeakerWhen::other, "Falcon's gear"}},
        {"angle-at-zero", kCalibration, "Angle at 0",
         "Angle of the thigh at encoder count 0. libnifalcon: 35; Martin & Hillier: 50, where a "
         "user measured 40",
         &geometry.angle_at_zero_deg, 0.0, 70.0, "%.1f deg", 1.0,
         Protection{WeakerWhen::other, "Falcon's angle at 0 [deg]"}},
        {"thigh", kCalibration, "Thigh (a)", "Length of the thigh; both sources 60 mm",
         &geometry.thigh_m, 0.04, 0.09, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's thigh [m]"}},
        {"shin", kCalibration, "Shin (b)",
         "Length of the shin's parallelogram; both sources 102.5 mm", &geometry.shin_m, 0.07, 0.15,
         "%.2f mm", kMillimetres, Protection{WeakerWhen::other, "Falcon's shin [m]"}},
        {"shin-end-d", kCalibration, "Shin end (d)",
         "Joint at one end of the shin. libnifalcon: 11.25; Martin & Hillier: 11.5",
         &geometry.shin_end_d_m, 0.0, 0.03, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's shin end d [m]"}},
        {"shin-end-e", kCalibration, "Shin end (e)",
         "Joint at the other end. libnifalcon: 11.25; Martin & Hillier: 11.5",
         &geometry.shin_end_e_m, 0.0, 0.03, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's shin end e [m]"}},
        {"platform-radius", kCalibration, "Platform (c)",
         "Radius of the joints on the grip's platform. libnifalcon: 14.43; Martin & Hillier: 15.7",
         &geometry.platform_radius_m, 0.0, 0.03, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's platform c [m]"}},
        {"base-radius", kCalibration, "Base (r)",
         "Radius of the joints on the base. libnifalcon: 40.0; Martin & Hillier: 36.6",
         &geometry.base_radius_m, 0.02, 0.06, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's base r [m]"}},
        {"platform-shift", kCalibration, "Platform (f)",
         "Tangential; only f - s counts. libnifalcon: -25.0; Martin & Hillier: 26.2",
         &geometry.platform_shift_m, -0.04, 0.04, "%.2f mm", kMillimetres,
         Protection{WeakerWhen::other, "Falcon's platform f [m]"}},
        {"base-shift", kCalibration, "Base (s)",
         "Tangential. libnifalcon: -23.09; Martin & Hillier: 27.2", &geometry.base_shift_m, -0.04,
         0.04, "%.2f mm", kMillimetres, Protection{WeakerWhen::other, "Falcon's base s [m]"}},
    };
    add_buttons(rows, kDeviceButtons, kButtons);
    return rows;
}

std::vector<DeviceTopic> FalconSettings::topics() const {
    return {
        {.name = kWorkspace, .fit_help = "The scale at which the hand reaches the whole image"},
        {.name = kButtons},
        {.name = kCalibration,
         .remark = "Sources differ on these; the defaults are libnifalcon's. Each change lets the "
                   "force rise again from zero."},
        {.name = kConnection, .connection = true}};
}

DeviceLimits FalconSettings::limits() const {
    return at_scale(specification_of(connection).limits, workspace.scale);
}

Tuning tuning_of(const FalconSettings& settings, const HandTuning& hand) noexcept {
    return with_hand_tuning(Tuning{.geometry = settings.geometry, .motors = settings.motors},
                            settings, hand);
}

}  // namespace dibhr::falcon
