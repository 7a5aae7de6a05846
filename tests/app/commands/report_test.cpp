// `dibhr report` as people and scripts use it, and what it refuses.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/session/recorder.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

/// A second of touch over color.png and depth.png of the folder, which are made.
void record_touch(const TemporaryFolder& folder, const std::string& name) {
    write_depth_png(folder / "color.png", 64, 48, 20, 3);
    write_depth_png(folder / "depth.png", 32, 24, 100, 1);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder / name, *ring, {{"participant", "P07"}});
    recorder.parameters({.version = 1});
    recorder.media(1, folder / "color.png", folder / "depth.png");
    for (int k = 0; k < 1000; ++k) {
        TickRecord tick;
        tick.tick = k;
        tick.t_s = 0.001 * k;
        tick.dt_s = 0.001;
        tick.settings = 1;
        tick.frames.source.media = 1;
        tick.contact = k >= 300;
        tick.proxy[0] = 10.0 + 0.01 * k;
        tick.proxy[1] = 12.0;
        tick.sent_newton[2] = tick.contact ? 0.8 : 0.0;
        REQUIRE(ring->push(tick));
    }
    REQUIRE(recorder.finish().failure.empty());
}

}  // namespace

TEST_CASE("report writes a page, pictures over the touched frame in the formats asked for, numbers",
          "[report]") {
    const TemporaryFolder folder;
    record_touch(folder, "touch.dibhr");
    const auto report = [&](const std::vector<std::string>& format) {
        std::vector<std::string> words{"report", "touch.dibhr", "--out", "mine"};
        words.insert(words.end(), format.begin(), format.end());
        return run_dibhr(folder, words);
    };
    const ProgramResult vectors = report({"--plot-format", "svg,pdf"});
    INFO(vectors.errors);
    REQUIRE(vectors.exit_code == 0);
    const std::string svg = read_text(folder / "mine/force-over-time.svg");
    CHECK(contains(svg, "touch.dibhr, P07, 1 contact"));
    CHECK(read_text(folder / "mine/heat-map.pdf").starts_with("%PDF"));
    CHECK_FALSE(fs::exists(folder / "mine/heat-map.png"));
    const std::string page = read_text(folder / "mine/report.html");
    CHECK(contains(page, "src=\"data:image/png;base64,iVBORw0KGgo"));
    CHECK(contains(page, "(heat-map.svg, heat-map.pdf)"));
    CHECK(contains(read_text(folder / "mine/report.json"), "\"heat-map.svg\""));

    const ProgramResult plain = report({});  // takes the place of the one before
    REQUIRE(plain.exit_code == 0);
    CHECK(plain.output == "mine/report.html\n");
    CHECK(plain.errors.empty());
    CHECK_FALSE(fs::exists(folder / "mine/heat-map.pdf"));
    CHECK(fs::exists(folder / "mine/heat-map.png"));
    const std::string plain_page = read_text(folder / "mine/report.html");
    CHECK(contains(plain_page, "P07 touched once for 0.7 s in all"));
    CHECK(contains(plain_page, "over the frame that was touched longest: color.png"));
    CHECK(contains(read_text(folder / "mine/report.json"), "\"columns\": 32,\n      \"rows\": 24"));

    const ProgramResult refused = report({"--plot-format", "gif"});
    CHECK(refused.exit_code == 2);
    CHECK(std::count(refused.errors.begin(), refused.errors.end(), '\n') == 1);
    CHECK(contains(refused.errors, "'gif' is none of png, svg, pdf"));
}

TEST_CASE("report goes on over plain ground when a file is gone or has changed, and says so",
          "[report]") {
    const TemporaryFolder folder;
    record_touch(folder, "touch.dibhr");
    const bool gone = GENERATE(true, false);
    if (gone) {
        fs::remove(folder / "color.png");
    } else {
        write_depth_png(folder / "color.png", 64, 48, 21, 3);
    }
    const ProgramResult result = run_dibhr(folder, {"report", "touch.dibhr", "--out", "mine"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string page = read_text(folder / "mine/report.html");
    CHECK(contains(page, "A heat map lies over plain ground"));
    CHECK(contains(page, gone ? "is not there" : "has changed"));
}

TEST_CASE("report keeps the picture of a recording that ended before its files were known",
          "[report]") {
    const TemporaryFolder folder;
    record_touch(folder, "touch.dibhr");
    run_shell(folder, "sqlite3 touch.dibhr 'UPDATE media SET sha256 = NULL'");
    const ProgramResult result = run_dibhr(folder, {"report", "touch.dibhr", "--out", "mine"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string page = read_text(folder / "mine/report.html");
    CHECK(contains(page, "depth.png is taken for the depth video"));  // both are reported
    CHECK(contains(page, "color.png is taken for the colour video"));
    CHECK(contains(page, "over the frame that was touched longest"));
}

TEST_CASE("report refuses what is no session or cannot be written, in one line", "[report]") {
    const TemporaryFolder folder;
    record_touch(folder, "touch.dibhr");
    const std::string whole = read_text(folder / "touch.dibhr");
    write_text(folder / "text.dibhr", "this is no session\n");
    constexpr std::ptrdiff_t kHead = 9000;  // in which there is no tick
    write_text(folder / "short.dibhr", whole.substr(0, kHead));
    std::string damaged = whole;
    std::fill(damaged.begin() + kHead, damaged.end(), 'x');
    write_text(folder / "damaged.dibhr", damaged);
    const auto before = names_in(folder.path());
    for (const auto& [session, out] :
         std::vector<std::pair<std::string, std::string>>{{"missing.dibhr", "mine"},
                                                          {"text.dibhr", "mine"},
                                                          {"short.dibhr", "mine"},
                                                          {"damaged.dibhr", "mine"},
                                                          {"touch.dibhr", "text.dibhr"},
                                                          {"touch.dibhr", "/proc/mine"}}) {
        const ProgramResult result = run_dibhr(folder, {"report", session, "--out", out});
        INFO(session << " to " << out << ": " << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(contains(result.errors, out == "mine" ? session : out));
        CHECK(names_in(folder.path()) == before);
    }
    CHECK(run_dibhr(folder, {"report", "touch.dibhr"}).exit_code == 2);
    CHECK(run_dibhr(folder, {"report"}).exit_code == 2);
}

TEST_CASE("report leaves nothing on a disk that is full", "[report]") {
    const TemporaryFolder folder;
    record_touch(folder, "touch.dibhr");
    const auto before = names_in(folder.path());
    // No picture is so small; as on a full disk there is an error and no signal.
    const ProgramResult result =
        run_dibhr(folder, {"report", "touch.dibhr", "--out", "mine"},
                  {"/bin/sh", "-c", "trap '' XFSZ; exec prlimit --fsize=20000 \"$0\" \"$@\""});
    INFO(result.errors);
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(contains(result.errors, "mine"));
    CHECK(names_in(folder.path()) == before);
}
