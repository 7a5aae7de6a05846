// The report as files: whole or not at all, readable by anybody, harmless.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/report/report_plots.hpp"
#include "core/report/session_report.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/report/made_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Two touches of half a second at two places.
MadeSession two_touches() {
    MadeSession made;
    made.facts = {{"program", "dibhr 0.1.0"}, {"depth-columns", "320"}, {"depth-rows", "240"}};
    made.ticks = ticks_touching(2000, 200, 700);
    for (std::int64_t k = 1000; k < 1500; ++k) {
        made.ticks[static_cast<std::size_t>(k)] =
            tick_in_contact(k, 200.0 + 0.1 * static_cast<double>(k - 1000), 60.0, 1.5);
    }
    return made;
}

RecordedPicture no_picture(const SessionSource&, double) {
    RecordedPicture picture;
    picture.remark = "it is gone";
    return picture;
}

void report(const fs::path& session, const fs::path& folder) {
    write_session_report(Session(session), {.folder = folder,
                                            .program = "dibhr 0.0.0",
                                            .pictures = no_picture,
                                            .device_kinds = {"falcon", "other"}});
}

/// The error of a report that cannot be made.
std::string refusal(const fs::path& session, const fs::path& folder) {
    try {
        report(session, folder);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

/// Elements that do not close in the order they opened; empty is as it should be.
std::string unbalanced(const std::string& html) {
    const std::set<std::string> kVoid{"meta", "img", "!DOCTYPE"};
    std::vector<std::string> open;
    for (auto at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const bool closes = html[at + 1] == '/';
        const auto begin = at + (closes ? 2 : 1);
        const std::string name = html.substr(begin, html.find_first_of(" >", begin) - begin);
        if (kVoid.contains(name)) continue;
        if (!closes) {
            open.push_back(name);
        } else if (open.empty() || open.back() != name) {
            return "</" + name + ">";
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : "<" + open.back() + ">";
}

const std::vector<std::string> kAllFiles{
    "contact-histogram.png", "force-histogram.png", "force-over-time.png", "heat-map.png",
    "report.html",           "report.json",         "speed-histogram.png", "speed-over-time.png"};

}  // namespace

TEST_CASE("a report is one page, its numbers and its pictures, in a folder that is made",
          "[report]") {
    const TemporaryFolder folder;
    record(folder / "a.dibhr", two_touches());
    report(folder / "a.dibhr", folder.path() / "deep" / "er");
    const fs::path out = folder.path() / "deep" / "er";
    CHECK(names_in(out) == kAllFiles);
    CHECK(json_at(out / "report.json", "$.episode_count") == "2");
    CHECK(std::stod(json_at(out / "report.json", "$.duration_s")) > 1.999);
    CHECK(std::stod(json_at(out / "report.json", "$.contact_share")) > 0.499);
    CHECK(std::stod(json_at(out / "report.json", "$.episodes[1].begin_s")) > 0.999);
    CHECK(json_at(out / "report.json", "$.episodes[1].sent.peak_newton") == "1.5");
    CHECK(json_at(out / "report.json", "$.parameters[0].pixel_pitch_mm") == "0.1");
    CHECK(json_at(out / "report.json", "$.parameters[0].damping_cutoff_hz") == "47.5");
    CHECK(json_at(out / "report.json", "$.ticks.all") == "2000");
    CHECK(json_at(out / "report.json", "$.facts.program") == "dibhr 0.1.0");
    CHECK(json_at(out / "report.json", "$.heat_maps[0].columns") == "320");
}

TEST_CASE("the page stands alone, closes what it opens, and says it in words", "[report]") {
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.facts["participant"] = "P07";
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    const std::string page = read_text(folder / "out/report.html");
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(unbalanced(page) == "");
    CHECK(contains(page, "In 2.0 s, P07 touched twice for 1.0 s in all (50 % of the ticks)."));
    CHECK(contains(page, "it is gone"));
    CHECK(contains(page, "damping cutoff [Hz]"));
    CHECK(contains(page, "47.5"));
    CHECK(count_of(page, "src=\"data:image/png;base64,iVBORw0KGgo") == kAllFiles.size() - 2);
    for (const char* outside : {"http:", "https:", "<script", "<link", "@import", "url("}) {
        CAPTURE(outside);
        CHECK_FALSE(contains(page, outside));
    }
}

TEST_CASE("whatever a session says is shown as text", "[report]") {
    const std::string kNasty = "</p><script>alert(1)</script>\" onload='x' \xFF\x01 \xE4\xBD\xA0";
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.facts["note"] = kNasty;
    made.facts["participant"] = kNasty;
    made.facts[kNasty] = kNasty;
    made.also = [&](Recorder& recorder) {
        recorder.mark(kNasty, kNasty);
        recorder.set_fact("note", kNasty);
    };
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    const std::string page = read_text(folder / "out/report.html");
    CHECK(unbalanced(page) == "");
    CHECK_FALSE(contains(page, "<script"));
    CHECK_FALSE(contains(page, "\" onload"));
    CHECK(contains(page, "&lt;script&gt;alert(1)&lt;/script&gt;"));
    CHECK(contains(page, "\xE4\xBD\xA0"));
    CHECK(contains(json_at(folder / "out/report.json", "$.note"), "<script>alert(1)"));
    CHECK(contains(json_at(folder / "out/report.json", "$.marks[0].tag"), "onload='x'"));
}

TEST_CASE("a session that never touched has a report that says so", "[report]") {
    const TemporaryFolder folder;
    MadeSession made;
    made.ticks = ticks_touching(GENERATE(1, 500), 0, 0);
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    CHECK(names_in(folder / "out") ==
          std::vector<std::string>{"force-over-time.png", "report.html", "report.json"});
    CHECK(contains(read_text(folder / "out/report.html"), "never touched the surface"));
    CHECK(unbalanced(read_text(folder / "out/report.html")) == "");
    CHECK(json_at(folder / "out/report.json", "$.episode_count") == "0");
    CHECK(json_at(folder / "out/report.json", "$.force_sent_newton") == "");
}

TEST_CASE("a session of a single contact tick, without force or without time, has a report",
          "[report]") {
    const TemporaryFolder folder;
    MadeSession made;
    made.ticks = ticks_touching(1, 0, 1);
    switch (GENERATE(0, 1, 2)) {
        case 0:
            made.ticks[0].sent_newton[2] = 0.0;
            break;
        case 1:
            made.ticks[0].dt_s = 0.0;
            break;
        default:
            made.ticks[0].proxy[0] = -1e300;
    }
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    CHECK(json_at(folder / "out/report.json", "$.episode_count") == "1");
}

TEST_CASE("each video that was touched has its heat map, the longest touched first", "[report]") {
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    for (TickRecord& tick : made.ticks) {
        if (tick.tick >= 1400) tick.frames.source.media = 2;
    }
    made.also = [](Recorder& recorder) { recorder.media(2, "other_color.mp4", "other_depth.mp4"); };
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    CHECK(fs::exists(folder / "out/heat-map-2.png"));
    CHECK(json_at(folder / "out/report.json", "$.heat_maps[0].media") == "1");
    CHECK(json_at(folder / "out/report.json", "$.heat_maps[1].media") == "2");
    CHECK(json_at(folder / "out/report.json", "$.heat_maps[1].picture") == "heat-map-2.png");
    report(folder / "a.dibhr", folder / "out");
    CHECK(names_in(folder / "out").size() == kAllFiles.size() + 1);
}

TEST_CASE("a place beyond any picture takes no memory: it is ignored, or the map is left out",
          "[report]") {
    const bool size_known = GENERATE(true, false);
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.ticks[300].proxy[0] = 65535.0;
    made.ticks[300].proxy[1] = 65535.0;
    record(folder / "a.dibhr", made);
    const auto pictures = [&](const SessionSource&, double) {
        RecordedPicture picture;
        picture.remark = "it is gone";
        if (size_known) picture.columns = 320;
        if (size_known) picture.rows = 240;
        return picture;
    };
    write_session_report(Session(folder / "a.dibhr"), {folder / "out", "dibhr", pictures, {}});
    CHECK(fs::exists(folder / "out/heat-map.png") == size_known);
    const std::string page = read_text(folder / "out/report.html");
    CHECK(contains(page, "A heat map was left out: 65536 x 65536 pixels") == !size_known);
    if (size_known) {
        CHECK(json_at(folder / "out/report.json", "$.heat_maps[0].columns") == "320");
    }
}

TEST_CASE("the page says for how much of the session the mouse stood in", "[report]") {
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.facts["device"] = "Novint Falcon 1234";
    for (std::size_t k = 0; k < 744; ++k) made.ticks[k].mouse_fallback = true;
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    CHECK(contains(read_text(folder / "out/report.html"),
                   "Novint Falcon 1234; the mouse replaced it for 37.2 % of the ticks"));
    CHECK(json_at(folder / "out/report.json", "$.facts.device") == "Novint Falcon 1234");
}

TEST_CASE("of a session of the mouse alone the report speaks of no device and of no stand-in",
          "[report]") {
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.facts["device"] = "Novint Falcon";
    made.facts["falcon-serial"] = "";
    made.facts["other-scale"] = "1.75";
    made.facts["device-max-stiffness"] = "1";
    for (TickRecord& tick : made.ticks) tick.mouse_fallback = true;
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    for (const char* const name : {"out/report.html", "out/report.json"}) {
        const std::string text = read_text(folder / name);
        CAPTURE(name);
        CHECK(contains(text, "mouse"));
        for (const char* const word :
             {"Falcon", "falcon", "other-scale", "replaced it", "because the device"})
            CHECK_FALSE(contains(text, word));
    }
    CHECK(json_at(folder / "out/report.json", "$.facts.device") == "mouse");
    CHECK(json_at(folder / "out/report.json", "$.parameters[0].first_tick") == "0");
}

TEST_CASE("versions of the parameters that look alike are one row, and what changed is bold",
          "[report]") {
    const TemporaryFolder folder;
    MadeSession made = two_touches();
    made.also = [](Recorder& recorder) {
        SessionParameters parameters;
        parameters.touch.coupling.pixel_pitch_mm = 0.1;
        for (const double cutoff_hz : {47.5, 47.5, 32.25}) {
            ++parameters.version;
            parameters.touch.coupling.damping_cutoff_hz = cutoff_hz;
            recorder.parameters(parameters);
        }
    };
    for (TickRecord& tick : made.ticks)
        tick.settings = static_cast<std::uint64_t>(1 + tick.tick / 700);
    record(folder / "a.dibhr", made);
    report(folder / "a.dibhr", folder / "out");
    const std::string page = read_text(folder / "out/report.html");
    CHECK(contains(page, "1 change; what changed is bold."));
    CHECK(count_of(page, "<strong>") == 1);
    CHECK(contains(page, "<strong>32.25"));
    CHECK(json_at(folder / "out/report.json", "$.parameters[2].damping_cutoff_hz") == "32.25");
}

TEST_CASE("what speaks against a picture is said, and the picture stays", "[report]") {
    const TemporaryFolder folder;
    record(folder / "a.dibhr", two_touches());
    const auto pictures = [](const SessionSource&, double) {
        RecordedPicture picture;
        picture.columns = 320;
        picture.rows = 240;
        picture.warning = "a.mp4 is taken for the colour video";
        return picture;
    };
    write_session_report(Session(folder / "a.dibhr"), {folder / "out", "dibhr", pictures, {}});
    const std::string page = read_text(folder / "out/report.html");
    CHECK(contains(page, "a.mp4 is taken for the colour video."));
    CHECK(contains(page, "over the frame that was touched longest"));
}

TEST_CASE("an earlier report is replaced, other files stay", "[report]") {
    const TemporaryFolder folder;
    record(folder / "touch.dibhr", two_touches());
    MadeSession made;
    made.ticks = ticks_touching(100, 0, 0);
    record(folder / "none.dibhr", made);
    report(folder / "touch.dibhr", folder / "out");
    std::ofstream(folder / "out/mine.txt") << "mine";
    report(folder / "none.dibhr", folder / "out");
    CHECK(names_in(folder / "out") == std::vector<std::string>{"force-over-time.png", "mine.txt",
                                                               "report.html", "report.json"});
    CHECK(contains(read_text(folder / "out/report.html"), "none.dibhr"));
}

TEST_CASE("what cannot be reported is refused in one line, and nothing is left or changed",
          "[report]") {
    const TemporaryFolder folder;
    record(folder / "touch.dibhr", two_touches());
    record(folder / "empty.dibhr", {});
    std::ofstream(folder / "file") << "a file";
    fs::create_directories(folder.path() / "taken" / "report.html");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    fs::create_directories(folder / "piped");
    REQUIRE(::mkfifo((folder / "piped/heat-map.png").c_str(), 0600) == 0);
    const auto before = names_in(folder.path());
    struct Case {
        const char* session;
        const char* out;
        const char* named;
    };
    for (const Case& each :
         {Case{"empty.dibhr", "out", "empty.dibhr"}, Case{"touch.dibhr", "file", "file"},
          Case{"touch.dibhr", "file/deeper", "file/deeper"}, Case{"touch.dibhr", "pipe", "pipe"},
          Case{"touch.dibhr", "taken", "report.html"}, Case{"touch.dibhr", "piped", "heat-map.png"},
          Case{"touch.dibhr", "/proc/none/out", "/proc/none/out"}}) {
        const std::string words = refusal(folder / each.session, folder.path() / each.out);
        INFO(words);
        CHECK(contains(words, each.named));
        CHECK_FALSE(contains(words, "\n"));
        CHECK(names_in(folder.path()) == before);
    }
}

TEST_CASE("a report that breaks off leaves the earlier one as it was", "[report]") {
    const TemporaryFolder folder;
    record(folder / "touch.dibhr", two_touches());
    report(folder / "touch.dibhr", folder / "out");
    const std::string page = read_text(folder / "out/report.html");
    const auto fails = [](const SessionSource&, double) -> RecordedPicture {
        throw InputError("the disk is gone");
    };
    const Session session(folder / "touch.dibhr");
    CHECK_THROWS_AS(write_session_report(session, {folder / "out", "dibhr", fails, {}}),
                    InputError);
    CHECK(names_in(folder / "out") == kAllFiles);
    CHECK(read_text(folder / "out/report.html") == page);
    CHECK_THROWS_AS(write_session_report(session, {folder / "new", "dibhr", fails, {}}),
                    InputError);
    CHECK_FALSE(fs::exists(folder / "new"));
}

TEST_CASE("heat is darker the more there is, and each step can be told from grey", "[report]") {
    double lightness = 255.0;
    for (int k = 0; k <= 20; ++k) {
        const Ink ink = heat_ink(k / 20.0);
        const double next = 0.299 * ink.red + 0.587 * ink.green + 0.114 * ink.blue;
        CHECK(next < lightness);
        lightness = next;
        CHECK(std::max({ink.red, ink.green, ink.blue}) - std::min({ink.red, ink.green, ink.blue}) >
              60);
    }
}

TEST_CASE("heat lies where it was touched, whatever the sizes of depth and colour", "[report]") {
    const int columns = GENERATE(160, 640);
    HeatMapGround ground{{}, columns, columns * 3 / 4, 0.1};
    const int colour_columns = GENERATE(0, 80, 800);
    if (colour_columns > 0) {
        ground.picture = {colour_columns, colour_columns * 3 / 4, {}};
        ground.picture.rgb.assign(static_cast<std::size_t>(colour_columns * colour_columns * 9 / 4),
                                  128);
    }
    CAPTURE(columns, colour_columns);
    TouchedPlaces places;
    places.add({0.25 * columns, 0.5 * columns}, 0.0, 1.0);
    const ColourImage picture = plot_heat_map(places, ground, {}, 1, "").finished();
    const auto chroma_at = [&](double x_share, double y_share) {
        const auto x = static_cast<std::size_t>(36.0 + 960.0 * x_share);
        const auto y = static_cast<std::size_t>(92.0 + 720.0 * y_share);
        const std::size_t k = 3 * (y * static_cast<std::size_t>(picture.columns) + x);
        const auto [low, high] =
            std::minmax({picture.rgb[k], picture.rgb[k + 1], picture.rgb[k + 2]});
        return high - low;
    };
    CHECK(chroma_at(0.25, 2.0 / 3.0) > 60);
    CHECK(chroma_at(0.75, 2.0 / 3.0) < 10);
    CHECK(chroma_at(0.25, 0.2) < 10);
}
