// The whole program touches with a simulated arm below the stand-in for Force Dimension's library,
// which it loads as it loads its maker's.
#include <sys/mman.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/strokes.hpp"
#include "tests/device/forcedimension/stand_in_page.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace dibhr::test::forcedimension;
using Catch::Matchers::WithinAbs;

namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;

constexpr auto kPatience = 60s;  // only reached by a failure
constexpr double kMillimetre = 1e-3;
constexpr double kRest_m = 0.03;  // before the relief

/// The page of a stand-in in another process, and settings that name the stand-in.
class StandIn {
  public:
    explicit StandIn(const TemporaryFolder& folder, const std::string& settings_folder,
                     const std::string& library = STAND_IN_LIBRARY) {
        const std::string file = (folder / "arm").string();
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        REQUIRE(::ftruncate(descriptor, sizeof(Page)) == 0);
        void* const memory =
            ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
        ::close(descriptor);
        REQUIRE(memory != MAP_FAILED);
        page_ = new (memory) Page;
        ::setenv(kPageVariable, file.c_str(), 1);
        page_->units[0].plugged = true;
        page_->units[0].serial = 1234;
        page_->units[0].position_m[0] = kRest_m;
        std::filesystem::create_directories(folder / (settings_folder + "dibhr"));
        write_text(folder / (settings_folder + "dibhr/settings.toml"),
                   "[forcedimension]\nlibrary = \"" + library + "\"\n");
    }
    ~StandIn() {
        ::unsetenv(kPageVariable);
        ::munmap(page_, sizeof(Page));
    }
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;

    [[nodiscard]] Page& page() const { return *page_; }
    [[nodiscard]] Unit& unit() const { return page_->units[0]; }
    /// What the motors do.
    [[nodiscard]] double newton() const {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::sqrt(unit().square_newton(
            std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()));
    }

  private:
    Page* page_;
};

/// The program on its display, recording.
class ArmScene {
  public:
    explicit ArmScene(Words arguments)
        : arm(folder, "config/"), viewer(start(std::move(arguments))) {
        viewer.wait_for_surface();
    }

    /// The hand goes there, mm: right, and into the image. In steps that the program takes up.
    void move_hand(double right_mm, double in_mm, int steps) {
        const double right_m = right_mm * kMillimetre;
        const double out_m = -in_mm * kMillimetre;
        const double from_right = arm.unit().position_m[1];
        const double from_out = arm.unit().position_m[0];
        for (int k = 1; k <= steps; ++k) {
            const double part = static_cast<double>(k) / steps;
            arm.unit().position_m[1] = from_right + part * (right_m - from_right);
            arm.unit().position_m[0] = from_out + part * (out_m - from_out);
            const std::int64_t set_at = arm.unit().newton_at_ns;
            wait_until([&] { return arm.unit().newton_at_ns > set_at + 1'000'000; });
        }
    }
    void press() {
        move_hand(0.0, 7.0, 100);
        wait_until([this] { return arm.newton() > 0.6; });
    }
    template <typename Condition>
    static void wait_until(const Condition& is_so) {
        REQUIRE(eventually(is_so, kPatience));
    }
    [[nodiscard]] std::vector<Row> rows() const { return read_session(folder / "hand.dibhr"); }

    const Desk desk{};
    const TemporaryFolder folder{};
    StandIn arm;
    WindowProgram viewer;

  private:
    WindowProgram start(Words arguments) {
        arguments.insert(arguments.end(), {"--device", "forcedimension", "--record", "hand.dibhr",
                                           "--size", "320x240"});
        return desk.start_viewer(folder, arguments);
    }
};

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (says(line, part)) found.push_back(line);
    return found;
}

}  // namespace

TEST_CASE(
    "the program presses and slides with an arm; its forces are those of dibhr touch, and the "
    "session replays to the same bits",
    "[forcedimension][window]") {
    ArmScene at({"--stability", "off", "--speed", "0.25", "--stiffness", "0.2"});
    const auto is_enough = [](const Stroked& so_far) {
        return so_far.contacts > 800 && so_far.held_back > 100;
    };
    Stroked so_far;
    for (int strokes = 0; strokes < 20 && !is_enough(so_far); ++strokes) {
        at.move_hand(0.0, -3.0, 50);
        at.move_hand(0.0, 7.0, 100);
        at.wait_until([&] { return at.arm.newton() > 0.6; });
        at.move_hand(14.0, 7.0, 400);
        at.move_hand(14.0, -30.0, 100);
        so_far = stroked(at.rows());
    }
    CHECK(is_enough(so_far));
    at.desk.press("key q");
    REQUIRE(at.viewer.wait() == 0);
    CHECK(read_text(at.folder / "errors.txt").empty());
    const auto rows = at.rows();
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    CHECK_THAT(worst_touched_again(rows), WithinAbs(0.0, 1e-12));
    require_same_bits(at.folder, at.folder / "hand.dibhr");
    CHECK(at.arm.page().wrong_calls == 0);
    CHECK_FALSE(at.arm.unit().open);
    CHECK_FALSE(at.arm.unit().force_on);
}

