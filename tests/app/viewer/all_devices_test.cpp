// A device of each kind is attached at once: one touches, as chosen, and no other one is pushed.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "device/inverse3/simulated/service.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/app/program/stand_in_arm.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace service = dibhr::inverse3::simulated;

/// A Falcon and an Inverse3 that are simulated, both stand-ins, and a mouse. Every hand is in the
/// relief.
class AllDevices {
  public:
    AllDevices() {
        write_firmware(folder / "firmware.bin");
        std::ofstream(folder / "config/dibhr/settings.toml", std::ios::app)
            << "[window]\npanels-visible = false\n[inverse3]\nport = " << inverse3.port()
            << "\nolder-port = " << inverse3.older_port() << '\n';
        omega->place(0.0, -10.0);
        touch->place(0.0, -10.0);
        inverse3.with([](service::Scene& scene) { scene.arms[0].position_m.y += 0.01; });
    }

    /// The strongest force that the motors were given, once the program has ended.
    [[nodiscard]] double strongest(const std::string& kind) const {
        if (kind == "forcedimension") return omega->strongest_newton();
        if (kind == "openhaptics") return touch->strongest_newton();
        double most = 0.0;
        for (const service::ReceivedMessage& one : inverse3.received())
            most = std::max(most, glm::length(one.force_newton));
        return most;
    }

    const Desk desk{};
    const TemporaryFolder folder{};
    const FalconOnUsb falcon{folder.path(), {"firmware", "home", "place 0 0 105"}};
    const std::unique_ptr<StandInArm> omega{make_stand_in("forcedimension", folder)};
    const std::unique_ptr<StandInArm> touch{make_stand_in("openhaptics", folder)};
    service::Service inverse3{service::Scene{}};
};

}  // namespace

TEST_CASE("of all kinds of devices at once, the chosen one touches, and no other one is pushed",
          "[makers_library][window]") {
    const std::string chosen = GENERATE(as<std::string>{}, "falcon", "inverse3", "forcedimension",
                                        "openhaptics", "mouse", "auto");
    CAPTURE(chosen);
    const AllDevices all;
    WindowProgram viewer = all.desk.start_viewer(
        all.folder,
        {"--device", chosen, "--firmware", "firmware.bin", "--pause", "--size", "320x240"},
        all.falcon.host());
    viewer.wait_for_surface();
    if (chosen == "mouse") viewer.act("mousemove 160 120 mousedown 1");
    viewer.wait_until([&](const Seen& now) {
        return now.sent_newton > 0.1 && (chosen == "mouse" || !now.mouse_fallback);
    });
    // The simulated Falcon ends with the program.
    const double falcon_forces = all.falcon.number("with_force");
    all.desk.press("key q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(all.folder / "errors.txt").empty());
    int pushed = 0;
    for (const char* const kind : {"falcon", "inverse3", "forcedimension", "openhaptics"}) {
        CAPTURE(kind);
        const bool falcon = kind == std::string("falcon");
        const double newton = falcon ? falcon_forces : all.strongest(kind);
        if (newton > 0.0) ++pushed;
        if (chosen != "auto") CHECK((newton > 0.0) == (chosen == kind));
    }
    CHECK(pushed == (chosen == "mouse" ? 0 : 1));
    CHECK(all.omega->wrong_calls() == 0);
    CHECK(all.touch->wrong_calls() == 0);
    CHECK_FALSE(all.omega->is_open());
    CHECK_FALSE(all.touch->is_open());
}
