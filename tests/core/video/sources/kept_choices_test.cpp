// What a person chose of a file's depth, and that it is heard when the file is opened again.
#include "core/video/sources/kept_choices.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/video/sources/sidecar.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

template <typename Value>
Known<Value> known(Value value, Origin origin) {
    return {std::move(value), origin};
}

/// Distances in millimetres, 1000 to 1063.
void write_ramp(const fs::path& file) {
    write_picture(file, 64, 48, 16, 1, [](int i, int, int) { return 1000 + i; });
}

/// A file of a person, and the folder of a person's choices, which nobody has made yet.
struct Home {
    TemporaryFolder folder{};
    fs::path file{folder / "ramp.png"};
    fs::path choices{folder / "config/dibhr/depth"};

    Home() { write_ramp(file); }
    [[nodiscard]] DepthRequest request() const { return {.find_out = true, .kept_in = choices}; }
    [[nodiscard]] MediaDescription opened() const {
        return open_depth(file, request())->description();
    }
};

DepthStatement metres() {
    return {.unit = DepthUnit::m, .scale = 0.001};
}

}  // namespace

TEST_CASE("a choice is kept in a folder of its own, named after its file", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, metres());
    REQUIRE(names_in(home.choices).size() == 1);
    const std::string name = names_in(home.choices).front();
    CHECK(name.starts_with("ramp-"));
    CHECK(name.size() == std::string("ramp-0123456789abcdef.toml").size());
    const std::string text = read_text(home.choices / name);
    CHECK(contains(text, fs::canonical(home.file).string()));
    CHECK(contains(text, "delete this file to forget it"));
    CHECK(statement_in(text, name) == metres());
    CHECK(names_in(home.folder.path()) == std::vector<std::string>{"config", "ramp.png"});
}

TEST_CASE("what was chosen of a file is the panel's word when it is opened again", "[kept]") {
    const Home home;
    CHECK(home.opened().meaning->unit.origin == Origin::assumed);
    CHECK(home.opened().panel == DepthStatement{});
    keep_choice(home.choices, home.file, metres());
    CHECK(home.opened().meaning->unit == known(DepthUnit::m, Origin::panel));
    CHECK(home.opened().meaning->scale == known(0.001, Origin::panel));
    CHECK(home.opened().panel == metres());
    CHECK(describe_media(home.file, home.request()).meaning->unit.origin == Origin::panel);
    CHECK(open_media(home.file, {}, home.request())->description().panel == metres());
    CHECK(home.opened().notice.empty());
}

TEST_CASE("a choice is of its file by whatever name, and of no other file", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, metres());
    const fs::path link = home.folder / "link.png";
    fs::create_symlink(home.file, link);
    const fs::path around = home.folder.path() / "config" / ".." / "ramp.png";
    CHECK(kept_choice_of("a", link) == kept_choice_of("a", home.file));
    CHECK(kept_choice_of("a", around) == kept_choice_of("a", home.file));
    CHECK(kept_choice_of("a", fs::relative(home.file)) == kept_choice_of("a", home.file));
    CHECK(kept_choice_of("a", home.choices / "") == kept_choice_of("a", home.choices));
    CHECK(kept_choice_of("a", "none/ramp.png") ==
          kept_choice_of("a", fs::absolute("none/ramp.png")));
    const fs::path other = home.folder / "config/ramp.png";
    write_ramp(other);
    CHECK(kept_choice_of("a", other) != kept_choice_of("a", home.file));
    CHECK(open_depth(other, home.request())->description().panel == DepthStatement{});
    const std::string longest(251, 'x');
    keep_choice(home.choices, home.folder / (longest + ".png"), metres());
    CHECK(names_in(home.choices).size() == 2);
}

TEST_CASE("the panel's newest word beats what was chosen before, which beats the sidecar",
          "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, {.unit = DepthUnit::m, .scale = 0.002});
    write_sidecar(home.file, {.unit = DepthUnit::disparity, .no_data = std::vector{1001.0}});
    DepthRequest request = home.request();
    const auto meaning = [&] { return open_depth(home.file, request)->description().meaning; };
    CHECK(meaning()->unit == known(DepthUnit::m, Origin::panel));
    CHECK(meaning()->no_data == known(std::vector{1001.0}, Origin::sidecar));
    request.panel.unit = DepthUnit::levels;
    CHECK(meaning()->unit == known(DepthUnit::levels, Origin::panel));
    CHECK(meaning()->scale == known(0.002, Origin::panel));
    request.command_line.scale = 0.5;
    CHECK(meaning()->scale == known(0.5, Origin::command_line));
}

