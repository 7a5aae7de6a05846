// Prints the table of core/haptics/README.md, Stability: closed_loop [--quick]. With --devices, how
// stable each kind of device is as its driver states it. With --worst, what the worst updates take
// that a search finds, with nothing of the image in a cache.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "device/force_devices.hpp"
#include "tests/bench/closed_loop.hpp"
#include "tests/core/haptics/worst_update.hpp"

namespace {

using dibhr::bench::ClosedLoop;
using dibhr::bench::Grip;
using dibhr::bench::kGrips;
using dibhr::bench::kTimesFriction;
using dibhr::bench::kTimesMass;
using dibhr::bench::on_device;
using dibhr::bench::oscillates;
using dibhr::bench::run;

/// Runs `use` for each mass and friction.
template <typename Use>
void for_each_device(ClosedLoop loop, const Use& use) {
    for (const double mass : dibhr::bench::kMasses_kg) {
        for (const double friction : dibhr::bench::kFrictions_newton_s_per_m) {
            loop.mass_kg = mass;
            loop.friction_newton_s_per_m = friction;
            use(loop);
        }
    }
}

void print_lowest(const char* name, ClosedLoop loop) {
    std::printf("%-32s", name);
    for (const Grip& grip : kGrips) {
        // A hand that nothing holds goes where the surface goes.
        if (loop.slide_mm_per_s != 0.0 && !(grip.spring_newton_per_m > 0.0)) continue;
        loop.grip = grip;
        double least = 1e9;
        double most = 0.0;
        for_each_device(loop, [&](const ClosedLoop& each) {
            const double found = dibhr::bench::lowest_oscillating(each);
            least = std::min(least, found);
            most = std::max(most, found);
        });
        std::printf("  %s %5.2f to %5.2f", grip.name, least, most);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void print_rest(const char* name, ClosedLoop loop) {
    std::printf("%-32s", name);
    for (const double stiffness : {0.5, 1.0}) {
        double swing = 0.0;
        double buzz = 0.0;
        loop.parameters.coupling.stiffness_newton_per_mm = stiffness;
        for (const double press : {0.53, 1.0, 1.47}) {
            for (const Grip& grip : kGrips) {
                loop.grip = grip;
                loop.press_newton = press;
                for_each_device(loop, [&](const ClosedLoop& each) {
                    const auto result = run(each);
                    swing = std::max(swing, result.swing_mm);
                    buzz = std::max(buzz, result.buzz_newton);
                });
            }
        }
        std::printf("  at %.1f N/mm: swing %.3f mm, buzz %.4f N", stiffness, swing, buzz);
    }
    std::printf("\n");
    std::fflush(stdout);
}

double sine(double amplitude_mm, double hertz, double t_s) {
    return amplitude_mm / 2.0 * std::sin(2.0 * std::numbers::pi * hertz * t_s);
}

void print_moving(const char* name, ClosedLoop loop) {
    std::printf("%-32s", name);
    loop.tap_newton_s = 0.0;
    loop.seconds = 14.0;
    for (const Grip& grip : kGrips) {
        loop.grip = grip;
        loop.surface_mm = [](double t_s) { return sine(5.0, 0.25, t_s); };
        const auto chest = run(loop);
        loop.surface_mm = [](double t_s) { return sine(5.0, 3.0, t_s); };
        const auto wave = run(loop);
        ClosedLoop flickering = loop;
        flickering.parameters.coupling.stiffness_newton_per_mm = 1.0;
        flickering.surface_mm = [](double t_s) {
            return std::lround(t_s * 30.0) % 2 == 0 ? -0.5 : 0.5;
        };
        const auto flicker = run(flickering);
        flickering.surface_mm = [](double t_s) {
            return std::lround(std::floor(15.0 * t_s)) % 2 == 0 ? -10.0 : 10.0;
        };
        const auto jumps = run(flickering);
        std::printf(
            "  %s: chest %.2f mm, %.2f mW; 3 Hz %.2f mm, %.2f mW; flicker %.2f mm, %.2f mW, %.2f "
            "N; "
            "20 mm at 7.5 Hz %.1f mm, %.1f mW |",
            grip.name, chest.travel_mm, chest.work_mw, wave.travel_mm, wave.work_mw,
            flicker.travel_mm, flicker.work_mw, flicker.buzz_newton, jumps.travel_mm,
            jumps.work_mw);
    }
    std::printf("\n");
    std::fflush(stdout);
}

/// Least of some repeats, as others use the machine meanwhile [us].
double time_of(const dibhr::test::Jump& jump, dibhr::ProxyAlgorithm& algorithm,
               const dibhr::DepthSurface& surface, std::vector<std::uint8_t>& caches) {
    using Clock = std::chrono::steady_clock;
    constexpr int kRepeats = 15;
    double least_us = 1e9;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        jump.press(algorithm, surface);
        for (std::uint8_t& byte : caches) ++byte;
        const auto begin = Clock::now();
        static_cast<void>(algorithm.update(surface, jump.to, jump.friction));
        const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
        least_us = std::min(least_us, took.count());
    }
    return least_us;
}

/// Over twenty surfaces of 1920 x 1080, by each algorithm.
void print_worst() {
    constexpr int kTries = 400;
    constexpr int kSurfaces = 20;
    constexpr std::size_t kMoreThanCaches = 128U << 20U;
    std::vector<std::uint8_t> caches(kMoreThanCaches);
    using dibhr::Algorithm;
    for (const Algorithm which :
         {Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood, Algorithm::god_object}) {
        const auto algorithm = dibhr::make_algorithm(which);
        dibhr::test::Dice dice(5);
        double most_us = 0.0;
        int at = 0;
        dibhr::Proxy proxy;
        for (int number = 0; number < kSurfaces; ++number) {
            const auto image = dibhr::test::generated_surface(number, 1920, 1080);
            const dibhr::DepthSurface surface(image, image, 0.0, {});
            const auto jump = dibhr::test::worst_jump(*algorithm, surface, dice, kTries);
            const double took_us = time_of(jump, *algorithm, surface, caches);
            if (took_us <= most_us) continue;
            most_us = took_us;
            at = number;
            proxy = jump.made(*algorithm, surface);
        }
        std::printf("%-14s worst %.0f us, on surface %d: %d moves, %d reads\n",
                    dibhr::name_of(which), most_us, at, proxy.moves, proxy.reads);
        std::fflush(stdout);
    }
}

/// The lowest stiffness from the asked one on at which this hand swings, held by nothing; `most`
/// when none does.
double swings_from(ClosedLoop loop, double most) {
    loop.stated->max_stiffness_newton_per_mm = most;
    double& stiffness = loop.parameters.coupling.stiffness_newton_per_mm;
    while (stiffness < most && !oscillates(run(loop))) stiffness *= 1.12;
    return std::min(stiffness, most);
}

/// Of each kind of device, as its driver states it: the margin, and how the 27 hands swing.
void print_devices() {
    for (const dibhr::ForceDeviceKind* const kind : dibhr::force_device_kinds()) {
        const dibhr::DeviceLimits stated = kind->make_settings()->limits();
        for (const double asked : {0.5, 1.0}) {
            double swing_mm = 0.0;
            double buzz_newton = 0.0;
            double lowest = 12.0;
            for (const Grip& grip : kGrips) {
                for (const double mass : kTimesMass) {
                    for (const double friction : kTimesFriction) {
                        const ClosedLoop loop = on_device(stated, asked, grip, mass, friction);
                        const auto result = run(loop);
                        swing_mm = std::max(swing_mm, result.swing_mm);
                        buzz_newton = std::max(buzz_newton, result.buzz_newton);
                        lowest = std::min(lowest, swings_from(loop, lowest));
                    }
                }
            }
            const dibhr::Coupling held =
                dibhr::held_coupling({.stiffness_newton_per_mm = asked}, stated);
            const dibhr::Coupling stable =
                dibhr::stable_coupling(held, held.stiffness_newton_per_mm, stated.dynamics);
            std::printf(
                "%-15s asked %.1f held %.2f N/mm, damping %.2f, margin %.2f N s/m; swing at most "
                "%.3f mm, buzz %.3f N; swings from %.2f N/mm on\n",
                kind->name, asked, stable.stiffness_newton_per_mm, stable.damping_newton_s_per_m,
                dibhr::stability_margin(stable, stated.dynamics), swing_mm, buzz_newton, lowest);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    if (count > 1 && std::string(words[1]) == "--worst") {
        print_worst();
        return 0;
    }
    if (count > 1 && std::string(words[1]) == "--devices") {
        print_devices();
        return 0;
    }
    const bool quick = count > 1 && std::string(words[1]) == "--quick";
    ClosedLoop plain;
    ClosedLoop watched;
    watched.stability = true;
    watched.damping = false;
    ClosedLoop stable;
    stable.stability = true;
    print_rest("as in 0.1", plain);
    print_rest("watched, no damping", watched);
    print_rest("default", stable);
    print_moving("as in 0.1", plain);
    print_moving("default", stable);
    if (quick) return 0;
    print_lowest("as in 0.1", plain);
    print_lowest("watched, no damping", watched);
    print_lowest("default", stable);
    watched.slide_mm_per_s = stable.slide_mm_per_s = 56.0;
    print_lowest("sliding away, no damping", watched);
    print_lowest("sliding away, default", stable);
}
