// What the thread of the driver does.
#include "device/openhaptics/driver_thread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <span>
#include <thread>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/openhaptics/dynamics.hpp"

namespace dibhr::openhaptics {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// README.md, Numbers.
constexpr milliseconds kLookAgainAfter{3000};
constexpr milliseconds kLook{4};  // between two looks at the servo thread
constexpr milliseconds kLongestSilence{20};
constexpr milliseconds kGivenUpAfter{1000};  // of silence
constexpr milliseconds kLongestEnd{100};     // of the callback
constexpr milliseconds kCalibrateEvery{250};
constexpr milliseconds kRatePeriod{500};
constexpr milliseconds kAskPersonEvery{20};
constexpr double kMostForce_newton = 8.5;  // of any device

/// README.md, Where sources disagree.
constexpr std::array<const char*, 3> kDefaultNames{nullptr, "Default Device", "Default PHANToM"};

/// Another name would be refused, too.
bool is_refused(const Fault& fault) noexcept {
    return fault.code == kHdInUse || fault.code == kHdInvalidLicense;
}

double within(double value, double lowest, double highest, double usual) noexcept {
    return std::isfinite(value) && value >= lowest && value <= highest ? value : usual;
}

}  // namespace

DriverThread::DriverThread(const ConnectionOptions& options, std::shared_ptr<ArmBuffers> buffers)
    : options_(options), buffers_(std::move(buffers)) {
    board_.enter(Stage::opening, "looking for a Touch");
}

/// Without an installed library there is nothing to search for: the thread ends.
void DriverThread::run() {
    library_ = load_hd_library(options_.library);
    board_.draft().library = library_.file;
    if (!library_.loaded) {
        const bool broken = !library_.trouble.empty();
        board_.enter_new(
            broken ? Stage::broken_library : Stage::no_library,
            broken ? library_.trouble : sentence_for(Stage::no_library, board_.draft()),
            broken || is_on_usb(options_.usb_devices));
    } else {
        if (options_.around) library_.functions = options_.around(library_.functions);
        (void)become_realtime("dibhr touch");
        while (!end.requested()) {
            search();
            end.pause(kLookAgainAfter);
        }
    }
}

void DriverThread::search() {
    try {
        Fault fault;
        // Two servos would use the same buffers.
        if (!servos_.empty() && servos_.back()->runs())
            return board_.enter_new(Stage::looking, sentence_for(Stage::silent, board_.draft()),
                                    true);
        const HdHandle handle = open(fault);
        if (handle != kHdInvalidHandle) {
            trouble_.clear();
            follow(handle);
            return;
        }
        if (is_refused(fault))
            return board_.enter_new(Stage::cannot_open, why_not_opened(fault, options_.name), true);
        // A device that was lost is named as long as it does not come back.
        const bool lost = !trouble_.empty();
        board_.enter_new(Stage::looking, lost ? trouble_ : why_not_opened(fault, options_.name),
                         lost || !options_.name.empty());
    } catch (const std::exception& failure) {
        board_.enter_new(Stage::looking,
                         std::string("the Touch's thread failed (") + failure.what() +
                             ") and begins again: close other programs if this happens again",
                         true);
    }
}

/// Tries the names of a default device, of which some versions of the driver know only one.
HdHandle DriverThread::open(Fault& fault) {
    const std::array<const char*, 1> given{options_.name.c_str()};
    const auto names = options_.name.empty() ? std::span<const char* const>(kDefaultNames)
                                             : std::span<const char* const>(given);
    for (const char* const name : names) {
        const HdHandle handle = init_device(name);
        fault = take_faults(library_.functions);
        if (handle != kHdInvalidHandle && fault.kind != FaultClass::link) return handle;
        if (handle != kHdInvalidHandle) library_.functions.disable_device(handle);
        if (is_refused(fault)) break;
    }
    (void)take_faults(library_.functions);
    return kHdInvalidHandle;
}

HdHandle DriverThread::init_device(const char* name) {
    const OpeningCall call(printed_);
    return library_.functions.init_device(name);
}

