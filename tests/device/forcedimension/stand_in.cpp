// A library of our own with the names and C types of Force Dimension's, and simulated arms below
// them. It checks every argument. Compiled twice: as libdrd.so.3, and, without drd*, as
// libdhd.so.3.
#include <fcntl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/device/forcedimension/stand_in_page.hpp"

namespace {

using namespace dibhr::test::forcedimension;

constexpr int kFailed = -1;
constexpr int kTimeGuard = 1;
constexpr int kSaturated = 2;
constexpr int kWatchdogCause = 3;

thread_local int last_error = 0;

std::int64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void pause_ms(int ms) {
    const timespec span{ms / 1000, ms % 1000 * 1'000'000L};
    nanosleep(&span, nullptr);
}

Page* mapped_page() {
    const char* const file = std::getenv(kPageVariable);
    const int descriptor = file != nullptr ? open(file, O_RDWR | O_CLOEXEC) : -1;
    if (descriptor < 0) return nullptr;
    void* const memory =
        mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    close(descriptor);
    return memory != MAP_FAILED ? static_cast<Page*>(memory) : nullptr;
}

Page& page() {
    static Page own;
    static Page* const mapped = mapped_page();
    return mapped != nullptr ? *mapped : own;
}

void note(const char* name) {
    page().last_calls[page().calls++ % kCallsKept] = name;
}

int fail(int error) {
    last_error = error;
    return kFailed;
}

int wrong() {
    ++page().wrong_calls;
    return fail(kErrorInvalid);
}

/// The firmware ends a force after which nothing came.
void run_watchdog(Unit& unit) {
    const bool pushes = unit.force_on && unit.watchdog > 0;
    if (!pushes || unit.newton_at_ns == 0) return;
    if (now_ns() - unit.newton_at_ns <= unit.watchdog * std::int64_t{125'000}) return;
    unit.force_on = false;
    unit.cause = kWatchdogCause;
}

/// The open unit of this ID that answers; null: the call fails, and last_error says why.
Unit* unit_of(char id, const char* name) {
    note(name);
    const auto place = static_cast<std::size_t>(static_cast<signed char>(id));
    if (place >= kUnits || !page().units[place].open) {
        wrong();
        return nullptr;
    }
    Unit& unit = page().units[place];
    if (!unit.plugged) {
        fail(kErrorCom);
        return nullptr;
    }
    run_watchdog(unit);
    return &unit;
}

int open_unit(std::size_t place) {
    if (place >= kUnits || !page().units[place].plugged) return fail(5);
    Unit& unit = page().units[place];
    if (unit.in_use) return fail(kErrorInUse);
    unit.open = true;
    unit.was_opened = true;
    unit.watchdog = 0;
    unit.newton_at_ns = 0;
    return static_cast<int>(place);
}

int open_nth(int index, const char* name) {
    note(name);
    int seen = 0;
    for (std::size_t k = 0; k < kUnits; ++k) {
        if (page().units[k].plugged && seen++ == index) return open_unit(k);
    }
    return fail(15);
}

int close_unit(char id, const char* name) {
    note(name);
    const auto place = static_cast<std::size_t>(static_cast<signed char>(id));
    if (place >= kUnits || !page().units[place].open) return wrong();
    page().units[place].open = false;
    return 0;
}

void brake(Unit& unit) {
    for (auto& part : unit.newton) part = 0.0;
    unit.force_on = false;
    unit.moves_itself = false;
}

}  // namespace

extern "C" {

Page* stand_in_page() {
    return &page();
}

void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
    *major = page().version[0];
    *minor = page().version[1];
    *release = page().version[2];
    *revision = page().version[3];
}
int dhdGetDeviceCount() {
    int count = 0;
    for (const Unit& unit : page().units) count += unit.plugged ? 1 : 0;
    return count;
}
int dhdErrorGetLast() {
    return last_error;
}
int dhdOpenID(char index) {
    return open_nth(index, "dhdOpenID");
}
int dhdOpenType(int type) {
    note("dhdOpenType");
    for (std::size_t k = 0; k < kUnits; ++k) {
        Unit& unit = page().units[k];
        if (unit.plugged && !unit.open && unit.type == type) return open_unit(k);
    }
    return fail(5);
}
int dhdClose(char id) {
    return close_unit(id, "dhdClose");
}
int dhdStop(char id) {
    Unit* const unit = unit_of(id, "dhdStop");
    if (unit == nullptr) return kFailed;
    brake(*unit);
    return 0;
}
int dhdGetSystemType(char id) {
    const Unit* const unit = unit_of(id, "dhdGetSystemType");
    return unit != nullptr ? unit->type.load() : kFailed;
}
int dhdGetSerialNumber(unsigned short* serial, char id) {
    const Unit* const unit = unit_of(id, "dhdGetSerialNumber");
    if (unit == nullptr) return kFailed;
    *serial = static_cast<unsigned short>(unit->serial);
    return 0;
}
int dhdGetVersion(double* version, char id) {
    const Unit* const unit = unit_of(id, "dhdGetVersion");
    if (unit == nullptr) return kFailed;
    *version = unit->has_watchdog ? 3.0 : 2.4;
    return 0;
}
bool dhdHasGripper(char id) {
    const Unit* const unit = unit_of(id, "dhdHasGripper");
    return unit != nullptr && unit->gripper;
}
bool dhdIsLeftHanded(char id) {
    unit_of(id, "dhdIsLeftHanded");
    return false;
}
int dhdGetPosition(double* x, double* y, double* z, char id) {
    const Unit* const unit = unit_of(id, "dhdGetPosition");
    if (unit == nullptr) return kFailed;
    *x =
        page().not_a_number ? std::numeric_limits<double>::quiet_NaN() : unit->position_m[0].load();
    *y = unit->position_m[1];
    *z = unit->position_m[2];
    return page().remarks ? kTimeGuard : 0;
}
int dhdGetLinearVelocity(double*, double*, double*, char) {
    ++page().velocity_calls;
    return fail(7);
}
int dhdSetVelocityThreshold(unsigned, char) {
    ++page().threshold_calls;
    return 0;
}
int dhdGetStatus(int* status, char id) {
    const Unit* const unit = unit_of(id, "dhdGetStatus");
    if (unit == nullptr) return kFailed;
    for (int k = 0; k < 17; ++k) status[k] = 0;
    status[0] = unit->power ? 1 : 0;
    status[1] = 1;
    status[3] = unit->initialised ? 1 : 0;
    status[5] = unit->force_on ? 1 : 0;
    status[9] = unit->error ? 1 : 0;
    status[10] = unit->holds_weight ? 1 : 0;
    status[14] = unit->cause;
    return 0;
}
unsigned dhdGetButtonMask(char id) {
    const Unit* const unit = unit_of(id, "dhdGetButtonMask");
    return unit != nullptr ? unit->buttons.load() : 0;
}
int dhdSetForceAndTorqueAndGripperForce(double x, double y, double z, double torque_x,
                                        double torque_y, double torque_z, double gripper, char id) {
    Unit* const unit = unit_of(id, "dhdSetForceAndTorqueAndGripperForce");
    while (page().hangs) pause_ms(1);
    if (unit == nullptr) return kFailed;
    const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    const bool turns = torque_x != 0.0 || torque_y != 0.0 || torque_z != 0.0 || gripper != 0.0;
    if (!finite || turns || unit->moves_itself) return wrong();
    if (const int slow_us = page().slow_us; slow_us > 0) {
        const timespec span{0, slow_us * 1000L};
        nanosleep(&span, nullptr);
    }
    unit->newton[0] = x;
    unit->newton[1] = y;
    unit->newton[2] = z;
    unit->newton_at_ns = now_ns();
    unit->strongest_newton = std::max(unit->strongest_newton.load(), std::hypot(x, y, z));
    return page().remarks ? kSaturated : 0;
}
int dhdEnableForce(unsigned char on, char id) {
    Unit* const unit = unit_of(id, "dhdEnableForce");
    if (unit == nullptr) return kFailed;
    if (on > 1) return wrong();
    unit->force_on = on == 1 && unit->power;
    if (on == 1) unit->cause = 0;
    unit->newton_at_ns = now_ns();
    return 0;
}
int dhdSetGravityCompensation(int on, char id) {
    Unit* const unit = unit_of(id, "dhdSetGravityCompensation");
    if (unit == nullptr) return kFailed;
    unit->holds_weight = on == 1;
    return on == 0 || on == 1 ? 0 : wrong();
}
int dhdSetMaxForce(double newton, char id) {
    Unit* const unit = unit_of(id, "dhdSetMaxForce");
    if (unit == nullptr) return kFailed;
    if (!(newton > 0.0)) return wrong();
    unit->max_newton = newton;
    return 0;
}
int dhdEmulateButton(unsigned char on, char id) {
    Unit* const unit = unit_of(id, "dhdEmulateButton");
    if (unit == nullptr) return kFailed;
    if (on != 1 || !unit->gripper) return wrong();
    unit->emulates_button = true;
    return 0;
}
int dhdEnableExpertMode() {
    note("dhdEnableExpertMode");
    return 0;
}
int dhdSetWatchdog(unsigned char periods, char id) {
    Unit* const unit = unit_of(id, "dhdSetWatchdog");
    if (unit == nullptr) return kFailed;
    if (periods == 0) return wrong();  // that switches it off
    if (!unit->has_watchdog) return fail(6);
    unit->watchdog = periods;
    return 0;
}
int dhdGetWatchdog(unsigned char* periods, char id) {
    const Unit* const unit = unit_of(id, "dhdGetWatchdog");
    if (unit == nullptr) return kFailed;
    *periods = static_cast<unsigned char>(unit->watchdog);
    return 0;
}
int dhdReset(char id) {
    Unit* const unit = unit_of(id, "dhdReset");
    if (unit == nullptr) return kFailed;
    if (page().initialisation_fails) return fail(1);
    unit->initialised = true;
    return 0;
}

#ifndef WITHOUT_DRD
int drdOpenID(char index) {
    return open_nth(index, "drdOpenID");
}
int drdClose(char id) {
    return close_unit(id, "drdClose");
}
bool drdIsSupported(char id) {
    return unit_of(id, "drdIsSupported") != nullptr;
}
bool drdIsInitialized(char id) {
    const Unit* const unit = unit_of(id, "drdIsInitialized");
    return unit != nullptr && unit->initialised;
}
int drdAutoInit(char id) {
    Unit* const unit = unit_of(id, "drdAutoInit");
    if (unit == nullptr) return kFailed;
    ++unit->initialisations;
    unit->moves_itself = true;
    for (int ms = 0; ms < page().initialisation_ms && unit->moves_itself; ms += 10) pause_ms(10);
    if (!unit->moves_itself.exchange(false) || page().initialisation_fails) return fail(1);
    unit->initialised = true;
    unit->force_on = true;
    return 0;
}
int drdStop(bool force_on, char id) {
    Unit* const unit = unit_of(id, "drdStop");
    if (unit == nullptr) return kFailed;
    unit->moves_itself = false;
    if (!force_on) brake(*unit);
    return 0;
}
#endif

}  // extern "C"
