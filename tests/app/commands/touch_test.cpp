// `dibhr touch` as scripts use it: files in, rows out, checked against exact answers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/haptics/vec.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kExact_px = 1e-9;
const std::string kHeader = "t,gx,gy,gz,px,py,pz,fx,fy,fz,cx,cy,cz,contact,primitive,i,j,moves,ns";

/// One output row by the names of its columns.
struct Row {
    std::map<std::string, std::string> text{};

    double number(const std::string& column) const { return std::stod(text.at(column)); }
    Vec3 vector(char name) const {
        const std::string n(1, name);
        return {number(n + "x"), number(n + "y"), number(n + "z")};
    }
};

std::vector<Row> rows_of(const std::string& csv) {
    std::vector<std::string> lines = split(csv, '\n');
    REQUIRE(lines.front() == kHeader);
    REQUIRE(lines.back().empty());
    const std::vector<std::string> columns = split(kHeader, ',');
    std::vector<Row> rows;
    for (std::size_t n = 1; n + 1 < lines.size(); ++n) {
        const std::vector<std::string> values = split(lines[n], ',');
        REQUIRE(values.size() == columns.size());
        Row row;
        for (std::size_t c = 0; c < columns.size(); ++c) row.text[columns[c]] = values[c];
        rows.push_back(row);
    }
    return rows;
}

std::string goals_csv(const std::vector<Vec3>& goals, const std::vector<double>& times_s = {}) {
    std::ostringstream text;
    text << std::setprecision(17) << "t,x,y,z\n";
    for (std::size_t k = 0; k < goals.size(); ++k) {
        text << (times_s.empty() ? static_cast<double>(k) * 0.001 : times_s[k]) << ',' << goals[k].x
             << ',' << goals[k].y << ',' << goals[k].z << '\n';
    }
    return text.str();
}

/// A hand that slides to and fro on a floor of level 100 and comes off it now and then, in an
/// encoder's steps; its ticks are not all of the same length, and some have the time of the one
/// before.
void write_stepping_hand(const TemporaryFolder& folder) {
    constexpr double kStep_px = 0.06 / (101.6 / 720.0);
    std::vector<Vec3> goals;
    std::vector<double> times_s;
    double t_s = 0.0;
    for (int k = 0; k < 3000; ++k) {
        if (k % 100 != 0) t_s += 0.001 + 1e-4 * (k % 7);
        const Vec3 smooth{45.0 + 30.0 * std::sin(9.0 * t_s), 45.0 + 10.0 * std::cos(5.0 * t_s),
                          96.0 + 12.0 * std::sin(14.0 * t_s)};
        goals.push_back(kStep_px * glm::floor(smooth / kStep_px));
        times_s.push_back(t_s);
    }
    write_depth_png(folder / "depth.png", 90, 90, 100);
    write_text(folder / "goals.csv", goals_csv(goals, times_s));
}

/// Goals from above straight down to `start`, then on a circle around `centre` in the plane of `u`
/// and `v`.
std::vector<Vec3> circle_goals(Vec3 centre, Vec3 u, Vec3 v, double radius_px, double step_rad,
                               int count) {
    std::vector<Vec3> goals{centre + radius_px * u + Vec3{0.0, 0.0, 100.0}};
    for (int k = 0; k < count; ++k) {
        const double angle = step_rad * k;
        goals.push_back(centre + radius_px * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return goals;
}

/// The exact proxy on a plane: it follows the goal's foot at the distance of the friction cone.
Vec3 next_on_plane(Vec3 proxy, Vec3 foot, double cone_px) {
    const double distance = glm::length(proxy - foot);
    return distance <= cone_px ? proxy : foot + (cone_px / distance) * (proxy - foot);
}

std::vector<Row> touch_rows(const TemporaryFolder& folder, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"touch", "--raw-depth", "--depth", "depth.png", "--goals", "goals.csv"});
    const ProgramResult result = run_dibhr(folder, options);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    REQUIRE(result.errors.empty());
    return rows_of(result.output);
}

