// A library of our own with the names and types of OpenHaptics' HD API, a servo thread, and two
// simulated arms below it. The names of the arms are "Default Device" and "Second". It checks each
// argument, and what it does wrong a test says in the ArmPage.
#include <algorithm>
#include <array>
#include <chrono>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/device/openhaptics/arm_page.hpp"

namespace {

using dibhr::test::openhaptics::ArmPage;
using dibhr::test::openhaptics::kPageVariable;
using dibhr::test::openhaptics::map_arm_page;
using dibhr::test::openhaptics::SentForce;
using dibhr::test::openhaptics::SimulatedArm;

using Callback = unsigned int (*)(void*);

struct ErrorInfo {
    unsigned int code;
    int internal_code;
    unsigned int device;
};

struct Scheduled {
    unsigned long handle;
    Callback callback;
    void* data;
};

constexpr unsigned kInvalid = 0xFFFFFFFF;
constexpr unsigned kFirstHandle = 7;  // no index, so that an index in its place is noticed
constexpr double kStep_mm = 0.055;
constexpr double kPeak_newton = 3.3;
constexpr const char* kVersion = "3.4 stand-in";

struct Library {
    std::mutex lock{};           // of all but the callbacks
    std::mutex callback_lock{};  // held while they run
    ArmPage own{};
    ArmPage* page{&own};
    std::string page_file{};
    unsigned current{kInvalid};
    unsigned frame{kInvalid};  // the device of the open frame
    std::array<double, 3> force{};
    bool force_set{false};
    std::vector<ErrorInfo> errors{};
    std::vector<Scheduled> scheduled{};
    unsigned long next_schedule{1};
    std::thread servo{};
    std::atomic<bool> runs{false};
};

Library& library() {
    // Never destroyed: the servo thread may run until the program ends.
    static auto* const only = new Library;
    return *only;
}

void wrong(const char* what, unsigned value = 0) {
    ArmPage& page = *library().page;
    if (page.wrong_calls++ == 0)
        std::snprintf(page.first_wrong, sizeof page.first_wrong, "%s (0x%x)", what, value);
}

void raise(unsigned code, int internal_code = 0) {
    library().errors.push_back({code, internal_code, library().current});
}

SimulatedArm* arm_of(unsigned handle) {
    const unsigned k = handle - kFirstHandle;
    return k < ArmPage::kArms ? &library().page->arms[k] : nullptr;
}

/// The arm of the current device, which has to be open.
SimulatedArm* current_arm(const char* caller) {
    SimulatedArm* const arm = arm_of(library().current);
    if (arm == nullptr || !arm->open) {
        wrong(caller);
        raise(0x104);
        return nullptr;
    }
    return arm;
}

/// The arm of the open frame.
SimulatedArm* arm_in_frame(const char* caller, unsigned parameter) {
    if (parameter == library().page->unknown) {
        raise(0x100);
        return nullptr;
    }
    if (library().frame == kInvalid) {
        wrong(caller, parameter);
        raise(0x402);
        return nullptr;
    }
    return current_arm(caller);
}

void hold(SimulatedArm& arm, const std::array<double, 3>& force) {
    for (std::size_t k = 0; k < force.size(); ++k) arm.force_newton[k] = force[k];
}

void record(const std::array<double, 3>& force) {
    ArmPage& page = *library().page;
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    SentForce& sent = page.sent[page.sent_count % ArmPage::kMostSent];
    sent = {now.count(), {force[0], force[1], force[2]}};
    ++page.sent_count;
}

/// The page of the test, which may be another one at each opening.
void find_page() {
    const char* const file = std::getenv(kPageVariable);
    if (file == nullptr || library().page_file == file) return;
    if (ArmPage* const page = map_arm_page(file)) {
        library().page = page;
        library().page_file = file;
    }
}

/// The index of the arm with this name; kArms: none.
std::size_t arm_named(const char* name) {
    const ArmPage& page = *library().page;
    if (name == nullptr) return page.default_by_null ? 0 : ArmPage::kArms;
    if (std::strcmp(name, "Default Device") == 0) return page.default_by_name ? 0 : ArmPage::kArms;
    return std::strcmp(name, "Second") == 0 ? 1 : ArmPage::kArms;
}

/// What real ones do to the program when a device is opened.
void disturb_program() {
    ArmPage& page = *library().page;
    page.number_read = std::strtod("1.5", nullptr);  // as from a file of the device
    if (page.prints) std::printf("A stand-in for development\nSecond line\n");
    if (page.sets_locale) std::setlocale(LC_NUMERIC, "C.UTF-8");
    if (const int takes = page.opening_takes_ms; takes > 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(takes));
}

void tick() {
    const std::lock_guard callbacks(library().callback_lock);
    auto& scheduled = library().scheduled;
    scheduled.erase(
        std::remove_if(scheduled.begin(), scheduled.end(),
                       [](const Scheduled& one) { return one.callback(one.data) == 0; }),
        scheduled.end());
}

void run_servo() {
    auto next = std::chrono::steady_clock::now();
    while (library().runs) {
        next += std::chrono::microseconds(library().page->tick_us.load());
        std::this_thread::sleep_until(next);
        if (library().page->calls_back) tick();
    }
}

void copy(const dibhr::test::openhaptics::Axes& from, double* values) {
    for (std::size_t k = 0; k < from.size(); ++k) values[k] = from[k];
}

}  // namespace

