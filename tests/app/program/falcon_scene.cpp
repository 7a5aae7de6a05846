// The program on its display, its Falcon on its bus.
#include "tests/app/program/falcon_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

using Words = std::vector<std::string>;

/// What the program is started with; the files that it needs are written first.
Words prepared(const TemporaryFolder& folder, const FalconSceneOptions& options) {
    write_firmware(folder / "firmware.bin");
    for (const char* const name : {kSlope, "slope_depth.png"})
        write_depth_png(folder / name, 64, 48, 64, 2);
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", options.settings);
    std::filesystem::create_directories(folder / "state/dibhr");
    write_text(folder / "state/dibhr/agreed", options.agreed);
    Words arguments{"--device", options.device, "--size", "320x240", "--firmware", "firmware.bin"};
    if (options.records) arguments.insert(arguments.end(), {"--record", "hand.dibhr"});
    arguments.insert(arguments.end(), options.arguments.begin(), options.arguments.end());
    return arguments;
}

Words host_in(Words host, const Words& bus) {
    host.insert(host.end(), bus.begin(), bus.end());
    return host;
}

}  // namespace

FalconScene::FalconScene(FalconSceneOptions options)
    : desk(options.desk),
      falcon(folder.path(), options.commands, options.keeps_packets),
      viewer(desk.start_viewer(folder, prepared(folder, options),
                               host_in(options.host, falcon.host()))) {
    viewer.wait_for_surface();
}

std::vector<Row> FalconScene::finish() {
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(errors().empty());
    return rows();
}

std::vector<Row> FalconScene::rows() const {
    return read_session(folder / "hand.dibhr");
}

void FalconScene::wait_until_recorded(
    const std::function<bool(const std::vector<Row>&)>& is_so) const {
    std::uint64_t known = 0;
    bool so = false;
    viewer.wait_until([&](const Seen& now) {
        if (!so && now.recorded_rows > known) {
            known = now.recorded_rows;
            so = is_so(rows());
        }
        return so;
    });
}

void FalconScene::press_in() const {
    falcon.move_hand({0.0, 0.0, 105.0}, 0.2);
    wait_for_force();
}

void FalconScene::wait_for_force() const {
    FalconOnUsb::wait_until([this] { return falcon.vector("motor_newton").z > 0.6; });
}

void FalconScene::check_left_without_force() const {
    constexpr int kLastPackets = 5;
    const auto packets = falcon::read_packets(falcon.packets());
    const auto last_force = std::find_if(packets.rbegin(), packets.rend(),
                                         [](const auto& packet) { return packet.has_force(); });
    REQUIRE(last_force != packets.rend());
    CHECK(last_force - packets.rbegin() >= kLastPackets);
}

double FalconScene::seconds_to_zero(std::chrono::steady_clock::time_point moment) const {
    const double from_s = std::chrono::duration<double>(moment.time_since_epoch()).count();
    const auto packets = falcon::packets_after(falcon.packets(), from_s);
    const auto last_force = std::find_if(packets.rbegin(), packets.rend(),
                                         [](const auto& packet) { return packet.has_force(); });
    const auto zero = last_force.base();
    REQUIRE(zero != packets.end());
    return zero->t_s - from_s;
}

std::string FalconScene::errors() const {
    return read_text(folder / "errors.txt");
}

}  // namespace dibhr::test