/// As depth.mkv, made once: levels 50, 100 and 150 at 10 frames a second.
void copy_steps(const TemporaryFolder& folder) {
    static const TemporaryFolder made;
    if (names_in(made.path()).empty()) {
        for (int k = 0; k < 3; ++k)
            write_depth_png(made / ("f" + std::to_string(k) + ".png"), 64, 48, 50 + 50 * k);
        run_shell(made,
                  "ffmpeg -v error -framerate 10 -i f%d.png -pix_fmt gray -c:v ffv1 depth.mkv");
    }
    std::filesystem::copy_file(made / "depth.mkv", folder / "depth.mkv");
}

}  // namespace

TEST_CASE("touch writes one row an update whose goals read back to the same bits", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    const std::vector<Vec3> goals{
        {1.1, 2.2, 300.3}, {1.0 / 3.0, 2.0 / 7.0, 250.1}, {15.9, 5.5, 90.7}};
    write_text(folder / "goals.csv", goals_csv(goals));

    const std::vector<Row> rows = touch_rows(folder, {});
    REQUIRE(rows.size() == goals.size());
    for (std::size_t k = 0; k < goals.size(); ++k) {
        CHECK(rows[k].vector('g') == goals[k]);
        CHECK(rows[k].number("t") == static_cast<double>(k) * 0.001);
        CHECK(rows[k].number("ns") >= 0.0);
    }
    CHECK(rows[0].text.at("contact") == "0");
    CHECK(rows[0].text.at("primitive") == "none");
    CHECK(rows[2].text.at("contact") == "1");
    CHECK(rows[2].text.at("primitive") != "none");
    CHECK(rows[2].number("i") >= 0.0);
}

TEST_CASE("on a flat plane touch follows the exact orbit", "[touch]") {
    const double depth_px = GENERATE(5.0, 20.0, 60.0);
    const double mu = GENERATE(0.0, 0.4, 1.3);
    CAPTURE(depth_px, mu);
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 90, 90, 100);
    const auto goals =
        circle_goals({44.0, 45.0, 100.0 - depth_px}, {1, 0, 0}, {0, 1, 0}, 30.0, 0.11, 150);
    write_text(folder / "goals.csv", goals_csv(goals));

    const std::vector<Row> rows = touch_rows(folder, {"--friction", std::to_string(mu)});
    Vec3 proxy = {goals[1].x, goals[1].y, 100.0};
    for (std::size_t k = 1; k < goals.size(); ++k) {
        proxy = next_on_plane(proxy, {goals[k].x, goals[k].y, 100.0}, mu * depth_px);
        CAPTURE(k);
        REQUIRE_THAT(glm::length(rows[k].vector('p') - proxy), WithinAbs(0.0, kExact_px));
    }
}

TEST_CASE("on a tilted plane touch follows the exact orbit", "[touch]") {
    const double depth_px = GENERATE(4.0, 15.0);
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 120, 90, 40, 1);
    const Vec3 normal = glm::normalize(Vec3{-1.0, 0.0, 1.0});
    const Vec3 along = glm::normalize(Vec3{1.0, 0.0, 1.0});
    const Vec3 centre{60.0, 45.0, 100.0};
    const auto goals = circle_goals(centre - depth_px * normal, along, {0, 1, 0}, 25.0, 0.13, 150);
    write_text(folder / "goals.csv", goals_csv(goals));

    const std::vector<Row> rows = touch_rows(folder, {"--friction", "0.4"});
    // The first goal is above the surface; from there the proxy came straight down onto it.
    Vec3 proxy{goals[1].x, goals[1].y, 40.0 + goals[1].x};
    for (std::size_t k = 1; k < goals.size(); ++k) {
        const Vec3 foot = goals[k] + glm::dot(centre - goals[k], normal) * normal;
        proxy = next_on_plane(proxy, foot, 0.4 * depth_px);
        CAPTURE(k);
        REQUIRE_THAT(glm::length(rows[k].vector('p') - proxy), WithinAbs(0.0, kExact_px));
    }
}

TEST_CASE("the paper's circle turns the force by 0.528 degrees an update at every depth",
          "[touch]") {
    const double depth_px = GENERATE(5.0, 20.0, 60.0);
    CAPTURE(depth_px);
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 486, 486, 128);
    const double step_rad = 4.961 / 200.0;
    const auto goals =
        circle_goals({242.0, 242.0, 128.0 - depth_px}, {1, 0, 0}, {0, 1, 0}, 200.0, step_rad, 600);
    write_text(folder / "goals.csv", goals_csv(goals));

    const std::vector<Row> rows = touch_rows(folder, {"--friction", "0.4"});
    const Vec3 before = glm::normalize(rows[rows.size() - 2].vector('f'));
    const Vec3 after = glm::normalize(rows.back().vector('f'));
    const double turn_deg = std::acos(glm::dot(before, after)) * 180.0 / std::acos(-1.0);
    CHECK_THAT(turn_deg, WithinAbs(0.528, 0.0005));
}