TEST_CASE("a choice of how a picture is packed is heard before it is opened", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, {.packing = DepthPacking::left_right});
    const auto media = open_media(home.file, {}, home.request());
    CHECK(media->description().depth_columns == 32);
    CHECK(media->description().colour_columns == 32);
    CHECK(media->description().meaning->packing.origin == Origin::panel);
}

TEST_CASE("so is how a depth is coded that is found beside its colour", "[kept]") {
    const Home home;
    const fs::path colour = home.folder / "a_color.png";
    const fs::path depth = home.folder / "a_depth.png";
    write_picture(colour, 64, 48, 8, 3, [](int i, int, int) { return 3 * i; });
    write_picture(depth, 64, 48, 8, 3, [](int i, int j, int) { return (i * j) % 256; });
    const auto bits = [&] {
        return open_media(colour, {}, home.request())->description().depth_bits;
    };
    const int grey = bits();
    keep_choice(home.choices, depth, {.code = DepthCode::hue});
    CHECK(bits() > grey);
    write_text(home.folder / "a_color.toml", "[depth]\ncode = \"grey\"\n");
    CHECK(bits() > grey);  // the panel beats the sidecar, whichever file that is beside
    keep_choice(home.choices, depth, {});
    keep_choice(home.choices, colour, {.code = DepthCode::hue});
    CHECK(bits() == grey);  // that was chosen for another file
}

TEST_CASE("a choice that is taken back leaves nothing", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, {});  // none was there
    CHECK_FALSE(fs::exists(home.choices));
    keep_choice(home.choices, home.file, metres());
    keep_choice(home.choices, home.file, {});
    CHECK(names_in(home.choices).empty());
    CHECK(home.opened().panel == DepthStatement{});
}

TEST_CASE("raw depth and a session's meaning do not hear what was chosen", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, metres());
    DepthRequest raw = home.request();
    raw.find_out = false;
    CHECK_FALSE(open_depth(home.file, raw)->description().meaning);
    raw.recorded.unit = DepthUnit::mm;
    CHECK(open_depth(home.file, raw)->description().meaning->unit ==
          known(DepthUnit::mm, Origin::recorded));
    CHECK(open_depth(home.file, {.find_out = true})->description().panel == DepthStatement{});
}

TEST_CASE("a kept choice that cannot be understood is passed over, and the notice says so",
          "[kept]") {
    const Home home;
    const fs::path kept = kept_choice_of(home.choices, home.file);
    keep_choice(home.choices, home.file, metres());
    const std::string text = GENERATE("[depth]\nunit = \"inches\"\n", "[depth", "\xff\n[", "");
    CAPTURE(text);
    write_text(kept, text);
    if (text.empty()) fs::remove(kept), fs::create_directory(kept);
    const MediaDescription media = home.opened();
    CHECK(media.meaning->unit.origin == Origin::assumed);
    CHECK(media.panel == DepthStatement{});
    CHECK(contains(media.notice, "is ignored"));
    CHECK(contains(media.notice, kept.filename().string()));
    CHECK(media.notice.find('\n') == std::string::npos);
    CHECK(describe_media(home.file, home.request()).notice == media.notice);
    CHECK(open_media(home.file, {}, home.request())->description().notice == media.notice);
}

TEST_CASE("a kept choice that does not fit the file any more is passed over, too", "[kept]") {
    const Home home;
    keep_choice(home.choices, home.file, {.unit = DepthUnit::mm, .geometry = Geometry::true_shape});
    CHECK(home.opened().meaning->geometry.value == Geometry::relief);
    CHECK(contains(home.opened().notice, "--intrinsics"));
    // It is not what makes a file refuse to open.
    fs::resize_file(home.file, 50);
    CHECK_FALSE(contains(refusal([&] { (void)home.opened(); }), "chosen"));
}

TEST_CASE("a choice that cannot be kept is told in one plain line", "[kept]") {
    const Home home;
    write_text(home.folder / "config", "in the way");
    const std::string line = refusal([&] { keep_choice(home.choices, home.file, metres()); });
    CHECK(contains(line, "not kept"));
    CHECK(contains(line, "make it writable"));
    CHECK(line.find('\n') == std::string::npos);
}

namespace {

/// A folder of 16-bit pictures that leave open which levels are near.
struct OpenFolder {
    TemporaryFolder folder{};
    fs::path choices{folder / "config"};
    fs::path first{folder / "takes/first.png"};
    fs::path second{folder / "takes/second.png"};

