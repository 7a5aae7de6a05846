// Words to and from a simulated Falcon.
#include "tests/app/program/falcon_on_usb.hpp"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/device/falcon/line_socket.hpp"
#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPatience = 15s;  // of a busy machine

std::string ask(const std::string& socket, const std::string& command) {
    const auto end = Clock::now() + kPatience;
    return falcon::ask_line(socket, command, [end] { return Clock::now() < end; });
}

}  // namespace

void write_firmware(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> image = synthetic_firmware();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.data()),
               static_cast<std::streamsize>(image.size()));
}

FalconOnUsb::FalconOnUsb(const std::filesystem::path& folder, std::vector<std::string> commands)
    : socket_((folder / "falcon").string()),
      packets_(folder / "packets.csv"),
      commands_(std::move(commands)) {}

std::vector<std::string> FalconOnUsb::host() const {
    std::vector<std::string> words{FALCON_HOST, "--socket", socket_, "--packets", packets_};
    for (const std::string& command : commands_) words.insert(words.end(), {"--command", command});
    words.emplace_back("--");
    return words;
}

bool FalconOnUsb::try_to_tell(const std::string& command) const {
    return ask(socket_, command) == "ok";
}

void FalconOnUsb::tell(const std::string& command) const {
    INFO(command);
    REQUIRE(ask(socket_, command) == "ok");
}

std::string FalconOnUsb::state() const {
    return ask(socket_, "state");
}

double FalconOnUsb::number(const std::string& name) const {
    return vector(name).x;
}

Vec3 FalconOnUsb::vector(const std::string& name) const {
    const std::string told = state();
    INFO(told);
    std::istringstream words(told);
    for (std::string word; words >> word;) {
        if (word != name) continue;
        Vec3 value{0.0};
        REQUIRE(words >> value.x);
        words >> value.y >> value.z;
        return value;
    }
    FAIL("its state says nothing of " + name);
    return Vec3{0.0};
}

void FalconOnUsb::move_hand(Vec3 to_mm, double seconds) const {
    std::ostringstream command;
    command << "hand " << to_mm.x << ' ' << to_mm.y << ' ' << to_mm.z << ' ' << seconds;
    tell(command.str());
    wait_until([this] { return number("arrived") > 0.5; });
}

void FalconOnUsb::home() const {
    wait_until([this] { return number("homing") > 0.5; });
    move_hand({0.0, 0.0, 172.0}, 0.3);
    move_hand({0.0, 0.0, 80.0}, 0.3);
    wait_until([this] { return number("homed") > 6.5; });
}

void FalconOnUsb::wait_until(const std::function<bool()>& is_so) {
    const auto end = Clock::now() + kPatience;
    while (!is_so()) {
        REQUIRE(Clock::now() < end);
        std::this_thread::sleep_for(5ms);
    }
}

}  // namespace dibhr::test
