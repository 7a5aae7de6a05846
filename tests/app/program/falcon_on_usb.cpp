// Words to and from a simulated Falcon.
#include "tests/app/program/falcon_on_usb.hpp"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/device/falcon/line_socket.hpp"
#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

namespace dibhr::test {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLongestAnswer{60};  // only reached by a failure

std::string ask(const std::string& socket, const std::string& command) {
    const auto end = Clock::now() + kLongestAnswer;
    return falcon::ask_line(socket, command, [end] { return Clock::now() < end; });
}

}  // namespace

void write_firmware(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> image = synthetic_firmware();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.data()),
               static_cast<std::streamsize>(image.size()));
}

FalconOnUsb::FalconOnUsb(const std::filesystem::path& folder, std::vector<std::string> commands,
                         bool keeps_packets)
    : socket_((folder / "falcon").string()),
      packets_(folder / "packets.csv"),
      commands_(std::move(commands)),
      keeps_packets_(keeps_packets) {}

std::vector<std::string> FalconOnUsb::host() const {
    std::vector<std::string> words{FALCON_HOST, "--socket", socket_};
    if (keeps_packets_) words.insert(words.end(), {"--packets", packets_.string()});
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

void FalconOnUsb::wait_for_more(const std::string& counter, double count) const {
    const double wanted = number(counter) + count;
    INFO(counter << " up to " << wanted);
    wait_until([&] { return number(counter) >= wanted; });
}

void FalconOnUsb::wait_for_forces(double count) const {
    wait_for_more("with_force", count);
}

void FalconOnUsb::wait_for_commands(double count) const {
    wait_for_more("commands", count);
}

void FalconOnUsb::wait_for_zeros(double count) const {
    wait_until([this, count] { return number("zeros_in_a_row") >= count; });
}

void FalconOnUsb::wait_until(const std::function<bool()>& is_so) {
    REQUIRE(eventually(is_so, kLongestAnswer));
}

}  // namespace dibhr::test
