// `dibhr surface` as scripts use it: files in, a surface out, equal to the touched one.
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Elevations of a PFM file, the upper row first.
struct Elevations {
    int columns{0};
    int rows{0};
    std::vector<float> px{};

    float at(int i, int j) const {
        return px[static_cast<std::size_t>(rows - 1 - j) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(i)];
    }
};

Elevations read_pfm(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    const std::vector<std::string> head = split(bytes.substr(0, bytes.find("-1.0\n")), '\n');
    REQUIRE(head.at(0) == "Pf");
    Elevations read;
    const std::size_t gap = head.at(1).find(' ');
    read.columns = std::stoi(head[1].substr(0, gap));
    read.rows = std::stoi(head[1].substr(gap));
    read.px.resize(static_cast<std::size_t>(read.columns) * static_cast<std::size_t>(read.rows));
    const std::size_t size = read.px.size() * sizeof(float);
    REQUIRE(bytes.size() > size);
    std::memcpy(read.px.data(), bytes.data() + bytes.size() - size, size);
    return read;
}

/// Runs `dibhr surface` and returns its output.
std::string surface(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "surface");
    const ProgramResult result = run_dibhr(folder, arguments);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    REQUIRE(result.errors.empty());
    return result.output;
}

Elevations elevations(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--out", "out.pfm"});
    surface(folder, arguments);
    return read_pfm(folder / "out.pfm");
}

/// Levels 50, 100 and 150 at 10 frames a second.
void write_rising_film(const TemporaryFolder& folder) {
    for (int k = 0; k < 3; ++k)
        write_depth_png(folder / ("f" + std::to_string(k) + ".png"), 64, 48, 50 + 50 * k);
    run_shell(folder, "ffmpeg -v error -framerate 10 -i f%d.png -pix_fmt gray -c:v ffv1 depth.mkv");
}

void check_refused(const ProgramResult& result, int exit_code, const std::string& words) {
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    CHECK(split(result.errors, '\n').size() == 2);
    CHECK(contains(result.errors, words));
}

}  // namespace

TEST_CASE("surface writes the elevations of a picture and says in one line how high they are",
          "[surface]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "color.png", 40, 30, 200);
    write_depth_png(folder / "depth.png", 40, 30, 51, 3);
    const std::string said = surface(folder, {"color.png", "depth.png", "--raw-depth", "--relief",
                                              "100", "--pixel-pitch", "0.5", "--out", "a.pfm"});
    CHECK(said == "a.pfm: 40 x 30, elevation 20 to 65.882 px, 10 to 32.941 mm\n");
    const Elevations read = read_pfm(folder / "a.pfm");
    REQUIRE(read.columns == 40);
    REQUIRE(read.rows == 30);
    for (int j = 0; j < 30; ++j) {
        for (int i = 0; i < 40; ++i)
            REQUIRE_THAT(read.at(i, j), WithinAbs(100.0 * (51 + 3 * i) / 255.0, 1e-5));
    }
}

TEST_CASE("surface finds the depth beside the colour, and takes depth alone", "[surface]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "color.png", 20, 20, 10);
    write_depth_png(folder / "depth.png", 20, 20, 90);
    CHECK(elevations(folder, {"color.png", "--raw-depth"}).at(3, 3) == 90.0F);
    CHECK(elevations(folder, {"depth.png", "--raw-depth"}).at(3, 3) == 90.0F);
    surface(folder, {"color.png", "--out", "a.ply"});
    CHECK(contains(read_text(folder / "a.ply"), "property uchar red"));
    surface(folder, {"depth.png", "--out", "a.ply"});
    CHECK_FALSE(read_text(folder / "a.ply").find("red") != std::string::npos);
}

TEST_CASE(
    "between two frames the surface is blended as in playing, and the last frame stays until "
    "the end",
    "[surface]") {
    const TemporaryFolder folder;
    write_rising_film(folder);
    const auto height_at = [&folder](const std::string& time_s) {
        return elevations(folder, {"depth.mkv", "--raw-depth", "--time", time_s}).at(20, 20);
    };
    CHECK_THAT(height_at("0"), WithinAbs(50.0, 1e-4));
    CHECK_THAT(height_at("0.05"), WithinAbs(75.0, 1e-4));
    CHECK_THAT(height_at("0.1"), WithinAbs(100.0, 1e-4));
    CHECK_THAT(height_at("0.18"), WithinAbs(140.0, 1e-4));
    CHECK_THAT(height_at("0.25"), WithinAbs(150.0, 1e-4));
    CHECK_THAT(height_at("0.2999"), WithinAbs(150.0, 1e-4));
}

