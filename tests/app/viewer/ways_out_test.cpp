// However the program ends: one plain line, the status that is due, and a recording that is whole.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

namespace {

/// Takes connections, as an X server that stands still does, and says nothing.
class SilentDisplay {
  public:
    SilentDisplay() {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        REQUIRE(::bind(socket_, any, size) == 0);
        REQUIRE(::listen(socket_, 4) == 0);
        REQUIRE(::getsockname(socket_, any, &size) == 0);
        number_ = ntohs(address.sin_port) - kPortOfDisplay0;
    }
    ~SilentDisplay() { ::close(socket_); }
    SilentDisplay(const SilentDisplay&) = delete;
    SilentDisplay& operator=(const SilentDisplay&) = delete;

    /// What a program is started with that is to be on it.
    [[nodiscard]] Words host() const {
        return {"env", "DISPLAY=127.0.0.1:" + std::to_string(number_)};
    }

  private:
    static constexpr int kPortOfDisplay0 = 6000;
    int socket_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    int number_{0};
};

/// The viewer on a display, recording.
struct Recording {
    explicit Recording(Words arguments = {}, const Words& host = {})
        : viewer(desk.start_viewer(folder, with_recording(std::move(arguments)), host)) {}

    /// Until a second of it is on the disk.
    void wait_until_under_way() const {
        FalconOnUsb::wait_until([this] {
            std::error_code missing;
            const auto bytes = std::filesystem::file_size(folder / "hand.dibhr-wal", missing);
            return !missing && bytes > 300'000;
        });
    }
    [[nodiscard]] std::string errors() const { return read_text(folder / "errors.txt"); }
    void check_one_line(const std::string& part) const {
        const std::string said = errors();
        CHECK(contains(said, part));
        CHECK(said.starts_with("dibhr: "));
        CHECK(std::count(said.begin(), said.end(), '\n') == 1);
    }
    void check_session() const {
        CHECK(run_dibhr(folder, {"info", "hand.dibhr"}).exit_code == 0);
        CHECK(read_session(folder / "hand.dibhr").size() > 200);
        require_same_bits(folder, folder / "hand.dibhr");
    }

    const Desk desk{};
    const TemporaryFolder folder{};
    Process viewer;

  private:
    static Words with_recording(Words arguments) {
        arguments.insert(arguments.end(), {"--device", "mouse", "--record", "hand.dibhr"});
        return arguments;
    }
};

/// What starts a program under a limit of the shell's.
Words limited(const std::string& limit) {
    return {"bash", "-c", "ulimit " + limit + "; exec \"$@\"", "--"};
}

double seconds_to_end(Process& viewer, int signal, int status) {
    const auto asked = Clock::now();
    viewer.send(signal);
    CHECK(viewer.wait() == status);
    return std::chrono::duration<double>(Clock::now() - asked).count();
}

}  // namespace

TEST_CASE("when the X server dies the recording is closed, and a line says why it ended",
          "[ways out]") {
    Recording at;
    at.wait_until_under_way();
    const auto killed = Clock::now();
    at.desk.kill();
    CHECK(at.viewer.wait() == 1);
    const double taken_s = std::chrono::duration<double>(Clock::now() - killed).count();
    WARN("X server killed to exit: " << taken_s << " s");
    CHECK(taken_s < 2.0);
    at.check_one_line("the display went away");
    at.check_session();
    run_shell(at.folder,
              "test \"$(sqlite3 hand.dibhr \"SELECT value FROM session WHERE key = "
              "'complete'\")\" = 1");
}

TEST_CASE("a crash is told in one line, ends with its signal, and leaves a whole recording",
          "[ways out]") {
    const int signal = GENERATE(SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXFSZ);
    CAPTURE(signal);
    Recording at;
    at.wait_until_under_way();
    seconds_to_end(at.viewer, signal, 128 + signal);
    at.check_one_line("crashed (");
    CHECK(contains(at.errors(), "the force is off; the recording up to now is in hand.dibhr"));
    at.check_session();
}