#define EXPORTED extern "C" __attribute__((visibility("default")))

EXPORTED unsigned hdInitDevice(const char* name) {
    const std::lock_guard lock(library().lock);
    find_page();
    ++library().page->openings;
    disturb_program();
    const std::size_t k = arm_named(name);
    SimulatedArm* const arm = k < ArmPage::kArms ? &library().page->arms[k] : nullptr;
    unsigned error = 0;
    if (arm == nullptr || !arm->attached) {
        error = 0x300;
    } else if (arm->open) {
        error = 0x301;
    } else {
        error = arm->in_use_error;
    }
    if (error != 0) {
        raise(error);
        return kInvalid;
    }
    arm->open = true;
    library().current = kFirstHandle + static_cast<unsigned>(k);
    return library().current;
}

EXPORTED void hdDisableDevice(unsigned handle) {
    const std::lock_guard lock(library().lock);
    SimulatedArm* const arm = arm_of(handle);
    if (arm == nullptr || !arm->open) return wrong("hdDisableDevice", handle);
    if (library().runs) wrong("hdDisableDevice while the scheduler runs");
    if (arm->output) wrong("hdDisableDevice while the force output is on");
    ++library().page->closings;
    arm->open = false;
    hold(*arm, {});
    library().current = kInvalid;
}

EXPORTED void hdMakeCurrentDevice(unsigned handle) {
    const std::lock_guard lock(library().lock);
    if (arm_of(handle) == nullptr) return wrong("hdMakeCurrentDevice", handle);
    library().current = handle;
}

EXPORTED void hdBeginFrame(unsigned handle) {
    const std::lock_guard lock(library().lock);
    if (arm_of(handle) == nullptr) return wrong("hdBeginFrame", handle);
    if (library().frame != kInvalid) {
        wrong("hdBeginFrame in a frame", handle);
        return raise(0x400);
    }
    library().current = library().frame = handle;
    library().force_set = false;
}

