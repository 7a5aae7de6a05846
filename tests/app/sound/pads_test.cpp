// SDL's virtual game pads, and what the real output sends to their motors.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include "app/sound/pad_output.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr Uint16 kSony = 0x054c;
constexpr Uint16 kDualSense = 0x0ce6;

/// A rumble sent to a pad, and its time.
struct Told {
    Clock::time_point at{};
    int low{0};
    int high{0};
};

/// SDL's joysticks for a test of its own.
class Joysticks {
  public:
    Joysticks() {
        configure_sdl();
        REQUIRE(SDL_InitSubSystem(SDL_INIT_JOYSTICK) == 0);
    }
    ~Joysticks() { SDL_QuitSubSystem(SDL_INIT_JOYSTICK); }
    Joysticks(const Joysticks&) = delete;
    Joysticks& operator=(const Joysticks&) = delete;
};

/// A pad, plugged in from construction to destruction.
class VirtualPad {
  public:
    explicit VirtualPad(const char* name, Uint16 product = 0, bool rumbles = true) {
        SDL_VirtualJoystickDesc description{};
        description.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
        description.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
        description.naxes = 6;
        description.nbuttons = 15;
        description.vendor_id = product != 0 ? kSony : Uint16{0};
        description.product_id = product;
        description.name = name;
        description.userdata = this;
        if (rumbles) description.Rumble = &VirtualPad::take;
        const int index = SDL_JoystickAttachVirtualEx(&description);
        REQUIRE(index >= 0);
        id_ = SDL_JoystickGetDeviceInstanceID(index);
    }
    ~VirtualPad() {
        for (int k = 0; k < SDL_NumJoysticks(); ++k)
            if (SDL_JoystickGetDeviceInstanceID(k) == id_) SDL_JoystickDetachVirtual(k);
    }
    VirtualPad(const VirtualPad&) = delete;
    VirtualPad& operator=(const VirtualPad&) = delete;

    [[nodiscard]] std::vector<Told> told() const {
        const std::lock_guard lock(mutex_);
        return told_;
    }
    void forget() {
        const std::lock_guard lock(mutex_);
        told_.clear();
    }
    [[nodiscard]] bool turns() const {
        const auto all = told();
        return !all.empty() && (all.back().low != 0 || all.back().high != 0);
    }
    [[nodiscard]] bool knocks() const {
        const auto all = told();
        return std::any_of(all.begin(), all.end(), [](const Told& one) { return one.low > 3000; });
    }

    /// Blocks, like a driver that hangs.
    void hang(bool hang) {
        hangs_ = hang;
        hangs_.notify_all();
    }

  private:
    static int SDLCALL take(void* self, Uint16 low, Uint16 high) {
        VirtualPad& pad = *static_cast<VirtualPad*>(self);
        pad.hangs_.wait(true);
        const std::lock_guard lock(pad.mutex_);
        pad.told_.push_back({Clock::now(), low, high});
        return 0;
    }

    SDL_JoystickID id_{-1};
    mutable std::mutex mutex_{};
    std::vector<Told> told_{};  // under the mutex
    std::atomic<bool> hangs_{false};
};

constexpr SoundTick kAir{Vec3{0.0, 0.0, 5.0}, 0.0, false, true};
constexpr SoundTick kTouch{Vec3{0.0}, 1.0, true, true};
constexpr SoundTick kHarder{Vec3{0.0, 0.0, 0.3}, 2.0, true, true};
constexpr SoundTick kOff{Vec3{0.0}, 0.0, true, false};

/// The real output, and ticks for it as the loop pushes them, a millisecond each.
struct Touching {
    Touching() { output.choose({}, true, false); }