/// Numbers that no device can have are replaced by those of the Touch.
Servo::Arm DriverThread::read_facts(HdHandle handle) {
    const HdLibrary& library = library_.functions;
    library.make_current(handle);
    const auto text = [&library](HdEnum what) {
        const char* const read = library.get_string(what);
        return read != nullptr ? one_line(read) : std::string{};
    };
    const auto number = [&library](HdEnum what) {
        double read = 0.0;
        library.get_doubles(what, &read);
        return read;
    };
    Status& status = board_.draft();
    status.version = text(kHdVersion);
    status.driver = text(kHdDriverVersion);
    status.model = text(kHdModel);
    status.serial = text(kHdSerial);
    status.peak_newton = number(kHdMaxForce);
    status.stiffness_newton_per_mm = number(kHdMaxStiffness);
    DeviceLimits limits = nominal_limits();
    limits.max_force_newton =
        within(number(kHdContinuousForce), 0.1, kMostForce_newton, limits.max_force_newton);
    limits.max_stiffness_newton_per_mm =
        within(status.stiffness_newton_per_mm, 0.05, 1.0, limits.max_stiffness_newton_per_mm);
    status.continuous_newton = limits.max_force_newton;
    std::array<double, 6> box{};
    library.get_doubles(kHdUsableWorkspace, box.data());
    // In metres: half of the sum of two millimetres.
    const Vec3 middle = 0.0005 * Vec3{box[0] + box[3], box[1] + box[4], box[2] + box[5]};
    int style = 0;
    library.get_integers(kHdCalibrationStyle, &style);
    status.style = static_cast<HdEnum>(style);
    (void)take_faults(library);
    return {handle, is_finite(middle) ? middle : Vec3{0.0}, limits};
}

/// From an open device to its end.
void DriverThread::follow(HdHandle handle) {
    const Servo::Arm arm = read_facts(handle);
    watch_.begin();
    std::string why_ended;
    if (reset_encoders(handle)) {
        servos_.push_back(
            std::make_unique<Servo>(library_.functions, arm, *buffers_, watch_, buttons_));
        Servo& servo = *servos_.back();
        HdSchedule schedule = 0;
        const Fault refused = start(servo, schedule);
        why_ended = refused.kind == FaultClass::link ? why_lost(refused) : watch_servo(servo);
        // The library may still call one that did not end by itself.
        if (stop_servo(servo, schedule)) servos_.pop_back();
    }
    buttons_.release();
    library_.functions.disable_device(handle);
    (void)take_faults(library_.functions);
    board_.draft().ticks_per_s = 0.0;
    trouble_ = why_ended;
    if (!trouble_.empty()) board_.enter_new(Stage::looking, trouble_, true);
}

/// A device that has only this style of calibration gets it before the scheduler starts: the user
/// holds the arm in its reset position, and presses the button. False: the program ends.
bool DriverThread::reset_encoders(HdHandle handle) {
    const HdLibrary& library = library_.functions;
    if (board_.draft().style != kHdEncoderReset) return true;
    bool was_pressed = true;  // a button that is held from before is no answer
    while (!end.requested()) {
        int pressed = 0;
        library.begin_frame(handle);
        library.get_integers(kHdButtons, &pressed);
        const HdEnum calibration = library.check_calibration();
        library.end_frame(handle);
        if (take_faults(library).kind == FaultClass::link) return true;  // the servo meets it again
        if (calibration == kHdCalibrated) return true;
        if (pressed != 0 && !was_pressed) library.update_calibration(kHdEncoderReset);
        was_pressed = pressed != 0;
        board_.enter_new(Stage::not_calibrated, sentence_for(Stage::not_calibrated, board_.draft()),
                         false);
        end.pause(kAskPersonEvery);
    }
    return false;
}

/// Starting the scheduler switches the force output on: it goes off again until the arm is ready.
Fault DriverThread::start(Servo& servo, HdSchedule& schedule) {
    const HdLibrary& library = library_.functions;
    schedule = library.schedule(&Servo::run, &servo, kHdMaxPriority);
    const Fault refused = take_faults(library);
    if (refused.kind == FaultClass::link) return refused;
    library.start_scheduler();
    library.disable(kHdForceOutput);
    force_on_ = false;
    counted_ = seen_ = 0;
    counted_at_ = seen_at_ = calibrated_at_ = Clock::now();
    return take_faults(library);
}

