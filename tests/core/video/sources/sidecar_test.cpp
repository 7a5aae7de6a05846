// Sidecars, and whose word counts on what depth means.
#include "core/video/sources/sidecar.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files/names.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinRel;

namespace {

DepthStatement everything() {
    return {.near = NearLevels::dark,
            .unit = DepthUnit::m,
            .scale = 0.1 + 0.2,  // needs 17 digits
            .range = DepthRange{1.0 / 3.0, 1e-300},
            .no_data = std::vector<double>{0.0, 65535.0, -2.5},
            .packing = DepthPacking::bottom_top,
            .code = DepthCode::hue,
            .geometry = Geometry::true_shape,
            .intrinsics = Intrinsics{525.0, 525.12345678901234, 319.5, -0.1},
            .registration = Registration{-3.25, 0.1, 1.01},
            .cleaning = CleaningChoice{CleaningPreset::own,
                                       {.fill_holes = true, .colour_edges = true, .steady = true}},
            .finger_mm = 1.0 / 3.0,
            .times = DepthTimes::paired,
            .time_offset_s = -1.0 / 3.0,
            .frames_per_s = 30000.0 / 1001.0};
}

template <typename Value>
Known<Value> known(Value value, Origin origin) {
    return {std::move(value), origin};
}

/// A table of one fact.
std::string table(const std::string& fact) {
    return "[depth]\n" + fact + "\n";
}

DepthStatement said_by(const std::string& fact) {
    return statement_in(table(fact), "a");
}

/// Millimetres without holes, 1000 to 1063.
void write_ramp(const std::filesystem::path& file) {
    write_picture(file, 64, 48, 16, 1, [](int i, int, int) { return 1000 + i; });
}

}  // namespace

TEST_CASE("what a sidecar says reads back to the same bits", "[sidecar]") {
    CHECK(statement_in(toml_of(everything()), "a") == everything());
    CHECK(statement_in(toml_of({}), "a") == DepthStatement{});
    const DepthStatement nothing_lacks{.no_data = std::vector<double>{}};
    CHECK(statement_in(toml_of(nothing_lacks), "a") == nothing_lacks);
    for (const NearLevels near : kNearLevels)
        CHECK(statement_in(toml_of({.near = near}), "a").near == near);
    for (const DepthUnit unit : kDepthUnits)
        CHECK(statement_in(toml_of({.unit = unit}), "a").unit == unit);
    for (const DepthPacking packing : kDepthPackings)
        CHECK(statement_in(toml_of({.packing = packing}), "a").packing == packing);
    for (const DepthTimes times : kDepthTimes)
        CHECK(statement_in(toml_of({.times = times}), "a").times == times);
}

TEST_CASE("a sidecar is written beside its file and read again", "[sidecar]") {
    const TemporaryFolder folder;
    CHECK_FALSE(read_sidecar(folder / "clip.mkv"));
    write_sidecar(folder / "clip.mkv", everything());
    CHECK(std::filesystem::exists(folder / "clip.toml"));
    CHECK(read_sidecar(folder / "clip.mkv") == everything());
    // A folder's is called as the folder, with and without a slash at its end.
    std::filesystem::create_directory(folder / "frames");
    write_sidecar(folder / "frames/", everything());
    CHECK(std::filesystem::exists(folder / "frames.toml"));
    CHECK(read_sidecar(folder / "frames") == everything());
}

TEST_CASE("a sidecar may keep its file's ending, and is then written there", "[sidecar]") {
    const TemporaryFolder folder;
    write_text(folder / "clip.mkv.toml", table("unit = \"mm\""));
    REQUIRE(read_sidecar(folder / "clip.mkv"));
    CHECK(read_sidecar(folder / "clip.mkv")->unit == DepthUnit::mm);
    write_sidecar(folder / "clip.mkv", everything());
    CHECK_FALSE(std::filesystem::exists(folder / "clip.toml"));
    CHECK(read_sidecar(folder / "clip.mkv") == everything());
}

TEST_CASE("a fact's name may be written as the command line and as a table has it", "[sidecar]") {
    for (const std::string name : {"depth-unit", "depth_unit", "unit"}) {
        CAPTURE(name);
        CHECK(said_by(name + " = \"disparity\"").unit == DepthUnit::disparity);
    }
    CHECK(said_by("depth-times = \"own\"").times == DepthTimes::own);
    CHECK(said_by("depth-offset = -0.05").time_offset_s == -0.05);
    CHECK(said_by("depth_fps = 29.97").frames_per_s == 29.97);
    for (const std::string name : {"no-data", "no_data"}) {
        CAPTURE(name);
        CHECK(said_by(name + " = [0]").no_data == std::vector<double>{0.0});
    }
}