    OpenFolder() {
        fs::create_directories(first.parent_path());
        const auto corridor = [](int i, int j, int) {
            return 60000 - 1000 * std::max(std::abs(i - 32), std::abs(j - 24));
        };
        for (const fs::path& file : {first, second}) write_picture(file, 64, 48, 16, 1, corridor);
    }
    [[nodiscard]] MediaDescription opened(const fs::path& file) const {
        return open_depth(file, {.find_out = true, .kept_in = choices})->description();
    }
    [[nodiscard]] std::vector<DepthAlternative> alternatives() const {
        return opened(first).conclusion.alternatives;
    }
    /// The likeliest answer by which the other end is near.
    [[nodiscard]] DepthAlternative other_end() const {
        const std::vector<DepthAlternative> all = alternatives();
        REQUIRE(all.size() >= 2);
        const auto other = std::find_if(all.begin(), all.end(), [&all](const auto& one) {
            return one.statement.near != all.front().statement.near;
        });
        REQUIRE(other != all.end());
        return *other;
    }
};

}  // namespace

TEST_CASE("an answer for a folder is heard for its files that leave it open, and nobody asks again",
          "[kept]") {
    const OpenFolder takes;
    const std::size_t before = takes.alternatives().size();
    const DepthAlternative other = takes.other_end();
    const DepthStatement answer = other.statement;
    keep_folder_choice(takes.choices, takes.first, answer);
    for (const fs::path& file : {takes.first, takes.second}) {
        const MediaDescription media = takes.opened(file);
        CHECK(media.conclusion.alternatives.empty());
        CHECK(doubt_about(media).empty());
        CHECK(media.meaning->near == known(*answer.near, Origin::folder));
        CHECK(media.meaning->unit == known(*answer.unit, Origin::folder));
        CHECK(media.meaning->range.value == other.range);
        CHECK(media.panel == DepthStatement{});
    }
    const fs::path apart = takes.folder / "apart.png";
    fs::copy_file(takes.first, apart);
    CHECK(takes.opened(apart).conclusion.alternatives.size() == before);
    keep_folder_choice(takes.choices, takes.second, {});
    CHECK(takes.alternatives().size() == before);
    CHECK(names_in(takes.choices).empty());
}

TEST_CASE(
    "an answer for a folder gives way to a sidecar, to a choice for the file, and to findings",
    "[kept]") {
    const OpenFolder takes;
    const DepthStatement answer = takes.other_end().statement;
    const NearLevels other =
        answer.near == NearLevels::dark ? NearLevels::bright : NearLevels::dark;
    const DepthStatement against{.near = other, .unit = DepthUnit::levels};
    keep_folder_choice(takes.choices, takes.first, answer);
    const std::vector<std::string> names = names_in(takes.choices);
    REQUIRE(names.size() == 1);
    CHECK(names.front().starts_with("takes-files-"));
    CHECK(contains(read_text(takes.choices / names.front()),
                   "the files of '" + fs::canonical(takes.first.parent_path()).string()));
    write_sidecar(takes.first, against);
    CHECK(takes.opened(takes.first).meaning->near == known(other, Origin::sidecar));
    keep_choice(takes.choices, takes.second, against);
    CHECK(takes.opened(takes.second).meaning->near == known(other, Origin::panel));
    // That answer is not among the likely ones of this file.
    const fs::path height = takes.folder / "takes/height.png";
    fs::copy_file(takes.second, height);
    CHECK(takes.opened(height).meaning->near == known(NearLevels::bright, Origin::found));
    // What is said on the panel of other things does not withdraw it.
    const DepthRequest whole{.find_out = true,
                             .panel = DepthStatement{.finger_mm = 2.0},
                             .kept_in = takes.choices,
                             .panel_is_whole = true};
    const MediaDescription again = open_depth(takes.second, whole)->description();
    CHECK(again.panel == whole.panel);
    CHECK(again.meaning->near == known(*answer.near, Origin::folder));
}

TEST_CASE("a folder as media and the files in it have choices of their own", "[kept]") {
    const fs::path takes = "/films/takes";
    CHECK(kept_folder_choice_of("a", takes / "first.png") ==
          kept_folder_choice_of("a", takes / "second.png"));
    CHECK(kept_folder_choice_of("a", takes / "first.png") != kept_choice_of("a", takes));
    CHECK(kept_folder_choice_of("a", takes / "first.png") != kept_folder_choice_of("a", takes));
}
