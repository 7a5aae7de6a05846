// The sound of the real window: the samples for a sound device, written into a file; and machines
// without one.
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

using State = SoundOutput::State;
using Words = std::vector<std::string>;

constexpr const char* kPress = "mousemove 250 336 mousedown 1";
constexpr std::size_t kTenth = 4800;  // samples

/// The fixture: a folder whose settings hide the panels.
Words small_window(const TemporaryFolder& folder, Words arguments) {
    fs::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", "[window]\npanels-visible = false\n");
    arguments.insert(arguments.end(), {"--device", "mouse", "--size", "640x480"});
    return arguments;
}

/// Drags to and fro over the surface until the condition holds.
template <typename Condition>
bool rub_until(const WindowProgram& viewer, const Condition& is_so) {
    return eventually([&] {
        for (const char* const way : {"40 0", "40 0", "-40 0", "-40 0"})
            viewer.act(std::string("mousemove_relative ") + way);
        return is_so();
    });
}

/// Starts the viewer with a game pad, whose motors write into pad.txt of its folder.
Words holding_a_pad(Words host) {
    host.insert(host.end(), {"LD_PRELOAD=" VIRTUAL_PAD, "VIRTUAL_PAD=pad.txt"});
    return host;
}

/// The commands to a pad's motors.
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

bool both_turned(const std::vector<Told>& motors) {
    return std::any_of(motors.begin(), motors.end(), [](auto told) { return told.low > 0; }) &&
           std::any_of(motors.begin(), motors.end(), [](auto told) { return told.high > 0; });
}

bool stand_still(const std::vector<Told>& motors) {
    return !motors.empty() && motors.back().low + motors.back().high == 0;
}

bool is_silent(const std::vector<float>& samples, std::size_t from) {
    return std::all_of(samples.begin() + static_cast<std::ptrdiff_t>(from), samples.end(),
                       [](float sample) { return std::abs(sample) < 1e-4F; });
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
    [[nodiscard]] bool was_called() const {
        pollfd call{socket_, POLLIN, 0};
        return ::poll(&call, 1, 0) > 0;
    }
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;

  private:
    int socket_;
};

}  // namespace

TEST_CASE(
    "what is touched in the window turns a game pad's motors and is heard, unless it is "
    "muted; neither once the force is off",
    "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(
        folder,
        small_window(folder, {"--material", "wood", "--pause", "--mute", "--record", "hand.dibhr"}),
        holding_a_pad(sounding_into_file()));
    const auto motors = [&folder] { return motors_told(folder / "pad.txt"); };
    const auto samples = [&folder] { return samples_of(folder / "sound.raw"); };
    const auto heard = [&samples] {
        const std::vector<bool> tenths = heard_tenths(samples());
        return std::count(tenths.begin(), tenths.end(), true);
    };
    viewer.wait_for_surface();
    viewer.act(kPress);
    viewer.wait_until([](const Seen& now) { return now.contact; });
    CHECK(rub_until(viewer, [&] { return both_turned(motors()); }));
    CHECK_FALSE(fs::exists(folder / "sound.raw"));  // no device is opened
    CHECK(viewer.seen().sound == static_cast<int>(State::quiet));
    CHECK(read_text(folder / "errors.txt").empty());  // SDL tells later that it writes a file

    viewer.act("mouseup 1");
    viewer.wait_until([](const Seen& now) { return !now.contact; });
    viewer.act("key u");
    viewer.wait_until(
        [](const Seen& now) { return now.sound == static_cast<int>(State::playing); });
    CHECK(eventually([&] { return samples().size() > 2 * kTenth; }));
    CHECK(is_silent(samples(), 0));  // in the air
    viewer.act("mousedown 1");
    CHECK(rub_until(viewer, [&] { return heard() >= 5; }));

    viewer.act("key f");
    viewer.wait_until([](const Seen& now) { return !now.force_enabled; });
    CHECK(eventually([&] { return stand_still(motors()); }));
    const std::size_t silent_from = samples().size() + kTenth;  // what was on its way is heard
    CHECK(rub_until(viewer, [&] { return samples().size() > silent_from; }));
    const std::size_t told = motors().size();
    const std::uint64_t without_force = viewer.seen().recorded_rows;
    CHECK(rub_until(viewer, [&] { return samples().size() > silent_from + 4 * kTenth; }));
    CHECK(is_silent(samples(), silent_from));
    CHECK(motors().size() == told);
    const std::uint64_t with_force = viewer.seen().recorded_rows;
    viewer.act("key f");
    CHECK(rub_until(viewer, [&] { return motors().size() > told; }));

    viewer.act("key u");
    viewer.wait_until([](const Seen& now) { return now.sound == static_cast<int>(State::quiet); });
    const std::size_t muted = samples().size();
    viewer.act("mousemove_relative 40 0 mousemove_relative -40 0");
    CHECK(samples().size() == muted);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(stand_still(motors()));
    CHECK_FALSE(contains(read_text(folder / "errors.txt"), "dibhr:"));
    const std::vector<float> all = samples();
    CHECK(
        std::all_of(all.begin(), all.end(), [](float sample) { return std::abs(sample) <= 1.0F; }));
    // The command line's value is not saved.
    CHECK_FALSE(contains(read_text(folder / "config/dibhr/settings.toml"), "mute = true"));
    // While it was silent the hand went on sliding over what it touched.
    const std::vector<Row> rows = read_session(folder / "hand.dibhr");
    REQUIRE(with_force > without_force);
    double way_px = 0.0;
    for (std::size_t k = without_force; k < with_force; ++k) {
        CHECK(rows.at(k).contact);
        if (glm::length(rows[k].sent_newton) == 0.0)
            way_px += glm::distance(rows[k].proxy, rows[k - 1].proxy);
    }
    CHECK(way_px > 20.0);
}