TEST_CASE("numbers may be a list, or a text as the command line has it", "[sidecar]") {
    const DepthRange range{500.0, 4000.0};
    for (const std::string text : {"\"500:4000\"", "[500, 4000]", "[500.0, 4e3]"}) {
        CAPTURE(text);
        CHECK(said_by("range = " + text).range == range);
    }
    for (const std::string text : {"\"0,65535\"", "[0, 65535]"}) {
        CAPTURE(text);
        CHECK(said_by("no-data = " + text).no_data == std::vector<double>{0.0, 65535.0});
    }
    CHECK(said_by("no-data = 0").no_data == std::vector<double>{0.0});
    CHECK(said_by("no-data = \"\"").no_data == std::vector<double>{});
    CHECK(said_by("intrinsics = \"525,524,320,240\"").intrinsics ==
          Intrinsics{525.0, 524.0, 320.0, 240.0});
}

TEST_CASE(
    "a stated camera of larger pictures is scaled, one beside the picture is left out and said",
    "[sidecar]") {
    const TemporaryFolder folder;
    write_depth(folder / "depth.png", 1, 424, 240);
    DepthRequest request{.find_out = true};
    request.command_line.unit = DepthUnit::mm;
    const auto [stated, camera, said] =
        GENERATE(table<Intrinsics, std::optional<Intrinsics>, std::string>(
            {{Intrinsics{420.0, 422.0, 423.5, 239.5}, Intrinsics{210.0, 211.0, 211.5, 119.5},
              "2 times as large"},
             {Intrinsics{210.0, 211.0, 205.0, 125.0}, Intrinsics{210.0, 211.0, 205.0, 125.0}, ""},
             {Intrinsics{210.0, 211.0, 60.0, 119.5}, Intrinsics{210.0, 211.0, 60.0, 119.5}, ""},
             {Intrinsics{210.0, 211.0, 600.0, 119.5}, std::nullopt,
              "is outside the picture of 424 x 240"}}));
    CAPTURE(said);
    request.command_line.intrinsics = stated;
    const auto media = open_depth(folder / "depth.png", request);
    CHECK(media->description().meaning->intrinsics.value == camera);
    CHECK(contains(media->description().notice, said));
    CHECK(media->description().notice.empty() == said.empty());
    request.command_line.geometry = Geometry::true_shape;
    const std::string refused =
        refusal([&, file = folder / "depth.png"] { (void)open_depth(file, request); });
    CHECK(contains(refused, "is outside") == !camera.has_value());
}

TEST_CASE("intrinsics may be said as a horizontal field of view, in degrees", "[sidecar]") {
    const Intrinsics view{.field_of_view_deg = 60.5};
    for (const std::string text : {"60.5deg", "60.5 deg", "60.5", "60.5\u00b0", "60.5 \u00b0"}) {
        CAPTURE(text);
        CHECK(intrinsics_in(text) == view);
        CHECK(said_by("intrinsics = \"" + text + "\"").intrinsics == view);
    }
    CHECK(said_by("intrinsics = 60.5").intrinsics == view);
    CHECK(statement_in(toml_of({.intrinsics = view}), "a").intrinsics == view);
    for (const std::string text :
         {"0.99", "179", "-60", "nan", "deg", "60degrees", "60,60", "60 "}) {
        CAPTURE(text);
        CHECK_FALSE(intrinsics_in(text));
    }
}

TEST_CASE("a field of view is that of the picture's whole width, with square pixels", "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "ramp.png";
    write_ramp(file);  // 64 x 48
    DepthRequest request{.find_out = true};
    request.command_line.intrinsics = Intrinsics{.field_of_view_deg = 90.0};
    const auto camera = open_depth(file, request)->description().meaning->intrinsics;
    REQUIRE(camera.value);
    CHECK(camera.origin == Origin::command_line);
    CHECK_THAT(camera.value->fx, WithinRel(32.0, 1e-12));  // half of it at 45 degrees
    CHECK_THAT(camera.value->fy, WithinRel(32.0, 1e-12));
    CHECK(camera.value->cx == 31.5);
    CHECK(camera.value->cy == 23.5);
    CHECK(camera.value->field_of_view_deg == 0.0);
}

TEST_CASE("a sidecar says how its depth is cleaned: by a name, or step by step", "[sidecar]") {
    using Choice = CleaningChoice;
    CHECK(said_by("cleaning = \"sensor\"").cleaning == Choice{CleaningPreset::sensor});
    CHECK(said_by("cleaning = \"raw\"").cleaning == Choice{CleaningPreset::raw});
    CHECK(said_by("cleaning = []").cleaning == Choice{CleaningPreset::own, kRawSteps});
    const Choice two{CleaningPreset::own, {.remove_spikes = true, .smooth_noise = true}};
    CHECK(said_by("cleaning = [\"smooth-noise\", \"remove-spikes\"]").cleaning == two);
    CHECK(said_by("finger = 2.5").finger_mm == 2.5);
}