    void push(int ticks, const SoundTick& tick) {
        for (int k = 0; k < ticks; ++k) {
            next = std::max(next + milliseconds(1), Clock::now() - milliseconds(5));
            std::this_thread::sleep_until(next);  // the loop's clock
            source->ticks.push(tick);
        }
    }
    /// Pushes `ticks` ticks, and more until the condition is met.
    template <typename Condition>
    [[nodiscard]] bool push_until(const Condition& is_so, int ticks, const SoundTick& tick) {
        push(ticks, tick);
        for (int k = 0; k < kMostTicks && !is_so(); ++k) push(1, tick);
        return is_so();
    }
    /// Rubs to and fro until the condition is met.
    template <typename Condition>
    [[nodiscard]] bool rub_until(const Condition& is_so) {
        for (int k = 0; k < kMostTicks && !is_so(); ++k) push(1, k % 8 < 4 ? kTouch : kHarder);
        return is_so();
    }
    [[nodiscard]] bool finds(std::size_t pads) const {
        return eventually([&] { return output.info().found.size() == pads; });
    }

    static constexpr int kMostTicks = 60'000;
    std::shared_ptr<TouchSource> source{std::make_shared<TouchSource>()};
    PadOutput output{source};
    Clock::time_point next{Clock::now()};
};

double ms_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

double middle_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

TEST_CASE("a tap rumbles a pad, and force off stops it", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    VirtualPad pad("Virtual pad");
    Touching touching;
    REQUIRE(touching.finds(1));
    for (int k = 0; k < 3; ++k) {
        CHECK(touching.push_until([&] { return !pad.turns(); }, 50 + 3 * k, kAir));
        pad.forget();
        // Late ticks are no tap: lift and tap again.
        CHECK(eventually([&] {
            touching.push(40, kAir);
            touching.push(20, kTouch);
            return pad.knocks();
        }));
        CHECK(touching.push_until([&] { return !pad.turns(); }, 20, kOff));
        pad.forget();
        touching.push(30, kOff);
        CHECK_FALSE(pad.turns());
    }
}

TEST_CASE("a pad rumbles within 30 ms of a tap, and stops within 30 ms of force off",
          "[pads][realtime]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    VirtualPad pad("Virtual pad");
    Touching touching;
    REQUIRE(touching.finds(1));
    std::vector<double> taps_ms;
    std::vector<double> stops_ms;
    for (int k = 0; k < 7; ++k) {
        touching.push(100 + 3 * k, kAir);
        REQUIRE_FALSE(pad.turns());
        pad.forget();
        const auto tapped = Clock::now();
        touching.push(50, kTouch);
        const auto rumbled = pad.told();
        REQUIRE_FALSE(rumbled.empty());
        CHECK(rumbled.front().low > 3000);
        taps_ms.push_back(ms_between(tapped, rumbled.front().at));
        REQUIRE(pad.turns());
        const auto off = Clock::now();
        touching.push(50, kOff);
        REQUIRE_FALSE(pad.turns());
        stops_ms.push_back(ms_between(off, pad.told().back().at));
    }
    CAPTURE(taps_ms, stops_ms);
    CHECK(middle_of(taps_ms) < 30.0);
    CHECK(middle_of(stops_ms) < 30.0);
}

TEST_CASE("a pad that is pulled out is no error, and it or another is found again", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    Touching touching;
    CHECK(touching.finds(0));
    for (const char* name : {"First", "Second"}) {
        VirtualPad pad(name);
        const FoundPad found{.name = name, .rumbles = true, .has_coils = false};
        CHECK(eventually([&] { return touching.output.info().found == std::vector{found}; }));
        CHECK(touching.rub_until([&] { return pad.turns(); }));
    }
    CHECK(touching.rub_until([&] { return touching.output.info().found.empty(); }));
}

TEST_CASE("the motors stop when pads are switched off, when ticks stay away, and at the end",
          "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    VirtualPad pad("Virtual pad");
    {
        Touching touching;
        REQUIRE(touching.finds(1));
        REQUIRE(touching.rub_until([&] { return pad.turns(); }));
        CHECK(eventually([&] { return !pad.turns(); }));  // no tick comes
        REQUIRE(touching.rub_until([&] { return pad.turns(); }));
        touching.output.choose({}, false, false);
        CHECK(eventually([&] { return !pad.turns(); }));
        CHECK(eventually([&] { return touching.output.info() == PadInfo{}; }));
        pad.forget();
        touching.push(50, kTouch);
        CHECK(pad.told().empty());
        touching.output.choose({}, true, false);
        REQUIRE(touching.finds(1));
        REQUIRE(touching.rub_until([&] { return pad.turns(); }));
    }
    CHECK_FALSE(pad.turns());
}