EXPORTED void hdEndFrame(unsigned handle) {
    while (library().page->hangs) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(library().lock);
    ArmPage& page = *library().page;
    if (library().frame != handle) {
        wrong("hdEndFrame of no frame", handle);
        return raise(0x401);
    }
    library().frame = kInvalid;
    SimulatedArm& arm = *arm_of(handle);
    ++arm.frames;
    std::array<double, 3> force = library().force_set ? library().force : std::array<double, 3>{};
    if (!arm.attached) raise(0x302, -28);
    if (page.raised != 0 && page.raised_times > 0) {
        --page.raised_times;
        raise(page.raised, page.raised_internal);
        force = {};
    }
    if (std::hypot(force[0], force[1], force[2]) > kPeak_newton) {
        raise(0x201);
        force = {};
    }
    if (!arm.output || !arm.attached) force = {};
    hold(arm, force);
    record(force);
    arm.strongest_newton =
        std::max(arm.strongest_newton.load(), std::hypot(force[0], force[1], force[2]));
    arm.framed_at_ns = std::chrono::steady_clock::now().time_since_epoch().count();
}

EXPORTED ErrorInfo hdGetError() {
    const std::lock_guard lock(library().lock);
    auto& errors = library().errors;
    if (errors.empty()) return {0, 0, kInvalid};
    const ErrorInfo newest = errors.back();
    errors.pop_back();
    return newest;
}

EXPORTED void hdEnable(unsigned capability) {
    const std::lock_guard lock(library().lock);
    if (capability != 0x4000) return wrong("hdEnable", capability);
    if (SimulatedArm* const arm = current_arm("hdEnable")) arm->output = true;
}

EXPORTED void hdDisable(unsigned capability) {
    const std::lock_guard lock(library().lock);
    if (capability != 0x4000) return wrong("hdDisable", capability);
    SimulatedArm* const arm = current_arm("hdDisable");
    if (arm == nullptr) return;
    arm->output = false;
    hold(*arm, {});
}

EXPORTED void hdGetBooleanv(unsigned parameter, unsigned char* value) {
    const std::lock_guard lock(library().lock);
    if (parameter != 0x2002) return wrong("hdGetBooleanv", parameter);
    if (SimulatedArm* const arm = arm_in_frame("hdGetBooleanv", parameter))
        *value = arm->in_inkwell ? 1 : 0;
}

EXPORTED void hdGetIntegerv(unsigned parameter, int* value) {
    const std::lock_guard lock(library().lock);
    if (parameter == 0x2555) {
        if (SimulatedArm* const arm = current_arm("hdGetIntegerv")) *value = arm->calibration_style;
        return;
    }
    if (parameter != 0x2000) return wrong("hdGetIntegerv", parameter);
    if (SimulatedArm* const arm = arm_in_frame("hdGetIntegerv", parameter)) *value = arm->buttons;
}

EXPORTED void hdGetDoublev(unsigned parameter, double* values) {
    const std::lock_guard lock(library().lock);
    const bool of_frame = parameter < 0x2200 || parameter == 0x2605;
    SimulatedArm* const arm =
        of_frame ? arm_in_frame("hdGetDoublev", parameter) : current_arm("hdGetDoublev");
    if (arm == nullptr) return;
    switch (parameter) {
        case 0x2050:
            return copy(arm->position_mm, values);
        case 0x2051:
            return copy(arm->velocity_mm_per_s, values);
        case 0x2150:
            return copy(arm->gimbal_rad, values);
        case 0x2605:
            std::fill_n(values, 3, 0.0);
            values[1] = arm->heat;
            return;
        case 0x2551: {
            constexpr std::array kBox{-80.0, -60.0, -35.0, 80.0, 60.0, 35.0};
            std::copy(kBox.begin(), kBox.end(), values);
            return;
        }
        case 0x2602:
            *values = arm->stiffness;
            return;
        case 0x2603:
            *values = kPeak_newton;
            return;
        case 0x2604:
            *values = arm->continuous_newton;
            return;
        default:
            return wrong("hdGetDoublev", parameter);
    }
}

