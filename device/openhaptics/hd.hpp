// The part of OpenHaptics' HD API that dibhr calls, as declarations of our own: README.md, The
// library, has the sources. Types are those of 64-bit Linux.
#pragma once

#include <cstdint>
#include <functional>

namespace dibhr::openhaptics {

using HdHandle = unsigned int;
using HdEnum = unsigned int;
using HdSchedule = unsigned long;
using HdCallback = unsigned int (*)(void*);

/// Returned by value, in two registers.
struct HdErrorInfo {
    unsigned int code;
    int internal_code;
    HdHandle device;
};
static_assert(sizeof(HdErrorInfo) == 12);

inline constexpr HdHandle kHdInvalidHandle = 0xFFFFFFFF;

/// What a callback returns.
inline constexpr unsigned int kHdCallbackDone = 0;
inline constexpr unsigned int kHdCallbackContinue = 1;

inline constexpr unsigned short kHdMaxPriority = 65535;

/// Parameters that are read or set in a frame, or once a device is open.
enum : HdEnum {
    kHdButtons = 0x2000,           // int; bit 0: the front button
    kHdInkwellSwitch = 0x2002,     // boolean
    kHdEncoders = 0x2010,          // 6 long; the first 3: of the arm
    kHdPosition = 0x2050,          // 3 double [mm]; x right, y up, z to the user
    kHdVelocity = 0x2051,          // 3 double [mm/s], smoothed by the library
    kHdGimbalAngles = 0x2150,      // 3 double [rad]
    kHdVersion = 0x2500,           // string
    kHdModel = 0x2501,             // string
    kHdDriverVersion = 0x2502,     // string
    kHdSerial = 0x2504,            // string
    kHdUsableWorkspace = 0x2551,   // 6 double [mm]: least x y z, greatest x y z
    kHdCalibrationStyle = 0x2555,  // int, bits of kHdEncoderReset, kHdAuto, kHdInkwell
    kHdMaxStiffness = 0x2602,      // double [N/mm]
    kHdMaxForce = 0x2603,          // double [N], of cold motors
    kHdContinuousForce = 0x2604,   // double [N]
    kHdMotorTemperature = 0x2605,  // 3 or 6 double; 0 cold .. 1 hot
    kHdForce = 0x2700,             // 3 double [N]
};

/// A capability.
inline constexpr HdEnum kHdForceOutput = 0x4000;

/// Results of hdCheckCalibration.
inline constexpr HdEnum kHdCalibrated = 0x5000;
inline constexpr HdEnum kHdNeedsUpdate = 0x5001;
inline constexpr HdEnum kHdNeedsPerson = 0x5002;

/// Calibration styles.
inline constexpr HdEnum kHdEncoderReset = 1;
inline constexpr HdEnum kHdAuto = 2;
inline constexpr HdEnum kHdInkwell = 4;

/// Errors that dibhr treats by themselves; HdFault has the classes of all.
inline constexpr unsigned int kHdSuccess = 0;
inline constexpr unsigned int kHdUnknownParameter = 0x100;
inline constexpr unsigned int kHdWarmMotors = 0x200;
inline constexpr unsigned int kHdInUse = 0x301;
inline constexpr unsigned int kHdInvalidLicense = 0x600;

/// The functions of a library: a loaded one, one that is recorded, or a record that is played.
struct HdLibrary {
    std::function<HdHandle(const char*)> init_device{};
    std::function<void(HdHandle)> disable_device{};
    std::function<void(HdHandle)> make_current{};
    std::function<void(HdHandle)> begin_frame{};
    std::function<void(HdHandle)> end_frame{};
    std::function<HdErrorInfo()> get_error{};
    std::function<void(HdEnum)> enable{};
    std::function<void(HdEnum)> disable{};
    std::function<void(HdEnum, std::uint8_t*)> get_booleans{};
    std::function<void(HdEnum, int*)> get_integers{};
    std::function<void(HdEnum, double*)> get_doubles{};
    std::function<void(HdEnum, long*)> get_longs{};
    std::function<void(HdEnum, const double*)> set_doubles{};
    std::function<const char*(HdEnum)> get_string{};
    std::function<HdEnum()> check_calibration{};
    std::function<void(HdEnum)> update_calibration{};
    std::function<void()> start_scheduler{};
    std::function<void()> stop_scheduler{};
    std::function<HdSchedule(HdCallback, void*, unsigned short)> schedule{};
    std::function<void(HdSchedule)> unschedule{};
};

}  // namespace dibhr::openhaptics