TEST_CASE("the spring force is stiffness times pitch times the way to the proxy", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 32, 32, 100);
    write_text(folder / "goals.csv", goals_csv({{10, 10, 120}, {10, 10, 95}, {10, 10, 95}}));
    const std::vector<Row> rows =
        touch_rows(folder, {"--stiffness", "0.8", "--pixel-pitch", "0.25", "--damping", "0"});
    CHECK_THAT(rows[0].number("fz"), WithinAbs(0.0, 0.0));
    CHECK_THAT(rows[2].number("fz"), WithinAbs(0.8 * 0.25 * 5.0, 1e-12));
}

TEST_CASE("with --damping-cutoff the force damps the filtered speed that the rows give",
          "[touch]") {
    const TemporaryFolder folder;
    write_stepping_hand(folder);
    const std::vector<Row> rows = touch_rows(folder, {"--damping", "5", "--damping-cutoff", "50"});
    const std::vector<Row> plain = touch_rows(folder, {"--damping", "5"});
    REQUIRE(rows.size() == 3000);
    const double pitch_mm = 101.6 / 720.0;
    const double time_constant_s = 1.0 / (100.0 * std::acos(-1.0));
    Vec3 speed_px_per_s{0.0};
    int contacts = 0;
    int others = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double passed_s = rows[k].number("t") - rows[k - 1].number("t");
        const double dt_s = passed_s > 0.0 ? passed_s : 0.001;
        const Vec3 newest = (rows[k].vector('g') - rows[k - 1].vector('g')) / dt_s;
        speed_px_per_s = (time_constant_s * speed_px_per_s + dt_s * newest) /
                         (time_constant_s + dt_s);  // backward Euler, in its other form
        const bool contact = rows[k].text.at("contact") == "1";
        const Vec3 spring = 0.5 * pitch_mm * (rows[k].vector('p') - rows[k].vector('g'));
        const Vec3 damper = 5.0 * 1e-3 * pitch_mm * speed_px_per_s;
        const Vec3 expected = contact ? spring - damper : Vec3(0.0);
        CAPTURE(k);
        REQUIRE(rows[k].vector('p') == plain[k].vector('p'));
        REQUIRE_THAT(glm::distance(rows[k].vector('f'), expected), WithinAbs(0.0, 1e-12));
        contacts += contact ? 1 : 0;
        others += rows[k].vector('f') != plain[k].vector('f') ? 1 : 0;
    }
    CHECK(contacts > 1000);
    CHECK(contacts < 2900);
    CHECK(others > 1000);
}

TEST_CASE("a cutoff of 0 is no filter, and the default", "[touch]") {
    const TemporaryFolder folder;
    write_stepping_hand(folder);
    std::vector<Row> rows = touch_rows(folder, {"--damping", "5", "--damping-cutoff", "0"});
    std::vector<Row> plain = touch_rows(folder, {"--damping", "5"});
    REQUIRE(rows.size() == plain.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].text.erase("ns");
        plain[k].text.erase("ns");
        REQUIRE(rows[k].text == plain[k].text);
    }
}

TEST_CASE("what is sent to the hand is limited and rises slowly", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 32, 32, 200);
    std::vector<Vec3> goals{{10, 10, 220}};
    for (int k = 0; k < 1000; ++k) goals.push_back({10, 10, std::fmax(20.0, 220.0 - k)});
    write_text(folder / "goals.csv", goals_csv(goals));
    const std::vector<Row> rows = touch_rows(folder, {});
    double sent_newton = 0.0;
    double most_newton = 0.0;
    for (const Row& row : rows) {
        const double now_newton = glm::length(row.vector('c'));
        REQUIRE(std::fabs(now_newton - sent_newton) <=
                SafetyLimits{}.max_change_newton_per_ms + 1e-12);
        sent_newton = now_newton;
        most_newton = std::fmax(most_newton, now_newton);
    }
    CHECK(rows.back().number("fz") > 8.0);
    CHECK_THAT(most_newton, WithinAbs(4.0, 1e-9));
}

