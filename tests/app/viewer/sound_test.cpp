// What the real window sounds like: the samples that it gives a sound device, written into a file;
// and machines that have none.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/sound/sound_output.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/sound_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"
#include "tests/support/variable.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.4 ";
constexpr const char* kPress = "mousemove 400 560 sleep 1 mousedown 1 sleep 0.6 ";

std::string drag(int way) {
    std::string commands;
    for (int step = 0; step < 50; ++step)
        commands += "mousemove_relative -- " + std::to_string(way) + " 0 sleep 0.012 ";
    return commands;
}

/// Starts the viewer with a game pad, whose motors write into pad.txt of its folder.
std::vector<std::string> holding_a_pad() {
    return {"env", "LD_PRELOAD=" VIRTUAL_PAD, "VIRTUAL_PAD=pad.txt"};
}

/// What a pad's motors were told.
struct Told {
    int low{0};
    int high{0};
};

std::vector<Told> motors_told(const fs::path& file) {
    std::vector<Told> all;
    std::ifstream lines(file);
    for (Told told; lines >> told.low >> told.high;) all.push_back(told);
    return all;
}

/// A sound server that takes calls and never answers.
class SilentServer {
  public:
    explicit SilentServer(const fs::path& place)
        : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        REQUIRE(place.string().size() < sizeof address.sun_path);
        std::strcpy(address.sun_path, place.c_str());
        REQUIRE(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
        REQUIRE(::listen(socket_, 8) == 0);
    }
    ~SilentServer() { ::close(socket_); }
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;

  private:
    int socket_;
};

}  // namespace

TEST_CASE("what is touched in the window is heard, and nothing once the force is off", "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(folder,
                                       {"--device", "mouse", "--material", "wood", "--pause",
                                        "--record", "hand.dibhr", "--seconds", "30"},
                                       sounding_into_file());
    desk.act(kMeet + std::string(kPress) + drag(2));
    desk.act("key f sleep 0.3 " + drag(-2) + drag(2) + "key q");
    REQUIRE(viewer.wait() == 0);
    const auto rows = read_session(folder / "hand.dibhr");
    const auto samples = samples_of(folder / "sound.raw");
    CHECK(std::all_of(samples.begin(), samples.end(),
                      [](float sample) { return std::abs(sample) <= 1.0F; }));
    const std::vector<bool> heard = heard_tenths(samples);
    const auto first = std::find(heard.begin(), heard.end(), true);
    CHECK(first - heard.begin() >= 5);  // the hand was in the air
    CHECK(std::count(heard.begin(), heard.end(), true) >= 5);
    const auto last = std::find(heard.rbegin(), heard.rend(), true);
    CHECK(last - heard.rbegin() >= 8);
    // In which the hand went on sliding over what it touched.
    REQUIRE(rows.size() > 1000);
    double way_px = 0.0;
    for (auto row = rows.end() - 800; row != rows.end(); ++row) {
        CHECK(row->contact);
        way_px += glm::distance(row->proxy, (row - 1)->proxy);
    }
    CHECK(way_px > 20.0);
}

TEST_CASE("a game pad rumbles with what is touched in the window, muted or not, until force off",
          "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--material", "wood", "--pause", "--mute", "--seconds", "30"},
        holding_a_pad());
    desk.act(kMeet + std::string(kPress) + drag(2));
    const auto touched = motors_told(folder / "pad.txt");
    CHECK(std::any_of(touched.begin(), touched.end(), [](auto told) { return told.low > 0; }));
    CHECK(std::any_of(touched.begin(), touched.end(), [](auto told) { return told.high > 0; }));
    desk.act("key f sleep 0.3");
    const auto stopped = motors_told(folder / "pad.txt");
    REQUIRE_FALSE(stopped.empty());
    CHECK(stopped.back().low + stopped.back().high == 0);
    desk.act(drag(-2) + "sleep 0.1");
    CHECK(motors_told(folder / "pad.txt").size() == stopped.size());
    desk.act("key f sleep 1 " + drag(2) + "key q");
    CHECK(viewer.wait() == 0);
    const auto at_the_end = motors_told(folder / "pad.txt");
    CHECK(at_the_end.size() > stopped.size());
    CHECK(at_the_end.back().low + at_the_end.back().high == 0);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("with --game-pad off no pad is touched, and the word is not kept", "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--pause", "--game-pad", "off", "--seconds", "30"},
        holding_a_pad());
    desk.act(kMeet + std::string(kPress) + drag(2) + "key q");
    CHECK(viewer.wait() == 0);
    CHECK_FALSE(fs::exists(folder / "pad.txt"));
    CHECK_FALSE(contains(read_text(folder / "config/dibhr/settings.toml"), "game-pad = false"));
}