/// Returns why the link ended; empty: the program ends.
std::string DriverThread::watch_servo(Servo& servo) {
    while (!end.requested()) {
        const Time now = Clock::now();
        const ServoReport& newest = servo.report();
        if (newest.loss.kind != FaultClass::none) return why_lost(newest.loss);
        if (newest.ticks != seen_) seen_at_ = now;
        seen_ = newest.ticks;
        const bool silent = now - seen_at_ > kLongestSilence - kLook;
        if (now - seen_at_ > kGivenUpAfter) return sentence_for(Stage::silent, board_.draft());
        if (!silent) calibrate(newest, now);
        const bool ready = newest.stage == Stage::ready || newest.stage == Stage::force_cut ||
                           newest.stage == Stage::refused;
        switch_force(servo, options_.forces && ready && !silent);
        report(newest, silent, now);
        end.pause(kLook);
    }
    return {};
}

/// Calibrates when the device asks for it, or its stylus is in the inkwell.
void DriverThread::calibrate(const ServoReport& newest, Time now) {
    const bool by_itself = newest.calibration == kHdNeedsUpdate;
    const bool in_inkwell = newest.calibration == kHdNeedsPerson &&
                            (board_.draft().style & kHdInkwell) != 0 && newest.in_inkwell;
    if (newest.ticks == 0 || !(by_itself || in_inkwell) || now - calibrated_at_ < kCalibrateEvery)
        return;
    calibrated_at_ = now;
    const bool automatic = (board_.draft().style & kHdAuto) != 0;
    library_.functions.update_calibration(automatic ? kHdAuto : kHdInkwell);
}

void DriverThread::switch_force(Servo& servo, bool on) {
    if (on == force_on_) return;
    force_on_ = on;
    if (on) library_.functions.enable(kHdForceOutput);
    servo.allow_force(on);
    if (!on) library_.functions.disable(kHdForceOutput);
}

/// Zero force, force output off, scheduler stopped, in this order. False: the servo was cut off.
bool DriverThread::stop_servo(Servo& servo, HdSchedule schedule) {
    servo.end();
    for (const Time until = Clock::now() + kLongestEnd; !servo.ended() && Clock::now() < until;)
        std::this_thread::sleep_for(milliseconds(1));
    const bool ended = servo.ended();
    library_.functions.disable(kHdForceOutput);
    library_.functions.stop_scheduler();
    library_.functions.unschedule(schedule);
    (void)take_faults(library_.functions);
    servo.cut_off();
    if (servo.runs()) return false;
    buffers_->poses.publish(TimedPose{});  // so that no tick uses an old pose
    return ended;
}

void DriverThread::report(const ServoReport& servo, bool silent, Time now) {
    Status& status = board_.draft();
    status.presses = servo.presses;
    status.pressed_at = servo.pressed_at;
    status.limit_newton = servo.limit_newton;
    status.warmest = servo.warmest;
    status.reports_heat = servo.reports_heat;
    status.errors = servo.errors;
    status.forces_cut = servo.forces_cut;
    if (now - counted_at_ >= kRatePeriod) {
        const std::chrono::duration<double> passed = now - counted_at_;
        status.ticks_per_s = static_cast<double>(servo.ticks - counted_) / passed.count();
        counted_ = servo.ticks;
        counted_at_ = now;
    }
    const Stage stage = silent ? Stage::silent : servo.stage;
    if (stage == status.stage && servo.warm == status.warm && servo.last.code == last_code_) {
        board_.publish_if_due(now);
        return;
    }
    status.warm = servo.warm;
    last_code_ = servo.last.code;
    if (servo.last.kind != FaultClass::none) status.last_error = name_of(servo.last);
    const bool trouble = stage == Stage::silent || stage == Stage::not_understood ||
                         stage == Stage::force_cut || stage == Stage::refused ||
                         stage == Stage::hot || stage == Stage::stands_still || status.warm;
    board_.enter_new(stage, sentence_for(stage, status), trouble);
}

}  // namespace dibhr::openhaptics
