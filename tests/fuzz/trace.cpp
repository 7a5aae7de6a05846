// A hand's trace: what is read becomes a motion of finite places and pressures.
#include <cmath>

#include "core/experiment/hand_motion.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

namespace {

void require_finite(const HandMotion& motion, std::size_t updates) {
    constexpr double kRoundOff = 1e-9;
    test::require_rule(motion.places.size() == updates && motion.penetrations_px.size() == updates,
                       "a motion has a place and a pressure for every update");
    for (std::size_t k = 0; k < updates; ++k) {
        test::require_rule(std::isfinite(motion.places[k].x) && std::isfinite(motion.places[k].y),
                           "a place is finite");
        const double penetration_px = motion.penetrations_px[k];
        test::require_rule(
            penetration_px >= -kLifted_px - kRoundOff && penetration_px <= 25.0 + kRoundOff,
            "a pressure is between a lifted pen's and the full one");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("trace.csv");
    const auto& path = file.with({data, size});
    (void)test::is_taken([&path] {
        constexpr std::size_t kUpdates = 500;
        HandMotion motion = motion_of_trace(read_trace(path), "a trace", kUpdates);
        require_finite(motion, kUpdates);
        fit_into(motion, {{40.0, 30.0}, {30.0, 20.0}});
        require_finite(motion, kUpdates);
    });
    return 0;
}
