// Force Dimension's library: which one is used, and records of its calls.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "device/forcedimension/record.hpp"
#include "device/forcedimension/survey.hpp"
#include "tests/device/forcedimension/arm_bench.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::forcedimension;
using test::let_pass;
using test::TemporaryFolder;
namespace fs = std::filesystem;

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("versions before 3.16 are refused by name", "[forcedimension]") {
    Page& page = page_with_omega();
    const auto [minor, usable] = GENERATE(table<int, bool>({{2, false}, {15, false}, {16, true}}));
    page.version[1] = minor;
    const FoundCalls found = load_calls(kDrd);
    CHECK((found.calls != nullptr) == usable);
    if (!usable) {
        CHECK(found.trouble == kDrd + " is version 3." + std::to_string(minor) +
                                   ".6, which is too old: install Force Dimension's SDK 3.16 or "
                                   "newer");
    }
}

TEST_CASE("the library is found in the SDK's folder, and libdrd is preferred to libdhd",
          "[forcedimension]") {
    const TemporaryFolder folder;
    const fs::path release = folder / "lib/release/lin-x86_64-gcc";
    fs::create_directories(release);
    fs::copy_file(kDhd, release / "libdhd.so.3.17.6");
    const FoundCalls dhd = load_calls(folder.path().string());
    REQUIRE(dhd.calls != nullptr);
    CHECK(dhd.calls->by_hand_only());
    fs::copy_file(kDrd, release / "libdrd.so.3.17.6");
    setenv("FDSDK", folder.path().c_str(), 1);
    const FoundCalls drd = load_calls({});
    unsetenv("FDSDK");
    REQUIRE(drd.calls != nullptr);
    CHECK_FALSE(drd.calls->by_hand_only());
    CHECK(drd.calls->file() == (release / "libdrd.so.3.17.6").string());
}

TEST_CASE("without a library there is no thread, and the mouse touches", "[forcedimension]") {
    ConnectionOptions options;
    options.usb_devices = "/nowhere";
    ForceDimensionDevice device(options, {});
    CHECK(device.state().absent);
    CHECK_FALSE(device.state().trouble);
    CHECK(device.state().sentence.empty());
    ForceDimensionDevice refused(options, {nullptr, "libdrd.so.3 is damaged: install it again"});
    CHECK(refused.state().absent);
    CHECK(refused.state().trouble);
    CHECK(refused.state().sentence == "libdrd.so.3 is damaged: install it again");
}

TEST_CASE("a record of an arm's calls plays as that arm", "[forcedimension]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "record.txt").string();
    {
        Page& page = page_with_omega();
        page.units[0].position_m[1] = 0.004;
        const auto options = options_for();
        ForceDimensionDevice device(
            options,
            {std::make_shared<RecordedCalls>(load_calls(options.library).calls, file), {}});
        let_pass(milliseconds(1000));
        page.units[0].position_m[1] = 0.005;
        let_pass(milliseconds(1000));
        page.units[0].force_on = false;
        page.units[0].cause = 1;
        let_pass(milliseconds(200));
        CHECK(device.status().stage == Stage::force_off);
    }
    REQUIRE(is_record(file));
    const ConnectionOptions options = options_for(file);
    test::TickingDevice<ForceDimensionDevice> loop(options, load_calls(file));
    REQUIRE(loop.tick_until_ready());
    CHECK(loop.device.status().serial == "1234");
    const Vec3 before = loop.reading.goal_in_grid;
    REQUIRE(loop.tick_until([&] { return loop.reading.goal_in_grid.x > before.x + 1.0; }));
    CHECK_THAT((loop.reading.goal_in_grid.x - before.x) * loop.kPitch_mm,
               Catch::Matchers::WithinAbs(1.0, 1e-9));
    CHECK(loop.tick_until([&] { return loop.device.status().stage == Stage::force_off; }));
    CHECK(says(loop.device.status().sentence, "force button was pressed"));
}

TEST_CASE("a record that is damaged is refused with the number of the line", "[forcedimension]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "record.txt";
    const std::string line = GENERATE(as<std::string>{}, "1 2 dhdNothing - = 1", "1 2 dhdStop 0",
                                      "x 2 dhdStop 0 = 1", "1 2 dhdGetPosition 0 = 0 1 2", "");
    std::ofstream(file) << "dibhr forcedimension record 1\n1 2 dhdStop 0 = 0\n" << line << '\n';
    const FoundCalls found = load_calls(file.string());
    CHECK(found.calls == nullptr);
    CHECK(says(found.trouble, "line 3"));
}
