// Materials: their files, how they are laid over a surface, and how the user's own are saved.
#include "app/settings/material.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

namespace fs = std::filesystem;

constexpr const char* kOak =
    "map = \"oak.png\"\nwidth = 16\nheight = 2\nstatic-friction = 0.7\n"
    "dynamic-friction = 0.5\nstiffness = 0.75\ndamping = 1.5\n";

/// A material and its map of 16 x 8 pixels.
fs::path write_oak(const fs::path& folder, const std::string& toml = kOak) {
    fs::create_directories(folder);
    write_depth_png(folder / "oak.png", 16, 8, 0, 10);
    write_text(folder / "oak.toml", toml);
    return folder / "oak.toml";
}

std::string said_of(const fs::path& file) {
    try {
        static_cast<void>(read_material(file));
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// A stroke over level 100, in and out.
void write_stroke(const fs::path& file) {
    std::string csv = "t,x,y,z\n";
    for (int k = 0; k < 200; ++k)
        csv += std::to_string(0.001 * k) + "," + std::to_string(5.0 + 0.25 * k) + ",20," +
               std::to_string(k == 0 ? 130.0 : 96.0 + 0.5 * (k % 9)) + "\n";
    write_text(file, csv);
}

/// The rows of `dibhr touch` without the time of each update, which differs from run to run.
std::vector<std::string> without_times(const std::string& csv) {
    std::vector<std::string> rows = split(csv, '\n');
    for (std::string& row : rows) row.resize(std::min(row.rfind(','), row.size()));
    return rows;
}

/// During its life, settings and the user's own materials are in this folder.
struct OwnSettings {
    TemporaryFolder folder{};
    EnvironmentVariable home{"XDG_CONFIG_HOME", folder.path().c_str()};
};

}  // namespace

TEST_CASE("a material says what it looks like: tint and gloss and fuzz") {
    const TemporaryFolder folder;
    const Material plain = read_material(write_oak(folder / "plain"));
    CHECK(plain.look.is_plain());
    const Material oak = read_material(
        write_oak(folder / "dark", std::string(kOak) + "tint = \"#804020\"\ntint-share = 0.5\n"
                                                       "gloss = 0.25\nfuzz = 0.125\n"));
    CHECK(oak.look ==
          SurfaceLook{{128.0F / 255.0F, 64.0F / 255.0F, 32.0F / 255.0F}, 0.5, 0.25, 0.125});
    for (const char* tint : {"804020", "#80402", "#8040201", "#80402g", "brown"}) {
        const std::string told =
            said_of(write_oak(folder / "bad", std::string(kOak) + "tint = \"" + tint + "\"\n"));
        CAPTURE(tint, told);
        CHECK(contains(told, "oak.toml:8: tint is not a colour"));
    }
    CHECK(contains(said_of(write_oak(folder / "loud", std::string(kOak) + "gloss = 1.5\n")),
                   "gloss is not a number from 0 to 1"));
}

TEST_CASE("each material of the program looks like no other") {
    std::vector<SurfaceLook> looks;
    for (const std::string& name : material_names().shipped) {
        const SurfaceLook look = material_named(name).look;
        CAPTURE(name);
        CHECK_FALSE(look.is_plain());
        CHECK(std::find(looks.begin(), looks.end(), look) == looks.end());
        looks.push_back(look);
    }
    CHECK(looks.size() == 9);
}

TEST_CASE("a material's file gives its numbers and the map beside it", "[material]") {
    const TemporaryFolder folder;
    const Material oak = read_material(write_oak(folder / "wood"));
    CHECK(oak.name == "oak");
    CHECK(oak.map == folder / "wood/oak.png");
    REQUIRE(oak.bumps);
    CHECK(oak.bumps->columns == 16);
    CHECK(oak.width_mm == 16.0);
    CHECK(oak.height_mm == 2.0);
    CHECK(oak.friction == Friction{0.7, 0.5});
    CHECK(oak.stiffness_newton_per_mm == 0.75);
    CHECK(oak.damping_newton_s_per_m == 1.5);
}

TEST_CASE("what a material's file lacks is told with its line", "[material]") {
    const TemporaryFolder folder;
    const auto [toml, told] = GENERATE(table<std::string, std::string>({
        {"stifness = 1\n", "oak.toml:1: 'stifness' is not a property of a material"},
        {"width = 3\nstiffness = \"soft\"\n", "oak.toml:2: stiffness is not a number from 0 to 10"},
        {"width = 0\n", "oak.toml:1: width is not a number from 0.1 to 1000"},
        {"damping = nan\n", "oak.toml:1: damping is not a number"},
        {"sound-hiss = 1.5\n", "oak.toml:1: sound-hiss is not a number from 0 to 1"},
        {"sound-frequency = 0\n", "oak.toml:1: sound-frequency is not a number from 20 to 8000"},
        {"map = 3\n", "oak.toml:1: map is not the name of a picture"},
        {"map = \"elm.png\"\n", "elm.png"},
        {"width = \n", "oak.toml:1: cannot be understood"},
        {"static-friction = 0.2\n", "dynamic friction is above its static friction"},
    }));
    const std::string said = said_of(write_oak(folder.path(), toml));
    CAPTURE(said);
    CHECK(contains(said, told));
    CHECK_FALSE(contains(said, "\n"));
}

TEST_CASE("a material's bumps have their millimetres whatever a pixel's size", "[material]") {
    const TemporaryFolder folder;
    const Material oak = read_material(write_oak(folder.path()));
    for (const double pitch_mm : {0.05, 0.1411, 0.4, 2.0}) {
        CAPTURE(pitch_mm);
        TouchParameters parameters;
        parameters.coupling.pixel_pitch_mm = pitch_mm;
        apply_material(oak, parameters);
        CHECK_THAT(parameters.shape.roughness_px * pitch_mm, WithinRel(2.0, 1e-12));
        // 16 columns: where 8 pixels are more than 16 mm, the map is laid larger.
        CHECK_THAT(parameters.shape.bump_size_px, WithinRel(std::max(16.0 / pitch_mm, 8.0), 1e-12));
        CHECK(parameters.friction == oak.friction);
        CHECK(is_made_of(oak, parameters));
        parameters.friction.static_coefficient += 0.1;
        CHECK(has_texture(oak, parameters));
        CHECK_FALSE(is_made_of(oak, parameters));
        apply_material({}, parameters);
        TouchParameters plain;
        plain.coupling.pixel_pitch_mm = pitch_mm;
        CHECK(parameters == plain);
    }
}

TEST_CASE("a person's own material is kept with its map, comes back, and can be taken elsewhere",
          "[material]") {
    const OwnSettings own;
    const TemporaryFolder folder;
    TouchParameters parameters;
    parameters.coupling.pixel_pitch_mm = 0.1;
    apply_material(read_material(write_oak(folder.path())), parameters);
    parameters.friction = {1.0, 0.25};
    write_depth_png(folder / "elsewhere.png", 16, 8, 0, 10);
    const auto bumps = read_material(folder / "oak.toml").bumps;
    Material mine = material_of(parameters, folder / "elsewhere.png", bumps, 640);
    mine.name = "my oak";
    mine.sound = {321.5, 0.125, 0.75, 0.0625, 0.3};
    const fs::path file = save_material(mine);
    CHECK(file == own_materials_folder() / "my oak.toml");
    CHECK(material_names().own == std::vector<std::string>{"my oak"});
    fs::remove(folder / "elsewhere.png");

    const fs::path elsewhere = folder / "another machine";
    fs::copy(own_materials_folder(), elsewhere, fs::copy_options::recursive);
    for (const Material& material :
         {material_named("my oak"), material_named((elsewhere / "my oak.toml").string())}) {
        TouchParameters again;
        again.coupling.pixel_pitch_mm = 0.1;
        apply_material(material, again);
        CHECK_THAT(again.shape.roughness_px, WithinAbs(parameters.shape.roughness_px, 1e-9));
        CHECK_THAT(again.shape.bump_size_px, WithinAbs(parameters.shape.bump_size_px, 1e-9));
        CHECK(again.friction == parameters.friction);
        CHECK(material.sound == mine.sound);
        CHECK(material.bumps->heights == bumps->heights);
    }
    CHECK_NOTHROW(save_material(material_named("my oak")));  // replaces itself
    CHECK(material_named("my oak").bumps->heights == bumps->heights);
}

TEST_CASE("a bump map stretched over the whole surface is kept as wide as that", "[material]") {
    const TemporaryFolder folder;
    const Material oak = read_material(write_oak(folder.path()));
    TouchParameters parameters;
    parameters.coupling.pixel_pitch_mm = 0.1;
    parameters.shape.roughness_px = 4.0;
    const Material mine = material_of(parameters, oak.map, oak.bumps, 640);
    CHECK_THAT(mine.width_mm, WithinAbs(64.0, 1e-9));
    CHECK_THAT(mine.height_mm, WithinAbs(0.4, 1e-9));
}

TEST_CASE("a name that is none for a file, or comes with the program, is refused", "[material]") {
    const OwnSettings own;
    for (const std::string name :
         {"", "../up", "a/b", ".hidden", " oak", "oak ", "as-recorded", "bark"}) {
        CAPTURE(name);
        Material material;
        material.name = name;
        CHECK_THROWS_AS(save_material(material), InputError);
        CHECK_FALSE(fs::exists(own_materials_folder()));
    }
}

TEST_CASE("all materials that come with the program can be laid, and feel different",
          "[material]") {
    const std::vector<std::string> names = material_names().shipped;
    CHECK(names == std::vector<std::string>{"bark", "ice", "linen", "rubber", "sandpaper", "skin",
                                            "stone", "wood", "wool"});
    std::vector<TouchParameters> all(1);
    for (const std::string& name : names) {
        CAPTURE(name);
        const Material material = material_named(name);
        CHECK(material.bumps);
        TouchParameters parameters;
        apply_material(material, parameters);
        CHECK(is_made_of(material, parameters));
        CHECK(parameters.shape.roughness_px > 0.0);
        for (const TouchParameters& other : all) CHECK(parameters != other);
        all.push_back(parameters);
    }
}

TEST_CASE("a material that nobody knows is told with those there are", "[material]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    const ProgramResult told =
        run_dibhr(folder, {"touch", "--depth", "depth.png", "--goals", "-", "--material", "oak"});
    CHECK(told.exit_code == 1);
    CHECK(contains(told.errors, "no material is called 'oak': there are as-recorded, bark, ice"));
}

TEST_CASE("--material is its bump map, size, roughness, friction, stiffness and damping",
          "[material]") {
    const TemporaryFolder folder;
    write_oak(folder.path());
    write_depth_png(folder / "depth.png", 64, 48, 100);
    write_stroke(folder / "goals.csv");
    const auto felt = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"touch",     "--depth",     "depth.png",     "--goals",
                                           "goals.csv", "--raw-depth", "--pixel-pitch", "0.2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        CHECK(result.errors.empty());
        return without_times(result.output);
    };
    const std::vector<std::string> numbers{"--bump",
                                           "oak.png",
                                           "--bump-size",
                                           "80",
                                           "--roughness",
                                           "10",
                                           "--static-friction",
                                           "0.7",
                                           "--dynamic-friction",
                                           "0.5",
                                           "--stiffness",
                                           "0.75",
                                           "--damping",
                                           "1.5"};
    const auto same = [&](const std::vector<std::string>& a, const std::vector<std::string>& b) {
        return felt(a) == felt(b);
    };
    const std::vector<std::string> oak{"--material", "oak.toml"};
    CHECK(same(oak, numbers));
    CHECK_FALSE(same(oak, {}));
    CHECK(same({"--material", "as-recorded"}, {}));
    // A number with its own option wins over the material, in any order.
    auto slippery = numbers;
    slippery[7] = slippery[9] = "0";
    CHECK(same({"--friction", "0", "--material", "oak.toml"}, slippery));
    auto smooth = numbers;
    smooth[5] = "3";
    CHECK(same({"--material", "oak.toml", "--roughness", "3"}, smooth));
}