TEST_CASE("auto is cleaned as the sidecar says, and any other choice beats that", "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "ramp.png";
    write_ramp(file);
    DepthRequest request{.find_out = true};
    const auto steps = [&](CleaningPreset asked) {
        FrameReader reader(open_depth(file, request));
        reader.set_cleaning(cleaning_on(reader.description(), {.preset = asked}));
        REQUIRE(reader.at(0.0));
        return reader.plan().steps;
    };
    CHECK(steps(CleaningPreset::automatic) != kSensorSteps);
    write_text(folder / "ramp.toml", table("cleaning = \"sensor\""));
    CHECK(steps(CleaningPreset::automatic) == kSensorSteps);
    CHECK(steps(CleaningPreset::gentle) == kGentleSteps);
    const CleaningSteps own{.fill_holes = true};
    write_text(folder / "ramp.toml", table("cleaning = [\"fill-holes\"]"));
    CHECK(steps(CleaningPreset::automatic) == own);
    request.command_line.cleaning.emplace();
    CHECK(steps(CleaningPreset::automatic) != own);
}

TEST_CASE("auto says nothing", "[sidecar]") {
    for (const std::string name :
         {"near", "unit", "scale", "range", "no-data", "packing", "code", "geometry", "intrinsics",
          "cleaning", "finger", "times", "offset", "fps"}) {
        CAPTURE(name);
        CHECK(said_by(name + " = \"auto\"") == DepthStatement{});
    }
    CHECK(statement_in("title = \"no depth at all\"", "a") == DepthStatement{});
}

TEST_CASE("a fact that cannot be understood is told in one line, with the file and the line",
          "[sidecar]") {
    const TemporaryFolder folder;
    const std::string fact = GENERATE(
        "near = \"left\"", "near = 1", "unit = \"inches\"", "unit = [\"mm\"]", "scale = 0",
        "scale = -1", "scale = inf", "scale = nan", "scale = \"a\"", "scale = [1, 2]",
        "range = [1, 1]", "range = [1]", "range = [1, 2, 3]", "range = \"1:\"", "range = \"1,2\"",
        "range = [1, inf]", "range = \"1:nan\"", "no-data = [\"a\"]", "no-data = [[0]]",
        "no-data = \"0;1\"", "no-data = nan", "packing = \"up-down\"", "code = \"red\"",
        "geometry = \"flat\"", "intrinsics = [1, 1, 0]", "intrinsics = [0, 1, 0, 0]",
        "intrinsics = [1, -1, 0, 0]", "intrinsics = \"0.5deg\"", "intrinsics = 179",
        "intrinsics = \"60rad\"", "intrinsics = \"1,1,0,0deg\"", "colour = \"red\"", "unit = true",
        "cleaning = \"clean\"", "cleaning = \"own\"", "cleaning = [\"fill\"]", "cleaning = [1]",
        "cleaning = true", "times = \"video\"", "times = 1", "offset = 86401", "offset = nan",
        "offset = [1, 2]", "fps = -1", "fps = 0.0001", "fps = 10001", "fps = \"fast\"",
        "finger = -1", "finger = 26", "finger = [1, 2]", "finger = \"thumb\"", "range = 2020-01-01",
        "scale = {}", "no-data = ", "unit = \"mm", "[depth]");
    CAPTURE(fact);
    const auto file = folder / "clip.toml";
    write_text(file, "# said by hand\n[depth]\n" + fact + "\n");
    const std::string line = refusal([&] { (void)read_sidecar(folder / "clip.mkv"); });
    REQUIRE(contains(line, shown(file)));
    CHECK(contains(line, "line 3"));
    CHECK(contains(line, "correct or delete it"));
    CHECK(line.find('\n') == std::string::npos);
}

TEST_CASE("a code that there is none of is told with all that there are", "[sidecar]") {
    const std::string line = refusal([] { (void)said_by("code = \"red\""); });
    for (const DepthCode code : kDepthCodes) CHECK(contains(line, std::string(name_of(code))));
}

TEST_CASE("too many levels without data, and a sidecar that is none, are refused", "[sidecar]") {
    const TemporaryFolder folder;
    std::string list = "0";
    for (int k = 1; k <= 64; ++k) list += ", " + std::to_string(k);
    CHECK(contains(refusal([&] { (void)said_by("no-data = [" + list + "]"); }), "line 2"));
    write_text(folder / "large.toml", std::string((1U << 20) + 1, '#'));
    CHECK(contains(refusal([&] { (void)read_sidecar(folder / "large.mkv"); }), "sidecar"));
    write_text(folder / "bytes.toml", std::string("\xff\xfe\0\1[", 5));
    const std::string line = refusal([&] { (void)read_sidecar(folder / "bytes.mkv"); });
    CHECK(contains(line, "bytes.toml"));
    CHECK(line.find('\n') == std::string::npos);
    std::filesystem::create_directory(folder / "folder.toml");
    CHECK(contains(refusal([&] { (void)read_sidecar(folder / "folder.mkv"); }), "folder.toml"));
}