TEST_CASE("a video's frames are blended in time, and it repeats", "[touch]") {
    const TemporaryFolder folder;
    copy_steps(folder);
    std::vector<Vec3> goals(801, Vec3{20, 20, 10});
    write_text(folder / "goals.csv", goals_csv(goals));

    const ProgramResult result = run_dibhr(folder, {"touch", "--video", "--raw-depth", "--depth",
                                                    "depth.mkv", "--goals", "goals.csv"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::vector<Row> rows = rows_of(result.output);
    REQUIRE(rows.size() == goals.size());
    const auto elevation_at = [&rows](std::size_t k) { return rows[k].number("pz"); };
    CHECK_THAT(elevation_at(50), WithinAbs(75.0, 1e-6));
    CHECK_THAT(elevation_at(100), WithinAbs(100.0, 1e-6));
    CHECK_THAT(elevation_at(175), WithinAbs(137.5, 1e-6));
    CHECK_THAT(elevation_at(250), WithinAbs(100.0, 1e-6));  // half way back to the first
    CHECK_THAT(elevation_at(350), WithinAbs(75.0, 1e-6));
    CHECK_THAT(elevation_at(650), WithinAbs(75.0, 1e-6));
}

TEST_CASE("without --video the first picture stands still", "[touch]") {
    const TemporaryFolder folder;
    copy_steps(folder);
    write_text(folder / "goals.csv", goals_csv(std::vector<Vec3>(300, Vec3{20, 20, 10})));
    const ProgramResult result =
        run_dibhr(folder, {"touch", "--raw-depth", "--depth", "depth.mkv", "--goals", "goals.csv"});
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(rows_of(result.output).back().number("pz"), WithinAbs(50.0, 1e-9));
}

TEST_CASE("carry is off unless it is asked for, and a picture that stands still carries nothing",
          "[touch]") {
    const TemporaryFolder folder;
    copy_steps(folder);
    std::filesystem::copy_file(folder / "depth.mkv", folder / "color.mkv");
    write_text(folder / "goals.csv", goals_csv(std::vector<Vec3>(150, Vec3{20, 20, 10})));
    const auto touched = [&](const std::vector<std::string>& more) {
        std::vector<std::string> options{"touch",     "--raw-depth", "--depth",
                                         "depth.mkv", "--goals",     "goals.csv"};
        options.insert(options.end(), more.begin(), more.end());
        ProgramResult result = run_dibhr(folder, options);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return result;
    };
    const auto force = [](const ProgramResult& result) {
        return rows_of(result.output).back().number("fz");
    };
    const ProgramResult plain = touched({"--video"});
    CHECK(force(touched({"--video", "--carry", "off"})) == force(plain));
    // The colour's view is the same, and nothing goes anywhere in the picture plane.
    CHECK(force(touched({"--video", "--carry", "on", "--color", "color.mkv"})) == force(plain));
    const ProgramResult still = touched({"--carry", "on"});
    CHECK(contains(still.errors, "--carry on changes nothing"));
    CHECK(contains(still.errors, "--video"));
    CHECK(contains(touched({"--in-betweens", "on"}).errors, "--in-betweens on changes nothing"));
    CHECK(run_dibhr(folder,
                    {"touch", "--depth", "depth.mkv", "--goals", "goals.csv", "--carry", "maybe"})
              .exit_code == 2);
    CHECK(run_dibhr(folder, {"touch", "--depth", "depth.mkv", "--goals", "goals.csv", "--color",
                             "color.mkv", "--out", "color.mkv"})
              .exit_code != 0);
}

TEST_CASE("with carry a finger that sticks is dragged along by what moves, and feels it",
          "[touch]") {
    const TemporaryFolder folder;
    // A texture that goes to the right by 2 px a frame, on a plane that stays where it is.
    run_shell(folder,
              "ffmpeg -nostdin -v error -f lavfi -i 'color=gray:s=400x200:d=0.04,noise=alls=90,"
              "gblur=sigma=1.5' -frames:v 1 texture.png && "
              "ffmpeg -nostdin -v error -loop 1 -framerate 30 -t 0.6 -i texture.png "
              "-vf 'crop=240:120:100-2*n:30' -c:v ffv1 color.mkv && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x808080:s=240x120:r=30:d=0.6,"
              "format=gray -c:v ffv1 depth.mkv");
    constexpr int kTicks = 500;
    std::vector<Vec3> goals(kTicks, Vec3{120, 60, 78});  // 50 px deep
    goals.front().z = 140.0;
    write_text(folder / "goals.csv", goals_csv(goals));
    const auto last = [&](const std::string& carry) {
        const ProgramResult result = run_dibhr(
            folder, {"touch", "--raw-depth", "--depth", "depth.mkv", "--color", "color.mkv",
                     "--video", "--goals", "goals.csv", "--friction", "1", "--carry", carry});
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return rows_of(result.output).back();
    };
    const double speed_px_per_s = 60.0;
    const double way_px = speed_px_per_s * 0.001 * (kTicks - 2);
    const Row carried = last("on");
    CHECK_THAT(carried.number("px") - 120.0, WithinAbs(way_px, 2.0));
    CHECK_THAT(carried.number("py") - 60.0, WithinAbs(0.0, 1.0));
    // A spring of 0.5 N/mm, stretched by the way that the surface carried the finger.
    const double drag_newton = 0.5 * way_px * 101.6 / 720.0;
    CHECK_THAT(carried.number("fx"), WithinAbs(drag_newton, 0.1 * drag_newton));
    const Row stays = last("off");
    CHECK(stays.number("px") == 120.0);
    CHECK(stays.number("fx") == 0.0);
}

TEST_CASE("with in-betweens an outline passes under a finger as one step, else it fades",
          "[touch]") {
    const TemporaryFolder folder;
    // A bright square that goes to the right by 8 px a frame, over a plane far below.
    run_shell(folder,
              "ffmpeg -nostdin -v error -f lavfi -i 'color=gray:s=80x80:d=0.04,noise=alls=90,"
              "gblur=sigma=1.5' -frames:v 1 square.png && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x303030:s=320x160:r=30:d=0.3 -loop 1 "
              "-framerate 30 -t 0.3 -i square.png -filter_complex "
              "'overlay=x=60+8*n:y=40' -pix_fmt yuv444p -c:v ffv1 color.mkv && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x101010:s=320x160:r=30:d=0.3 -f lavfi "
              "-i color=0xd0d0d0:s=80x80:r=30:d=0.3 -filter_complex "
              "'overlay=x=60+8*n:y=40,format=gray' -c:v ffv1 depth.mkv");
    // The square's front passes x = 160 between frames 2 and 3, at 76 ms.
    std::vector<Vec3> goals(100, Vec3{160, 80, 10});
    write_text(folder / "goals.csv", goals_csv(goals));
    const auto updates_between = [&](const std::string& in_betweens) {
        const ProgramResult result =
            run_dibhr(folder, {"touch", "--raw-depth", "--depth", "depth.mkv", "--color",
                               "color.mkv", "--video", "--goals", "goals.csv", "--friction", "1",
                               "--relief", "255", "--in-betweens", in_betweens});
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        const std::vector<Row> rows = rows_of(result.output);
        return std::count_if(rows.begin(), rows.end(), [](const Row& row) {
            return row.number("pz") > 30.0 && row.number("pz") < 190.0;
        });
    };
    CHECK(updates_between("off") > 20);  // of the 33 ms of a frame
    CHECK(updates_between("on") < 12);   // of a step on its way by 2 px at a time
}

TEST_CASE("a bar almost as narrow as its way in a frame carries a finger, unless it fades",
          "[touch]") {
    const TemporaryFolder folder;
    // 24 px wide, to the right by 20 px a frame (of which the first has number 1), over a plane far
    // below.
    run_shell(folder,
              "ffmpeg -nostdin -v error -f lavfi -i 'color=gray:s=24x80:d=0.04,noise=alls=90,"
              "gblur=sigma=1.5' -frames:v 1 bar.png && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x303030:s=480x160:r=30:d=0.5 -loop 1 "
              "-framerate 30 -t 0.5 -i bar.png -filter_complex "
              "'overlay=x=128+20*n:y=40' -pix_fmt yuv444p -c:v ffv1 color.mkv && "
              "ffmpeg -nostdin -v error -f lavfi -i color=0x101010:s=480x160:r=30:d=0.5 -f lavfi "
              "-i color=0xd0d0d0:s=24x80:r=30:d=0.5 -filter_complex "
              "'overlay=x=128+20*n:y=40,format=gray' -c:v ffv1 depth.mkv");
    std::vector<Vec3> goals;  // of a hand that goes along
    for (int k = 0; k < 350; ++k) goals.push_back({160.0 + 0.6 * k, 80.0, 200.0});
    goals.front().z = 215.0;
    write_text(folder / "goals.csv", goals_csv(goals));
    const auto astray_px = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"touch",     "--raw-depth", "--depth", "depth.mkv",
                                           "--color",   "color.mkv",   "--video", "--goals",
                                           "goals.csv", "--friction",  "3",       "--relief",
                                           "255",       "--carry",     "on"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        const Row last = rows_of(result.output).back();
        return std::hypot(last.number("px") - goals.back().x, last.number("pz") - 208.0);
    };
    CHECK(astray_px({}) < 2.0);
    CHECK(astray_px({"--in-betweens", "off"}) > 8.0);
}

TEST_CASE("a finished output file replaces the old one and leaves nothing beside it", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    write_text(folder / "goals.csv", goals_csv({{1, 1, 120}, {1, 1, 90}}));
    write_text(folder / "out.csv", "old");
    REQUIRE(touch_rows(folder, {"--out", "-"}).size() == 2);
    const ProgramResult result = run_dibhr(
        folder, {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--out", "out.csv"});
    REQUIRE(result.exit_code == 0);
    CHECK(result.output.empty());
    CHECK(rows_of(read_text(folder / "out.csv")).size() == 2);
    CHECK(names_in(folder.path()) == std::vector<std::string>{"depth.png", "goals.csv", "out.csv"});
}

TEST_CASE("the same input gives the same bits, but for the time it took", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 90, 90, 10, 2);
    write_text(folder / "goals.csv",
               goals_csv(circle_goals({44, 45, 60}, {1, 0, 0}, {0, 1, 0}, 30.0, 0.11, 300)));
    std::vector<Row> first = touch_rows(folder, {"--friction", "0.3"});
    std::vector<Row> second = touch_rows(folder, {"--friction", "0.3"});
    REQUIRE(first.size() == second.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        first[k].text.erase("ns");
        second[k].text.erase("ns");
        REQUIRE(first[k].text == second[k].text);
    }
}

TEST_CASE("more goals than a block holds, from a pipe, give the rows that their file gives",
          "[touch]") {
    constexpr int kGoals = 9000;
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 90, 90, 10, 2);
    write_text(folder / "goals.csv",
               goals_csv(circle_goals({44, 45, 60}, {1, 0, 0}, {0, 1, 0}, 30.0, 0.11, kGoals)));
    for (const std::string goals : {"goals.csv", "/dev/stdin"})
        run_shell(folder, "{ cat goals.csv | '" DIBHR_PROGRAM
                          "' touch --depth depth.png --raw-depth --goals " +
                              goals + " | sed 's/,[^,]*$//' > rows_$(basename " + goals + "); }");
    const std::string rows = read_text(folder / "rows_goals.csv");
    CHECK(std::count(rows.begin(), rows.end(), '\n') == kGoals + 2);  // the header, and the first
    CHECK(rows == read_text(folder / "rows_stdin"));
}

TEST_CASE("cleaning fills a hole that raw depth keeps", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "whole.png", 64, 64, 100);
    run_shell(folder, "ffmpeg -v error -i whole.png -vf drawbox=30:30:2:2:black:fill depth.png");
    write_text(folder / "goals.csv", goals_csv({{31, 31, 120}, {31, 31, 0}}));
    CHECK(touch_rows(folder, {}).back().number("pz") < 60.0);
    const ProgramResult result =
        run_dibhr(folder, {"touch", "--depth-range", "255:0", "--relief", "255", "--depth",
                           "depth.png", "--goals", "goals.csv"});
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(rows_of(result.output).back().number("pz"), WithinAbs(100.0, 1.0));
}