TEST_CASE(
    "however the program ends, the motors push nobody: stopped by the program, or by the "
    "firmware's watchdog",
    "[forcedimension][window]") {
    const int signal = GENERATE(SIGTERM, SIGKILL, SIGSEGV, SIGABRT, SIGSTOP);
    CAPTURE(signal);
    ArmScene at({"--pause"});
    at.press();
    CHECK(at.arm.unit().watchdog == 160);
    at.viewer.send(signal);
    at.wait_until([&] { return at.arm.newton() == 0.0; });
    if (signal == SIGSTOP) at.viewer.send(SIGKILL);
    (void)at.viewer.wait();
    CHECK(at.arm.newton() == 0.0);
    CHECK(at.arm.unit().open == (signal != SIGTERM));
}

TEST_CASE("dibhr devices tells of an arm with its next step", "[forcedimension][devices]") {
    const TemporaryFolder folder;
    const StandIn arm(folder, "");
    const ProgramResult usable = run_dibhr(folder, {"devices"});
    CHECK(usable.exit_code == 0);
    CHECK(usable.errors.empty());
    CHECK(says(usable.output, "omega.3 1234: usable, ready to touch"));
    CHECK(says(usable.output, "version 3.17.6.0"));
    arm.unit().initialised = false;
    const ProgramResult lost = run_dibhr(folder, {"devices"});
    CHECK(lost.exit_code == 1);
    CHECK(says(lost.errors, "dibhr: the omega.3 1234 does not know its position"));
    // Nobody is there to agree.
    const ProgramResult asked = run_dibhr(folder, {"devices", "--initialise"});
    CHECK(asked.exit_code == 0);
    CHECK(says(asked.output, "keep hands"));
    CHECK(says(asked.output, "The arm has not moved."));
    CHECK(arm.unit().initialisations == 0);
    const ProgramResult other = run_dibhr(folder, {"view", "--device", "forcedimension:77"});
    CHECK(other.exit_code == 1);
    CHECK(says(other.errors, "no Force Dimension arm with serial 77 is attached, but 1234"));
    CHECK(arm.page().wrong_calls == 0);
    CHECK_FALSE(arm.unit().force_on);
}

TEST_CASE("a library that cannot be used is one sentence, and the mouse touches",
          "[forcedimension][devices]") {
    const TemporaryFolder folder;
    const std::string library = (folder / "libdrd.so.3").string();
    const StandIn arm(folder, "", library);
    const std::string fault = GENERATE(as<std::string>{}, "32-bit", "too old", "not a library");
    std::filesystem::copy_file(STAND_IN_LIBRARY, library);
    if (fault == "too old") arm.page().version[1] = 2;
    if (fault == "not a library") write_text(library, "no library");
    if (fault == "32-bit") {
        std::fstream stream(library, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(4);
        stream.put(1);
    }
    // No arm is attached, and the mouse can be used.
    const ProgramResult listed = run_dibhr(folder, {"devices"});
    INFO(listed.output << listed.errors);
    CHECK(listed.exit_code == 0);
    CHECK(listed.errors.empty());
    const std::vector<std::string> told = lines_with(listed.output, library);
    REQUIRE(told.size() == 1);
    CHECK(told.front().starts_with("Force Dimension: none usable, "));
    CHECK(says(told.front(), fault));
    const ProgramResult asked = run_dibhr(folder, {"view", "--device", "forcedimension"});
    CHECK(asked.exit_code == 1);
    CHECK(asked.errors.starts_with("dibhr: " + library));
    CHECK(says(asked.errors, fault));
    CHECK(asked.errors.find('\n') == asked.errors.size() - 1);
}

TEST_CASE("what a record has is played as a device", "[forcedimension][devices][long]") {
    const TemporaryFolder folder;
    const StandIn arm(folder, "");
    const ProgramResult recorded = run_dibhr(folder, {"devices", "--record", "arm.txt"});
    CHECK(recorded.exit_code == 0);
    CHECK(says(recorded.output, "omega.3 1234: ready to touch"));
    arm.unit().plugged = false;
    const ProgramResult played = run_dibhr(folder, {"devices", "--simulate", "arm.txt"});
    CHECK(played.exit_code == 0);
    CHECK(says(played.output, "omega.3 1234: ready to touch"));
    write_text(folder / "other.txt", "no record");
    const ProgramResult other = run_dibhr(folder, {"devices", "--simulate", "other.txt"});
    CHECK(other.exit_code == 1);
    CHECK(says(other.errors, "other.txt is no record of a device"));
}