TEST_CASE("a bump map by itself is rough enough to be felt", "[material]") {
    const TemporaryFolder folder;
    write_oak(folder.path());
    write_depth_png(folder / "depth.png", 16, 8, 100);
    const auto top = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"surface", "depth.png", "--out", "felt.pfm"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        CHECK(result.exit_code == 0);
        return result.output;
    };
    CHECK(top({"--bump", "oak.png"}) != top({}));
    CHECK(top({"--bump", "oak.png", "--roughness", "0"}) == top({}));
}

TEST_CASE("a session is replayed through a material", "[material]") {
    const TemporaryFolder folder;
    write_oak(folder.path());
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i testsrc2=size=120x90:rate=30:duration=0.5,format=gray "
              "-c:v ffv1 film_depth.mkv; ffmpeg -v error -i film_depth.mkv -c:v ffv1 "
              "-pix_fmt bgr0 film_color.mkv");
    RecordedSession session{.colour = folder / "film_color.mkv",
                            .depth = folder / "film_depth.mkv"};
    record_session(folder / "mine.dibhr", session);
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr", "--csv", "mine.csv"}).exit_code == 0);
    const ProgramResult oak =
        run_dibhr(folder, {"replay", "mine.dibhr", "--material", "oak.toml", "--csv", "oak.csv"});
    CHECK(oak.exit_code == 0);
    CHECK(oak.errors.empty());
    const auto rows = [&folder](const char* file) {
        return without_times(read_text(folder / file));
    };
    const bool differs = rows("oak.csv") != rows("mine.csv");
    CHECK(differs);
    // Recorded over it, it comes again bit for bit; whoever replays that as recorded leaves it on.
    apply_material(read_material(folder / "oak.toml"), session.parameters);
    session.bump = folder / "oak.png";
    record_session(folder / "with.dibhr", session);
    CHECK(contains(run_dibhr(folder, {"replay", "with.dibhr"}).output, "identical, bit for bit"));
}
