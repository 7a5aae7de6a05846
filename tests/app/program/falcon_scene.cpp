// The program on its display, its Falcon on its bus.
#include "tests/app/program/falcon_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <utility>

#include "tests/app/program/command_program.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

using Words = std::vector<std::string>;

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.1 ";

/// What the program is started with; its firmware and its settings file are written first.
Words prepared(const TemporaryFolder& folder, Words arguments, const std::string& settings) {
    write_firmware(folder / "firmware.bin");
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", settings);
    arguments.insert(arguments.end(),
                     {"--firmware", "firmware.bin", "--record", "hand.dibhr", "--seconds", "60"});
    return arguments;
}

Words host_in(Words environment, const Words& host) {
    environment.insert(environment.begin(), "env");
    environment.insert(environment.end(), host.begin(), host.end());
    return environment;
}

}  // namespace

FalconScene::FalconScene(Words commands, Words arguments, const std::string& settings,
                         Words environment)
    : falcon(folder.path(), std::move(commands)),
      viewer(desk.start_viewer(folder, prepared(folder, std::move(arguments), settings),
                               host_in(std::move(environment), falcon.host()))) {
    desk.act(kMeet);
}

std::vector<Row> FalconScene::finish() {
    desk.act(std::string(kMeet) + "key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(errors().empty());
    return read_session(folder / "hand.dibhr");
}

void FalconScene::press_in() const {
    desk.act("key space");
    falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    wait_for_force();
}

void FalconScene::wait_for_force() const {
    FalconOnUsb::wait_until([this] { return falcon.vector("motor_newton").z > 0.5; });
}

void FalconScene::wait_for_lasting_zero() const {
    using std::chrono::steady_clock;
    steady_clock::time_point last_force = steady_clock::now();
    FalconOnUsb::wait_until([&] {
        if (glm::length(falcon.vector("motor_newton")) > 1e-6) last_force = steady_clock::now();
        return steady_clock::now() - last_force > std::chrono::seconds(1);
    });
}

double FalconScene::seconds_to_zero(std::chrono::steady_clock::time_point moment) const {
    constexpr std::ptrdiff_t kCalm = 5;  // packets: they have stayed without
    const double from_s = std::chrono::duration<double>(moment.time_since_epoch()).count();
    double zero_s = 0.0;
    FalconOnUsb::wait_until([&] {
        const auto packets = test::falcon::packets_after(falcon.packets(), from_s);
        const auto last_force = std::find_if(packets.rbegin(), packets.rend(),
                                             [](const auto& packet) { return packet.has_force(); });
        const auto zero = last_force.base();
        if (packets.end() - zero < kCalm) return false;
        zero_s = zero->t_s;
        return true;
    });
    return zero_s - from_s;
}

std::string FalconScene::errors() const {
    return read_text(folder / "errors.txt");
}

}  // namespace dibhr::test