TEST_CASE("what else a sidecar holds is kept when it is written", "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "clip.toml";
    write_text(file,
               "title = \"take 2\"\n[depth]\nunit = \"m\"\nscale = 0.5\n[camera]\nfov = 60.5\n");
    write_sidecar(folder / "clip.mkv", {.unit = DepthUnit::mm});
    const std::string text = read_text(file);
    CHECK(contains(text, "take 2"));
    CHECK(contains(text, "[camera]"));
    CHECK(contains(text, "60.5"));
    const DepthStatement only_unit{.unit = DepthUnit::mm};
    CHECK(read_sidecar(folder / "clip.mkv") == only_unit);
}

TEST_CASE("a sidecar that cannot be understood is not overwritten", "[sidecar]") {
    const TemporaryFolder folder;
    const std::string broken = "[depth\nnotes that somebody wrote";
    write_text(folder / "clip.toml", broken);
    CHECK(
        contains(refusal([&] { write_sidecar(folder / "clip.mkv", everything()); }), "clip.toml"));
    CHECK(read_text(folder / "clip.toml") == broken);
}

TEST_CASE("the command line beats the panel, that the sidecar, and that what is found",
          "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "ramp_disp.png";  // its name says disparity
    write_ramp(file);
    DepthRequest request{.find_out = true};
    const auto meaning = [&] { return open_depth(file, request)->description().meaning.value(); };

    CHECK(meaning().unit == known(DepthUnit::disparity, Origin::found));
    CHECK(meaning().range.origin == Origin::found);
    CHECK(meaning().no_data.origin == Origin::assumed);

    write_sidecar(file, {.unit = DepthUnit::m, .scale = 0.001, .no_data = std::vector{1001.0}});
    CHECK(meaning().unit == known(DepthUnit::m, Origin::sidecar));
    CHECK(meaning().scale == known(0.001, Origin::sidecar));
    CHECK(meaning().near == known(NearLevels::dark, Origin::sidecar));  // for that is what m means

    request.panel = {.unit = DepthUnit::mm, .scale = 2.0};
    CHECK(meaning().unit == known(DepthUnit::mm, Origin::panel));
    CHECK(meaning().scale == known(2.0, Origin::panel));
    CHECK(meaning().no_data == known(std::vector{1001.0}, Origin::sidecar));

    request.command_line = {.unit = DepthUnit::levels, .range = DepthRange{2100.0, 2000.0}};
    CHECK(meaning().unit == known(DepthUnit::levels, Origin::command_line));
    CHECK(meaning().range == known(DepthRange{2100.0, 2000.0}, Origin::command_line));
    CHECK(meaning().scale == known(2.0, Origin::panel));

    request.recorded = {.unit = DepthUnit::mm, .range = DepthRange{2000.0, 2100.0}};
    CHECK(meaning().unit == known(DepthUnit::mm, Origin::recorded));
}

TEST_CASE("where nothing is to be found out, sidecars and the panel do not count", "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "ramp.png";
    write_ramp(file);
    write_sidecar(file, {.unit = DepthUnit::m});
    DepthRequest request{.find_out = false};
    request.panel.unit = DepthUnit::disparity;
    const auto media = open_depth(file, request);
    CHECK_FALSE(media->description().meaning);
    CHECK(media->next()->depth.at(5, 5) == 1005.0F);
}

TEST_CASE("a range of more levels than a surface can stand on is refused, or of none",
          "[sidecar]") {
    const TemporaryFolder folder;
    const auto file = folder / "ramp.png";
    write_ramp(file);
    const DepthStatement said = GENERATE(
        DepthStatement{.unit = DepthUnit::mm, .range = DepthRange{1.0, 1e300}},
        DepthStatement{.unit = DepthUnit::m, .range = DepthRange{1.0, 1e306}},
        DepthStatement{.unit = DepthUnit::levels, .scale = 1e-300, .range = DepthRange{255.0, 0.0}},
        DepthStatement{
            .unit = DepthUnit::levels, .scale = 1e300, .range = DepthRange{1e-300, 0.0}});
    write_sidecar(file, said);
    const std::string told = refusal([&] { (void)open_depth(file, {.find_out = true}); });
    CAPTURE(told);
    CHECK(contains(told, "ramp.png"));
    CHECK(contains(told, "is no depth of a scene; give another --depth-range"));
    CHECK(std::count(told.begin(), told.end(), '\n') == 0);
}