TEST_CASE(
    "without a sound device, its game pads off, the window goes on and says nothing on stderr",
    "[sound]") {
    const Words missing = GENERATE(Words{"env", "SDL_AUDIODRIVER=nonsense"},
                                   Words{"env", "SDL_AUDIODRIVER=alsa", "AUDIODEV=nonsense"});
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(
        folder, small_window(folder, {"--pause", "--game-pad", "off", "--record", "hand.dibhr"}),
        holding_a_pad(missing));
    viewer.wait_until([](const Seen& now) {
        return now.surface && now.sound == static_cast<int>(State::no_device);
    });
    viewer.act(kPress);
    viewer.wait_until([](const Seen& now) { return now.contact; });
    const std::uint64_t rows = viewer.seen().recorded_rows;
    CHECK(rub_until(viewer, [&] { return viewer.seen().recorded_rows > rows + 500; }));
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK_FALSE(fs::exists(folder / "pad.txt"));
    CHECK_FALSE(contains(read_text(folder / "config/dibhr/settings.toml"), "game-pad = false"));
}

TEST_CASE("a sound server that never answers holds up neither the window nor its end", "[sound]") {
    const Desk desk;
    const TemporaryFolder folder;
    const SilentServer server(folder / "pulse");
    WindowProgram viewer = desk.start_viewer(
        folder, small_window(folder, {"--record", "hand.dibhr"}),
        {"env", "SDL_AUDIODRIVER=pulseaudio", "PULSE_SERVER=unix:" + (folder / "pulse").string()});
    viewer.wait_for_surface();
    REQUIRE(eventually([&server] { return server.was_called(); }));
    const std::uint64_t rows = viewer.seen().recorded_rows;
    viewer.wait_until([rows](const Seen& now) { return now.recorded_rows > rows + 200; });
    const auto end = std::chrono::steady_clock::now();
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    // A wait for the server takes half a minute.
    CHECK(std::chrono::steady_clock::now() - end < std::chrono::seconds(20));
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("a sound device is opened when it is wanted, and that there is none is told", "[sound]") {
    constexpr SoundOutput::Request kHeard{.speaker = true};
    SECTION("a device that plays") {
        const EnvironmentVariable driver("SDL_AUDIODRIVER", "dummy");
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
        const EnvironmentVariable driver("SDL_AUDIODRIVER", "dummy");
        SoundOutput output(std::make_shared<TouchSource>());
        output.choose({}, {.speaker = true, .coils = true});
        CHECK(eventually([&] { return output.state() == State::playing; }));
        CHECK_FALSE(output.moves_coils());
    }
    SECTION("none") {
        const EnvironmentVariable driver("SDL_AUDIODRIVER", "nonsense");
        SoundOutput output(std::make_shared<TouchSource>());
        output.choose({}, kHeard);
        CHECK(eventually([&] { return output.state() == State::no_device; }));
        output.choose({}, {});
        CHECK(eventually([&] { return output.state() == State::quiet; }));
    }
}