TEST_CASE("a window that is muted opens no sound device until its key is pressed", "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--mute", "--seconds", "30", "--size", "640x480"},
        sounding_into_file());
    desk.act(kMeet + std::string("sleep 1"));
    CHECK_FALSE(fs::exists(folder / "sound.raw"));
    CHECK(read_text(folder / "errors.txt").empty());
    desk.act("key u sleep 1");
    CHECK(fs::exists(folder / "sound.raw"));
    desk.act("key u sleep 1");
    const auto size = fs::file_size(folder / "sound.raw");
    desk.act("sleep 0.3");
    CHECK(fs::file_size(folder / "sound.raw") == size);
    desk.act("key q");
    CHECK(viewer.wait() == 0);
    // The command line's word is not kept.
    CHECK_FALSE(contains(read_text(folder / "config/dibhr/settings.toml"), "mute = true"));
}

TEST_CASE("without a sound device the window goes on and says nothing on stderr", "[sound]") {
    const auto missing =
        GENERATE(std::vector<std::string>{"env", "SDL_AUDIODRIVER=nonsense"},
                 std::vector<std::string>{"env", "SDL_AUDIODRIVER=alsa", "AUDIODEV=nonsense"});
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(
        folder,
        {"--device", "mouse", "--record", "hand.dibhr", "--seconds", "3", "--size", "640x480"},
        missing);
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(read_session(folder / "hand.dibhr").size() > 1000);
}

TEST_CASE("a sound server that never answers holds up neither the window nor its end", "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    const SilentServer server(folder / "pulse");
    Process viewer = desk.start_viewer(
        folder,
        {"--device", "mouse", "--record", "hand.dibhr", "--seconds", "3", "--size", "640x480"},
        {"timeout", "20", "env", "SDL_AUDIODRIVER=pulseaudio",
         "PULSE_SERVER=unix:" + (folder / "pulse").string()});
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(read_session(folder / "hand.dibhr").size() > 1000);
}

TEST_CASE("a sound device is opened when it is wanted, and that there is none is told", "[sound]") {
    using State = SoundOutput::State;
    constexpr SoundOutput::Wish kHeard{.speaker = true};
    SECTION("a device that plays") {
        const Variable driver("SDL_AUDIODRIVER", "dummy");
        SoundOutput output(std::make_shared<TouchSource>());
        CHECK(output.state() == State::quiet);
        for (int k = 0; k < 3; ++k) {
            output.choose({}, kHeard);
            CHECK(eventually([&] { return output.state() == State::playing; }));
            CHECK_FALSE(output.moves_coils());
            output.choose({}, {});
            CHECK(eventually([&] { return output.state() == State::quiet; }));
        }
    }
    SECTION("a pad with voice coils that shows no sound device") {
        const Variable driver("SDL_AUDIODRIVER", "dummy");
        SoundOutput output(std::make_shared<TouchSource>());
        output.choose({}, {.speaker = true, .coils = true});
        CHECK(eventually([&] { return output.state() == State::playing; }));
        CHECK_FALSE(output.moves_coils());
    }
    SECTION("none") {
        const Variable driver("SDL_AUDIODRIVER", "nonsense");
        SoundOutput output(std::make_shared<TouchSource>());
        output.choose({}, kHeard);
        CHECK(eventually([&] { return output.state() == State::no_device; }));
        output.choose({}, {});
        CHECK(eventually([&] { return output.state() == State::quiet; }));
    }
}