TEST_CASE("a time at or beyond the end is refused with the duration", "[surface]") {
    const TemporaryFolder folder;
    write_rising_film(folder);
    for (const std::string time_s : {"0.3", "1000"}) {
        check_refused(
            run_dibhr(folder, {"surface", "depth.mkv", "--time", time_s, "--out", "a.pfm"}), 1,
            "'depth.mkv' lasts 0.3 s");
    }
    write_depth_png(folder / "depth.png", 20, 20, 90);
    check_refused(run_dibhr(folder, {"surface", "depth.png", "--time", "0.1", "--out", "a.pfm"}), 1,
                  "still picture");
    CHECK_FALSE(std::filesystem::exists(folder / "a.pfm"));
}

TEST_CASE("the ending of --out says the form, and another one is bad usage", "[surface]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 20, 20, 90);
    for (const std::string out : {"-", "a.obj", "a", ".pfm"}) {
        check_refused(run_dibhr(folder, {"surface", "depth.png", "--out", out}), 2, ".stl");
    }
    check_refused(run_dibhr(folder, {"surface", "depth.png"}), 2, "--out");
    check_refused(run_dibhr(folder, {"surface", "--out", "a.pfm"}), 2, "COLOR");
    CHECK(names_in(folder.path()) == std::vector<std::string>{"depth.png"});
}

TEST_CASE("surface never writes over what it reads, and leaves nothing when it fails",
          "[surface]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 20, 20, 90);
    check_refused(run_dibhr(folder, {"surface", "depth.png", "--out", "./depth.png"}), 1,
                  "is also read by this command");
    write_text(folder / "broken_depth.png", "\x89PNG\r\n\x1a\n");
    check_refused(run_dibhr(folder, {"surface", "broken_depth.png", "--out", "a.stl"}), 1,
                  "broken_depth.png");
    check_refused(run_dibhr(folder, {"surface", "depth.png", "--out", "no/where.stl"}), 1,
                  "no/where.stl");
    CHECK(names_in(folder.path()) == std::vector<std::string>{"broken_depth.png", "depth.png"});
}

TEST_CASE("a PNG relief is touched as the surface it was made of", "[surface]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 60, 40, 30, 2);
    write_depth_png(folder / "bump.png", 8, 8, 0, 9);
    const std::vector<std::string> shape{"--relief", "120",         "--bump",
                                         "bump.png", "--roughness", "9"};
    const auto with_shape = [&shape](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), shape.begin(), shape.end());
        return arguments;
    };
    CHECK(contains(surface(folder, with_shape({"depth.png", "--out", "relief.png"})),
                   ", white is 129 px\n"));
    const Elevations felt = elevations(folder, with_shape({"depth.png"}));
    write_text(folder / "goals.csv", "t,x,y,z\n0,30,20,200\n0.001,30,20,20\n");
    const ProgramResult touched =
        run_dibhr(folder, {"touch", "--raw-depth", "--relief", "129", "--depth", "relief.png",
                           "--goals", "goals.csv", "--friction", "5"});
    REQUIRE(touched.exit_code == 0);
    const std::vector<std::string> row = split(split(touched.output, '\n').at(2), ',');
    CHECK(std::stod(row.at(4)) == 30.0);
    CHECK_THAT(std::stod(row.at(6)), WithinAbs(felt.at(30, 20), 129.0 / 65535.0));
}

TEST_CASE("a large surface is written in little more memory than it takes to read it",
          "[surface]") {
    const TemporaryFolder folder;
    // Large: the peak that the system tells has the memory of this test in it, too.
    constexpr int kColumns = 3840;
    constexpr int kRows = 2160;
    write_depth_png(folder / "depth.png", kColumns, kRows, 90);
    write_text(folder / "goals.csv", "t,x,y,z\n0,9,9,99\n");
    const std::size_t reading =
        run_dibhr(folder, {"touch", "--depth", "depth.png", "--goals", "goals.csv"})
            .peak_memory_bytes;
    constexpr std::size_t kOneMore = std::size_t{kColumns} * kRows * sizeof(float);
    for (const std::string name : {"a.png", "a.stl"}) {
        const ProgramResult result = run_dibhr(folder, {"surface", "depth.png", "--out", name});
        REQUIRE(result.exit_code == 0);
        CHECK(result.peak_memory_bytes < reading + kOneMore / 2);
        std::filesystem::remove(folder / name);
    }
}