EXPORTED void hdGetLongv(unsigned parameter, long* values) {
    const std::lock_guard lock(library().lock);
    if (parameter != 0x2010) return wrong("hdGetLongv", parameter);
    SimulatedArm* const arm = arm_in_frame("hdGetLongv", parameter);
    if (arm == nullptr) return;
    for (std::size_t k = 0; k < 3; ++k) {
        const double position_mm = arm->position_mm[k];
        const bool still = arm->encoders_stand_still || !std::isfinite(position_mm);
        values[k] = still ? 0 : std::lround(position_mm / kStep_mm);
        values[3 + k] = std::lround(1000.0 * arm->gimbal_rad[k]);
    }
}

EXPORTED void hdSetDoublev(unsigned parameter, const double* values) {
    const std::lock_guard lock(library().lock);
    if (parameter != 0x2700) return wrong("hdSetDoublev", parameter);
    if (arm_in_frame("hdSetDoublev", parameter) == nullptr) return;
    if (!(std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2])))
        return wrong("hdSetDoublev: a force that is no number");
    std::copy_n(values, 3, library().force.begin());
    library().force_set = true;
}

EXPORTED const char* hdGetString(unsigned parameter) {
    const std::lock_guard lock(library().lock);
    if (parameter == 0x2500) return kVersion;
    const bool known = parameter >= 0x2501 && parameter <= 0x2504;
    if (!known) wrong("hdGetString", parameter);
    if (!known || current_arm("hdGetString") == nullptr) return nullptr;
    const bool second = library().current != kFirstHandle;
    switch (parameter) {
        case 0x2501:
            return "Touch";
        case 0x2502:
            return "2024.9.19";
        case 0x2503:
            return "dibhr";
        default:
            return second ? "SIM-2" : "SIM-1";
    }
}

EXPORTED unsigned hdCheckCalibration() {
    const std::lock_guard lock(library().lock);
    SimulatedArm* const arm = current_arm("hdCheckCalibration");
    return arm != nullptr ? arm->calibration.load() : 0x5002;
}

EXPORTED void hdUpdateCalibration(unsigned style) {
    const std::lock_guard lock(library().lock);
    SimulatedArm* const arm = current_arm("hdUpdateCalibration");
    if (arm == nullptr) return;
    if ((static_cast<unsigned>(arm->calibration_style) & style) != style || style == 0)
        return wrong("hdUpdateCalibration: a style that the device does not have", style);
    if ((style == 1) == library().runs)
        return wrong("hdUpdateCalibration: the scheduler runs, or does not", style);
    if (arm->output) wrong("hdUpdateCalibration while the force output is on");
    ++arm->calibrations;
    if (style != 4 || arm->in_inkwell || arm->calibration == 0x5001) arm->calibration = 0x5000;
}

EXPORTED void hdStartScheduler() {
    const std::lock_guard lock(library().lock);
    if (library().runs) return wrong("hdStartScheduler twice");
    if (SimulatedArm* const arm = current_arm("hdStartScheduler")) arm->output = true;
    library().runs = true;
    library().servo = std::thread(run_servo);
}

EXPORTED void hdStopScheduler() {
    if (!library().runs) return wrong("hdStopScheduler twice");
    library().runs = false;
    if (library().page->hangs) return library().servo.detach();
    library().servo.join();
}

EXPORTED unsigned long hdScheduleAsynchronous(Callback callback, void* data,
                                              unsigned short priority) {
    if (callback == nullptr || priority == 0) wrong("hdScheduleAsynchronous", priority);
    const std::lock_guard callbacks(library().callback_lock);
    library().scheduled.push_back({library().next_schedule, callback, data});
    return library().next_schedule++;
}

EXPORTED void hdUnschedule(unsigned long schedule) {
    if (library().page->hangs) return;
    const std::lock_guard callbacks(library().callback_lock);
    if (schedule == 0 || schedule >= library().next_schedule) wrong("hdUnschedule");
    auto& scheduled = library().scheduled;
    scheduled.erase(
        std::remove_if(scheduled.begin(), scheduled.end(),
                       [schedule](const Scheduled& one) { return one.handle == schedule; }),
        scheduled.end());
}
