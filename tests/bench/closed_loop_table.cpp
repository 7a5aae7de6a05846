// Prints the table of core/haptics/README.md, Stability: closed_loop [--quick]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "tests/bench/closed_loop.hpp"

namespace {

using dibhr::bench::ClosedLoop;
using dibhr::bench::Grip;
using dibhr::bench::kGrips;
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

}  // namespace

int main(int count, char** words) {
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