TEST_CASE(
    "a sidecar says how depth is cleaned and which finger touches, and the command line beats it",
    "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "whole.png", 64, 64, 100);
    run_shell(folder,
              "ffmpeg -v error -i whole.png -vf "
              "drawbox=26:26:8:8:white:fill,drawbox=48:48:2:2:black:fill depth.png");
    const auto height = [&](Vec3 goal, std::vector<std::string> options) {
        write_text(folder / "goals.csv", goals_csv({goal + Vec3{0.0, 0.0, 300.0}, goal}));
        options.insert(options.begin(),
                       {"touch", "--depth-range", "255:0", "--relief", "255", "--pixel-pitch", "1",
                        "--depth", "depth.png", "--goals", "goals.csv"});
        const ProgramResult result = run_dibhr(folder, options);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return rows_of(result.output).back().number("pz");
    };
    const Vec3 beside_box{35.0, 30.0, 250.0};
    const Vec3 hole{48.5, 48.5, 0.0};
    const double plain = height(beside_box, {});
    const double fingered = height(beside_box, {"--finger", "4"});
    CHECK(plain == 250.0);
    CHECK(fingered > plain + 1.0);
    write_text(folder / "depth.toml",
               "[depth]\nfinger = 4\ncleaning = [\"remove-spikes\", \"sharpen-silhouettes\"]\n");
    CHECK(height(beside_box, {}) == fingered);
    CHECK(height(beside_box, {"--finger", "0"}) == plain);
    CHECK(height(hole, {"--finger", "0"}) < 60.0);
    CHECK_THAT(height(hole, {"--finger", "0", "--cleaning", "auto"}), WithinAbs(100.0, 1.0));
    CHECK(height(beside_box, {"--raw-depth", "--finger", "0"}) ==
          height(beside_box, {"--raw-depth"}));
    write_text(folder / "depth.toml", "[depth]\ncleaning = [\"colour-edges\"]\n");
    const ProgramResult told =
        run_dibhr(folder, {"touch", "--depth", "depth.png", "--goals", "goals.csv"});
    CHECK(told.exit_code == 0);
    CHECK(contains(told.errors, "the colour's edges"));
}