TEST_CASE("all pads rumble that can, but those whose voice coils move with the sound", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    const VirtualPad coils("DualSense", kDualSense);
    const VirtualPad motors("Other");
    const VirtualPad silent("Still", 0, false);
    Touching touching;
    REQUIRE(touching.finds(3));
    const PadInfo info = touching.output.info();
    CHECK(info.has_coils());
    CHECK(std::count_if(info.found.begin(), info.found.end(),
                        [](const FoundPad& found) { return found.rumbles; }) == 2);
    CHECK(touching.rub_until([&] { return coils.turns() && motors.turns(); }));
    touching.output.choose({}, true, true);
    CHECK(touching.rub_until([&] { return !coils.turns() && motors.turns(); }));
    CHECK(silent.told().empty());
}

TEST_CASE("a pad that hangs holds up neither who touches nor the end", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    const Joysticks joysticks;
    VirtualPad pad("Virtual pad");
    auto touching = std::make_unique<Touching>();
    const std::shared_ptr<TouchSource> source = touching->source;
    REQUIRE(touching->finds(1));
    REQUIRE(touching->rub_until([&] { return pad.turns(); }));
    pad.hang(true);
    touching->push(100, kAir);
    touching->output.choose({}, true, false);
    auto end = std::async(std::launch::async, [&touching] { touching.reset(); });
    CHECK(
        eventually([&end] { return end.wait_for(milliseconds(0)) == std::future_status::ready; }));
    CHECK(source.use_count() > 1);  // its thread still hangs in the pad's driver
    pad.hang(false);
    CHECK(eventually([&] { return source.use_count() == 1; }));
    CHECK_FALSE(pad.turns());
}

TEST_CASE("what is pressed on a pad goes nowhere, and signals are left to the program", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", "disabled:");
    struct sigaction before {};
    REQUIRE(sigaction(SIGINT, nullptr, &before) == 0);
    const Joysticks joysticks;
    const VirtualPad pad("Virtual pad");
    Touching touching;
    REQUIRE(touching.finds(1));
    SDL_Joystick* own = SDL_JoystickOpen(0);
    REQUIRE(own != nullptr);
    for (int k = 0; k < 10; ++k) {
        SDL_JoystickSetVirtualButton(own, 0, static_cast<Uint8>(k % 2));
        SDL_JoystickSetVirtualAxis(own, 0, static_cast<Sint16>(1000 * k));
        touching.push(15, kAir);
    }
    SDL_JoystickClose(own);
    CHECK(eventually([] {
        return SDL_PeepEvents(nullptr, 0, SDL_PEEKEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) == 0;
    }));
    struct sigaction after {};
    REQUIRE(sigaction(SIGINT, nullptr, &after) == 0);
    CHECK(before.sa_handler == after.sa_handler);
}

TEST_CASE("where SDL would copy the process to start a D-Bus, no pad is looked for", "[pads]") {
    const EnvironmentVariable bus("DBUS_SESSION_BUS_ADDRESS", nullptr);
    const EnvironmentVariable runtime("XDG_RUNTIME_DIR", nullptr);
    {
        const EnvironmentVariable display("DISPLAY", nullptr);
        CHECK_FALSE(pads_would_copy_process());  // the D-Bus library starts no bus either
    }
    const EnvironmentVariable display("DISPLAY", ":77");
    CHECK(pads_would_copy_process());
    PadOutput output(std::make_shared<TouchSource>());
    output.choose({}, true, false);
    CHECK(eventually([&] { return output.info().state == PadInfo::State::no_session; }));
    CHECK(SDL_WasInit(SDL_INIT_JOYSTICK) == 0);
}
