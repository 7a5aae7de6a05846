// How 3D Systems' library is loaded, and what it may not do to the program.
#include "device/openhaptics/library.hpp"

#include "device/openhaptics/record.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <fstream>

#include "tests/device/openhaptics/touch_desk.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comma_locale.hpp"
#include "tests/support/text.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::openhaptics;

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Both output streams lead into files while this exists.
class OutputInFiles {
  public:
    explicit OutputInFiles(const test::TemporaryFolder& folder)
        : output_(STDOUT_FILENO, folder / "out"), errors_(STDERR_FILENO, folder / "errors") {}

  private:
    class Stream {
      public:
        Stream(int stream, const std::filesystem::path& file)
            : stream_(stream), before_(::dup(stream)) {
            std::fflush(nullptr);
            const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
            ::dup2(descriptor, stream_);
            ::close(descriptor);
        }
        ~Stream() {
            std::fflush(nullptr);
            ::dup2(before_, stream_);
            ::close(before_);
        }
        Stream(const Stream&) = delete;
        Stream& operator=(const Stream&) = delete;

      private:
        int stream_;
        int before_;
    };

    Stream output_;
    Stream errors_;
};

}  // namespace

TEST_CASE("a library that cannot be used is named with the next step", "[openhaptics]") {
    const test::TemporaryFolder folder;
    SECTION("one of another maker") {
        const LoadedLibrary library = load_hd_library(FOREIGN_LIBRARY);
        CHECK_FALSE(library.loaded);
        CHECK(says(library.trouble, "has no function hdDisableDevice"));
        CHECK(says(library.trouble, "install OpenHaptics"));
    }
    SECTION("one that needs the old ncurses") {
        const LoadedLibrary library = load_hd_library(NEEDING_LIBRARY);
        CAPTURE(library.trouble);
        CHECK_FALSE(library.loaded);
        CHECK(says(library.trouble, "needs libncurses.so.5, which is not installed"));
        CHECK(says(library.trouble, "install libncurses5 and libtinfo5"));
    }
    SECTION("a file that is no library") {
        const auto file = folder / "libHD.so.3.4";
        std::ofstream(file) << "no library";
        const LoadedLibrary library = load_hd_library(file);
        CHECK_FALSE(library.loaded);
        CHECK(says(library.trouble, file.string()));
    }
}

TEST_CASE("the device says why the library cannot be used, and the mouse may touch",
          "[openhaptics]") {
    test::TickingDevice<OpenhapticsDevice> loop(ConnectionOptions{.library = FOREIGN_LIBRARY});
    CHECK(loop.tick_until([&] { return loop.device.state().trouble; }));
    CHECK(says(loop.device.state().sentence, "has no function"));
    CHECK(loop.device.state().absent);
    CHECK_FALSE(loop.device.can_touch());
}

TEST_CASE("what the library prints goes to standard error, once", "[openhaptics]") {
    const test::TemporaryFolder folder;
    {
        const OutputInFiles files(folder);
        std::printf("before\n");
        TouchDesk desk("", [](ArmPage& page) {
            page.prints = true;
            page.default_by_null = false;  // the second name opens it
        });
        CHECK(desk.loop.tick_until_ready());
        CHECK(desk.bench.page().openings == 2);
        std::printf("after\n");
    }
    CHECK(test::read_text(folder / "out") == "before\nafter\n");
    CHECK(test::read_text(folder / "errors") == "A stand-in for development\nSecond line\n");
}

TEST_CASE("nothing that the program prints while the library opens a device is lost",
          "[openhaptics]") {
    const test::TemporaryFolder folder;
    {
        const OutputInFiles files(folder);
        std::string printed;
        for (const char* const text : {"one\n", "two\n"}) {
            const OpeningCall call(printed);
            std::printf("%s", text);
        }
        CHECK(printed == "two\n");
        const OpeningCall call(printed);  // does not return
        std::printf("aside\n");
        test::let_pass(std::chrono::milliseconds(1100));
        std::printf("back\n");
        std::fflush(stdout);
    }
    CHECK(test::read_text(folder / "out") == "back\n");
    CHECK(test::read_text(folder / "errors") == "one\ntwo\naside\n");
}

TEST_CASE("a record of a Touch's calls plays as that Touch", "[openhaptics]") {
    const test::TemporaryFolder folder;
    const std::string file = (folder / "record.txt").string();
    {
        FoundArm found({});
        found.bench.move_to({4.0, 0.0, 0.0});
        ConnectionOptions options = options_for();
        options.forces = false;
        options.around = recording_in(file, "libHD.so.3.4");
        test::TickingDevice<OpenhapticsDevice> loop(options);
        REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::ready; }));
        loop.tick_for(std::chrono::milliseconds(500));
        found.bench.move_to({5.0, 0.0, 0.0});
        loop.tick_for(std::chrono::milliseconds(500));
        found.bench.arm().calibration = kHdNeedsPerson;
        loop.tick_for(std::chrono::milliseconds(200));
        CHECK(strongest(found.bench.sent_since({})) == 0.0);
    }
    REQUIRE(is_record(file));
    test::TickingDevice<OpenhapticsDevice> loop(ConnectionOptions{.library = file});
    REQUIRE(loop.tick_until_ready());
    CHECK(loop.device.status().serial == "SIM-1");
    CHECK(loop.reading.limits->max_force_newton == 0.88);
    const Vec3 before = loop.reading.goal_in_grid;
    REQUIRE(loop.tick_until([&] { return loop.reading.goal_in_grid.x > before.x + 1.0; }));
    CHECK_THAT((loop.reading.goal_in_grid.x - before.x) * loop.kPitch_mm,
               Catch::Matchers::WithinAbs(1.0, 1e-9));
    CHECK(loop.tick_until([&] { return loop.device.status().stage == Stage::not_calibrated; }));
    CHECK(says(loop.device.status().sentence, "into the inkwell"));
}

TEST_CASE("a damaged record of a Touch is refused with the number of the line", "[openhaptics]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "record.txt";
    const std::string line = GENERATE(as<std::string>{}, "1 2 open - = 1", "1 2 hdGetDoublev",
                                      "-1 2 hdBeginFrame - = 0", "1 2 hdGetDoublev 0x2050 = 0 1 2");
    std::ofstream(file) << "dibhr openhaptics record 1\n1 2 hdBeginFrame - 7 = 0\n" << line << '\n';
    const LoadedLibrary library = load_hd_library(file);
    CHECK_FALSE(library.loaded);
    CHECK(says(library.trouble, "line 3"));
}

TEST_CASE("the library reads numbers with a point, and the program's locale stays",
          "[openhaptics]") {
    SECTION("in a program with a decimal comma") {
        const test::CommaLocale locale;
        TouchDesk desk;
        CHECK(desk.loop.tick_until_ready());
        CHECK(desk.bench.page().number_read == 1.5);
        CHECK(std::string(std::localeconv()->decimal_point) == ",");
    }
    SECTION("with a library that sets the locale") {
        TouchDesk desk("", [](ArmPage& page) { page.sets_locale = true; });
        CHECK(desk.loop.tick_until_ready());
        CHECK(std::string(std::setlocale(LC_NUMERIC, nullptr)) == "C");
    }
}