TEST_CASE("a roughness without a bump map is told to change nothing, on stderr alone", "[touch]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    write_depth_png(folder / "bumps.png", 16, 12, 0, 10);
    write_text(folder / "goals.csv", goals_csv({{1, 1, 120}, {1, 1, 90}}));
    const std::vector<std::string> rough{"touch",     "--depth",     "depth.png", "--goals",
                                         "goals.csv", "--roughness", "5"};
    const ProgramResult result = run_dibhr(folder, rough);
    CHECK(result.exit_code == 0);
    CHECK(rows_of(result.output).size() == 2);
    CHECK(result.errors.starts_with("dibhr: warning: --roughness changes nothing"));
    CHECK(split(result.errors, '\n').size() == 2);
    std::vector<std::string> bumpy = rough;
    bumpy.insert(bumpy.end(), {"--bump", "bumps.png"});
    CHECK(run_dibhr(folder, bumpy).errors.empty());
}

TEST_CASE("a jump too long for one update is caught up with in the next ones, and stderr says so",
          "[touch]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i \"nullsrc=s=1200x20,format=gray,"
              "geq=lum='100+mod(X*X+7*Y,3)'\" -frames:v 1 depth.png");
    std::vector<Vec3> goals(10, Vec3{1190, 10, 80});
    goals[0] = {5, 10, 120};
    goals[1] = {5, 10, 80};
    write_text(folder / "goals.csv", goals_csv(goals));
    const ProgramResult result =
        run_dibhr(folder, {"touch", "--raw-depth", "--friction", "0", "--depth", "depth.png",
                           "--goals", "goals.csv"});
    REQUIRE(result.exit_code == 0);
    CAPTURE(result.errors);
    CHECK(std::stoi(split(result.errors, ' ').at(1)) >= 2);
    CHECK(result.errors.ends_with(
        " of 10 updates ended before the proxy had caught up with its goal\n"));
    CHECK(split(result.errors, '\n').size() == 2);
    const std::vector<Row> rows = rows_of(result.output);
    CHECK(rows[2].number("px") < 900.0);
    CHECK(rows[3].number("px") > rows[2].number("px") + 100.0);
    CHECK(rows.back().number("px") > 1150.0);  // it rests in a pit near the goal
}
