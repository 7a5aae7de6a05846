// What the real window sounds like: the samples that it gives a sound device, written into a file;
// and machines that have none.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "app/sound/sound_output.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/sound_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

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

/// Sets a variable of the environment for a while.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
    ~Variable() { ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
};

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
    SECTION("a device that plays") {
        const Variable driver("SDL_AUDIODRIVER", "dummy");
        SoundOutput output;
        CHECK(output.state() == State::quiet);
        for (int k = 0; k < 3; ++k) {
            output.choose({}, false);
            CHECK(eventually([&] { return output.state() == State::playing; }));
            output.ticks().push({});
            CHECK(eventually([&] { return output.ticks().size() == 0; }));
            output.choose({}, true);
            CHECK(eventually([&] { return output.state() == State::quiet; }));
        }
    }
    SECTION("none") {
        const Variable driver("SDL_AUDIODRIVER", "nonsense");
        SoundOutput output;
        output.choose({}, false);
        CHECK(eventually([&] { return output.state() == State::no_device; }));
        output.choose({}, true);
        CHECK(eventually([&] { return output.state() == State::quiet; }));
    }
}