TEST_CASE("what is cleaned is what was asked for: nothing, or what the noise of the clip asks for",
          "[surface]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i color=0x808080:s=160x120:r=30 -frames:v 12 "
              "-vf format=gray,noise=alls=8:allf=t -pix_fmt gray -c:v ffv1 depth.mkv");
    const auto cleaned = [&](const std::string& word) {
        return elevations(folder, {"depth.mkv", "--time", "0.2", "--cleaning", word});
    };
    const auto roughness_px = [](const Elevations& surface) {
        double sum = 0.0;
        double squares = 0.0;
        for (const float px : surface.px) {
            sum += static_cast<double>(px);
            squares += static_cast<double>(px) * static_cast<double>(px);
        }
        const auto count = static_cast<double>(surface.px.size());
        return std::sqrt(squares / count - sum * sum / count / count);
    };
    const Elevations automatic = cleaned("auto");
    const double automatic_px = roughness_px(automatic);
    const double gentle_px = roughness_px(cleaned("gentle"));
    CHECK(automatic_px < 0.1 * gentle_px);
    CHECK(gentle_px < roughness_px(cleaned("raw")));
    CHECK(cleaned("sensor").px == automatic.px);
    CHECK(elevations(folder, {"depth.mkv", "--time", "0.2"}).px == automatic.px);
    check_refused(
        run_dibhr(folder, {"surface", "depth.mkv", "--out", "out.pfm", "--cleaning", "polish"}), 2,
        "'polish' is none of auto, raw, gentle, sensor");
}

TEST_CASE("without cleaning, millimetres still are distances, and only holes stay open",
          "[surface]") {
    const TemporaryFolder folder;
    const auto is_hole = [](int i, int j) { return i >= 20 && i < 24 && j >= 10 && j < 14; };
    std::string pixels = "P5 40 30 65535\n";
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i) {
            const int mm = is_hole(i, j) ? 0 : 1000 + 50 * i;
            pixels += static_cast<char>(mm >> 8);
            pixels += static_cast<char>(mm & 0xff);
        }
    write_text(folder / "depth.pgm", pixels);
    const Elevations raw = elevations(folder, {"depth.pgm", "--cleaning", "raw"});
    const Elevations cleaned = elevations(folder, {"depth.pgm", "--cleaning", "gentle"});
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i) {
            CAPTURE(i, j);
            if (!is_hole(i, j)) REQUIRE(raw.at(i, j) == cleaned.at(i, j));
        }
    CHECK(raw.at(0, 20) > raw.at(39, 20) + 10.0F);
    CHECK(raw.at(21, 12) == 0.0F);
    CHECK(cleaned.at(21, 12) > 1.0F);
}

TEST_CASE("a fingertip of a radius rounds what stands out and cannot enter what is narrower",
          "[surface]") {
    const TemporaryFolder folder;
    std::string pixels = "P5 80 40 255\n";
    for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 80; ++i)
            pixels += static_cast<char>(i >= 20 && i < 23 ? 110 : i == 60 ? 20 : 100);
    write_text(folder / "depth.pgm", pixels);
    const auto felt = [&](const std::string& finger_mm) {
        return elevations(folder, {"depth.pgm", "--raw-depth", "--relief", "255", "--pixel-pitch",
                                   "2", "--finger", finger_mm});
    };
    const Elevations point = felt("0");
    CHECK_THAT(point.at(60, 20), WithinAbs(20.0, 0.01));
    CHECK_THAT(point.at(24, 20), WithinAbs(100.0, 0.01));
    const Elevations ball = felt("10");  // 5 px
    CHECK_THAT(ball.at(21, 20), WithinAbs(110.0, 0.01));
    for (const int away_px : {1, 2, 3, 4}) {
        const double lower_px = 5.0 - std::sqrt(25.0 - away_px * away_px);
        CHECK_THAT(ball.at(22 + away_px, 20), WithinAbs(110.0 - lower_px, 0.02));
    }
    CHECK_THAT(ball.at(30, 20), WithinAbs(100.0, 0.01));
    CHECK_THAT(ball.at(60, 20), WithinAbs(100.0 - (5.0 - std::sqrt(24.0)), 0.02));
    check_refused(run_dibhr(folder, {"surface", "depth.pgm", "--out", "out.pfm", "--finger", "-1"}),
                  2, "--finger");
}
