// A record of a maker's library: it is refused in one line, or answers every call that a driver
// makes.
#include <array>
#include <string>
#include <vector>

#include "device/forcedimension/library.hpp"
#include "device/forcedimension/record.hpp"
#include "device/openhaptics/faults.hpp"
#include "device/openhaptics/record.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

namespace {

void call_all(forcedimension::Calls& calls) {
    for (std::size_t k = 0; k < forcedimension::kFunctions.size(); ++k) {
        const forcedimension::FunctionShape& shape = forcedimension::kFunctions[k];
        const std::vector<double> given(shape.given);
        std::vector<double> answered(shape.answered);
        (void)calls.call(static_cast<forcedimension::Function>(k), 0, given, answered);
    }
}

void ask_all(forcedimension::Library& library) {
    test::require_one_line(library.version());
    const auto serial = library.serial(0);
    test::require_rule(!serial || (*serial >= 0 && *serial <= 65535), "a serial has 16 bits");
    const auto position = library.position_m(0);
    test::require_rule(!position || is_finite(*position), "a position is finite");
    (void)library.status(0);
    test::require_rule(library.buttons(0) < 16, "there are four buttons");
}

void ask_all(const openhaptics::HdLibrary& library) {
    using namespace openhaptics;
    (void)library.init_device(nullptr);
    library.begin_frame(0);
    std::array<double, 6> numbers{};
    for (const HdEnum what : {kHdPosition, kHdVelocity, kHdGimbalAngles, kHdUsableWorkspace,
                              kHdMaxForce, kHdContinuousForce, kHdMotorTemperature})
        library.get_doubles(what, numbers.data());
    std::array<long, 6> encoders{};
    library.get_longs(kHdEncoders, encoders.data());
    int buttons = 0;
    library.get_integers(kHdButtons, &buttons);
    std::uint8_t inkwell = 0;
    library.get_booleans(kHdInkwellSwitch, &inkwell);
    for (const HdEnum what : {kHdVersion, kHdModel, kHdDriverVersion, kHdSerial})
        (void)library.get_string(what);
    (void)library.check_calibration();
    library.end_frame(0);
    (void)take_faults(library);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("record.txt");
    const auto& path = file.with({data, size});
    const forcedimension::FoundCalls calls = forcedimension::play_record(path);
    if (calls.calls == nullptr) test::require_one_line(calls.trouble);
    if (calls.calls != nullptr) {
        call_all(*calls.calls);
        forcedimension::Library library(calls.calls);
        ask_all(library);
    }
    const openhaptics::LoadedLibrary touch = openhaptics::play_record(path);
    if (!touch.loaded) test::require_one_line(touch.trouble);
    if (touch.loaded) ask_all(touch.functions);
    return 0;
}