TEST_CASE("a recording that meets the limit of a file's size breaks off, and the program goes on",
          "[ways out]") {
    Recording at({"--seconds", "8", "--screenshot", "last.png", "--size", "320x240"},
                 limited("-f 300"));
    CHECK(at.viewer.wait() == 1);
    at.check_one_line("the file-size limit of 307200 bytes is met");
    CHECK(std::filesystem::exists(at.folder / "last.png"));  // of its end, after the breaking off
    at.check_session();
}

TEST_CASE("a recording that breaks off takes the force off until somebody switches it on again",
          "[ways out]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"}, {}, limited("-f 600"));
    at.press_in();
    FalconOnUsb::wait_until([&] { return glm::length(at.falcon.vector("motor_newton")) < 1e-6; });
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    CHECK(glm::length(at.falcon.vector("motor_newton")) < 1e-6);
    at.desk.act("key Escape sleep 0.2 key f");
    at.wait_for_force();
    at.desk.act("key q");
    CHECK(at.viewer.wait() == 1);
    CHECK(contains(at.errors(), "the file-size limit of 614400 bytes is met"));
}

TEST_CASE("a settings file that is a pipe nobody writes to is refused at once", "[ways out]") {
    const Desk desk;
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "config/dibhr");
    REQUIRE(::mkfifo((folder / "config/dibhr/settings.toml").c_str(), 0600) == 0);
    Process viewer = desk.start_viewer(folder, {"--device", "mouse"});
    CHECK(viewer.wait() == 1);
    CHECK(contains(read_text(folder / "errors.txt"), "cannot read the settings file"));
}

TEST_CASE(
    "a signal ends the program while it opens its window, and while it writes the last picture",
    "[ways out]") {
    SECTION("a display that never answers") {
        const Desk desk;
        const TemporaryFolder folder;
        const SilentDisplay display;
        Process viewer = desk.start_viewer(folder, {"--device", "mouse"}, display.host());
        std::this_thread::sleep_for(std::chrono::seconds(2));
        CHECK(seconds_to_end(viewer, SIGTERM, 1) < 1.0);
        CHECK(contains(read_text(folder / "errors.txt"), "hung while opening the window"));
    }
    SECTION("a picture into a pipe nobody reads from") {
        const TemporaryFolder pipes;
        const std::string pipe = (pipes / "last.png").string();
        REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
        Recording at({"--seconds", "2", "--screenshot", pipe});
        at.wait_until_under_way();
        std::this_thread::sleep_for(std::chrono::seconds(2));
        CHECK(seconds_to_end(at.viewer, SIGHUP, 1) < 1.0);
        at.check_one_line("hung while writing the last picture");
        at.check_session();
    }
}

TEST_CASE("a signal ends a program that does not hang in order, within a second", "[ways out]") {
    const int signal = GENERATE(SIGTERM, SIGINT, SIGHUP, SIGQUIT);
    Recording at;
    at.wait_until_under_way();
    const double taken_s = seconds_to_end(at.viewer, signal, 0);
    WARN("signal " << signal << " to exit: " << taken_s << " s");
    CHECK(taken_s < 1.0);
    CHECK(at.errors() == "");
    at.check_session();
}

TEST_CASE("where memory runs out a plain line says so; only the graphics driver's code may crash",
          "[ways out]") {
    const int kilobytes = GENERATE(1'100'000, 1'200'000, 1'300'000, 1'400'000, 1'500'000);
    CAPTURE(kilobytes);
    Recording at({"--seconds", "3"}, limited("-v " + std::to_string(kilobytes)));
    const int status = at.viewer.wait();
    const std::vector<std::string> said = split(at.errors(), '\n');
    CAPTURE(status, said);
    // Mesa 22.3 reads null pointers there, and LLVM aborts.
    const bool crashed = status == 128 + SIGSEGV || status == 128 + SIGABRT;
    CHECK((status == 0 || status == 1 || crashed));
    const std::string last = said.size() > 1 ? said[said.size() - 2] : "";
    if (status != 0) CHECK(last.starts_with(crashed ? "dibhr: crashed (" : "dibhr: "));
    for (const std::string& line : said) CHECK_FALSE(contains(line, "Assertion"));
}
