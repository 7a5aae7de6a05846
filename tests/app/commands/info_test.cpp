// `dibhr info` and `dibhr devices`: what files hold and what is attached.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/session/recorder.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

bool says(const ProgramResult& result, const std::string& words) {
    return result.output.find(words) != std::string::npos;
}

/// mine.dibhr in that folder, over color.png and depth.png.
void record_over_pictures(const TemporaryFolder& folder) {
    write_depth_png(folder / "color.png", 64, 48, 20, 3);
    write_depth_png(folder / "depth.png", 32, 24, 100, 1);
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "color.png", .depth = folder / "depth.png"});
}

}  // namespace

TEST_CASE("info describes an image and the depth file beside it", "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "my_color.png", 30, 20, 10);
    write_depth_png(folder / "my_depth.png", 16, 12, 100);
    const ProgramResult result = run_dibhr(folder, {"info", "my_color.png"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(says(result, "image"));
    CHECK(says(result, "30x20"));
    CHECK(says(result, "my_depth.png"));
}

TEST_CASE("info, touch and surface hear what was chosen in the window before", "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "my_depth.png", 16, 12, 100, 2);
    keep_choice(folder / "dibhr/depth", folder / "my_depth.png", {.near = NearLevels::dark});
    const ProgramResult info = run_dibhr(folder, {"info", "my_depth.png", "--json"});
    INFO(info.output << info.errors);
    CHECK(info.exit_code == 0);
    const Json json = parsed_json(info.output);
    CHECK(json["near"] == "dark");
    CHECK(json["origin"]["near"] == "panel");
    const ProgramResult given =
        run_dibhr(folder, {"info", "my_depth.png", "--json", "--near", "bright"});
    CHECK(parsed_json(given.output)["origin"]["near"] == "command line");

    const auto surface = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"surface", "my_depth.png", "--out", "a.pfm"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CHECK(run_dibhr(folder, arguments).exit_code == 0);
        return read_text(folder / "a.pfm");
    };
    CHECK(surface({}) == surface({"--near", "dark"}));
    CHECK(surface({}) != surface({"--near", "bright"}));
    const auto touch = [&](const std::vector<std::string>& options) {
        write_text(folder / "goals.csv", "t,x,y,z\n0,2,5,3\n0.001,3,5,3\n");
        std::vector<std::string> arguments{"touch", "--depth", "my_depth.png", "--goals",
                                           "goals.csv"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        CHECK(result.exit_code == 0);
        const std::string row = split(result.output, '\n').at(2);
        return row.substr(0, row.rfind(','));  // but for the time it took
    };
    CHECK(touch({}) == touch({"--near", "dark"}));
    CHECK(touch({}) != touch({"--near", "bright"}));
}

TEST_CASE("info gives the answers that are possible where the meaning is not sure", "[info]") {
    const TemporaryFolder folder;
    run_shell(folder,  // far in the middle, without a floor
              "ffmpeg -v error -f lavfi -i \"color=black:s=64x48,format=gray16le,"
              "geq=lum='12000+48000*exp(-hypot(X-32,Y-24)/10)'\" -frames:v 1 a.png");
    const ProgramResult info = run_dibhr(folder, {"info", "a.png", "--json"});
    INFO(info.output << info.errors);
    CHECK(info.exit_code == 0);
    const Json json = parsed_json(info.output);
    CHECK(json["sure"].get<double>() < 0.9);
    REQUIRE(json["alternatives"].size() >= 2);
    CHECK(json["alternatives"][0]["near"] == json["near"]);
    CHECK(json["alternatives"][0]["probability"] == json["sure"]);
}

TEST_CASE("info --why prints what each finding states, how sure it is and where it is from",
          "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "rock_height.png", 16, 12, 100, 2);
    const ProgramResult why = run_dibhr(folder, {"info", "rock_height.png", "--why"});
    INFO(why.output << why.errors);
    CHECK(why.exit_code == 0);
    CHECK(says(why, "99 %  magic       picture by OpenCV's codecs, by"));
    CHECK(
        says(why, "near is bright, levels of no unit   97 %  name        'height' in its name\n"));
    CHECK(says(why, "\n  so "));
    CHECK(says(why, "sure              97 %"));
    CHECK(says(why, "found in          'height' in its name"));
    CHECK_FALSE(says(run_dibhr(folder, {"info", "rock_height.png"}), "form PNG"));
    const Json json =
        parsed_json(run_dibhr(folder, {"info", "rock_height.png", "--json", "--why"}).output);
    CHECK(json["findings"][0]["about"] == "form PNG");
    CHECK(json["findings"][0]["evidence"] == "magic");
    CHECK(json["findings"][1]["states"]["unit"] == "levels");
    CHECK(json["findings"][1]["evidence"] == "name");
}

TEST_CASE("a long finding of info --why goes on below, and moves no column", "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "a.png", 16, 12, 100, 2);
    const ProgramResult why =
        run_dibhr(folder, {"info", "a.png", "--why", "--near", "dark", "--depth-unit", "mm",
                           "--depth-scale", "0.5", "--no-data", "0,7", "--depth-code", "grey"});
    INFO(why.output << why.errors);
    CHECK(says(why,
               "\n  near is dark, a level is 0.5 mm,  100 %  person      command line\n"
               "    no data is 0, 7, code grey\n"));
    CHECK(says(why, "\n  form PNG                           99 %  magic "));
    CHECK_FALSE(says(why, "nothing  "));
}

TEST_CASE("info describes a video", "[info]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i testsrc=size=160x120:rate=25:duration=2 "
              "-pix_fmt yuv420p clip.mp4");
    const ProgramResult result = run_dibhr(folder, {"info", "clip.mp4"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(says(result, "video"));
    CHECK(says(result, "160x120"));
    CHECK((says(result, "avc1") || says(result, "h264")));
    CHECK(says(result, " 50\n"));
    CHECK(says(result, "2.000 s"));
    CHECK(says(result, "25.00 frames/s"));
    CHECK(says(result, "none found"));
}

TEST_CASE("info says whose times pictures have", "[info]") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "depth");
    for (const char* const name : {"1.png", "2.png", "3.png"})
        write_depth_png(folder / "depth" / name, 16, 12, 100, 2);
    const ProgramResult counted = run_dibhr(folder, {"info", "depth"});
    INFO(counted.output << counted.errors);
    CHECK(says(counted, "assumed: 30 frames a second"));
    write_text(folder / "depth/timestamps.txt", "0.5\n0.75\n1.0\n");
    CHECK(says(run_dibhr(folder, {"info", "depth"}), "stamps in 'timestamps.txt'"));
    const Json json = parsed_json(run_dibhr(folder, {"info", "depth", "--json"}).output);
    CHECK(json["timing"]["from"] == "list");
    CHECK(json["times"] == "own");
    CHECK(json["duration_s"] == 0.75);
    const Json faster = parsed_json(run_dibhr(folder, {"info", "depth", "--json", "--depth-fps",
                                                       "10", "--depth-offset", "-0.5"})
                                        .output);
    CHECK(faster["timing"]["from"] == "stated");
    CHECK(faster["time_offset_s"] == -0.5);
    CHECK(faster["origin"]["stated_frames_per_s"] == "command line");
}

TEST_CASE("info describes a session file", "[info]") {
    const TemporaryFolder folder;
    const auto ring = std::make_unique<TickRing>();
    {
        const Recorder recorder(folder / "mine.dibhr", *ring, {{"device", "a scripted hand"}});
        for (int k = 0; k < 251; ++k) {
            TickRecord record;
            record.tick = k;
            record.t_s = 3.0 + 0.001 * k;
            REQUIRE(ring->push(record));
        }
    }
    const ProgramResult result = run_dibhr(folder, {"info", "mine.dibhr"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(says(result, "session"));
    CHECK(says(result, "251"));
    CHECK(says(result, "0.250 s"));
    CHECK(says(result, "a scripted hand\n"));
    CHECK(names_in(folder.path()) == std::vector<std::string>{"mine.dibhr"});
}

TEST_CASE("info says of a session what people want to know first, and what decoded its video",
          "[info]") {
    const TemporaryFolder folder;
    record_over_pictures(folder);
    run_shell(folder,
              "sqlite3 mine.dibhr \"INSERT OR REPLACE INTO session VALUES('algorithm', 'dibhr'), "
              "('stiffness', '0.5'), ('device', 'mouse'), ('a-fact', 'of no interest'); "
              "UPDATE tick_data SET lateness = 0; "
              "UPDATE tick_data SET lateness = 1500000 WHERE tick % 100 = 3\"");
    const ProgramResult result = run_dibhr(folder, {"info", "mine.dibhr"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(says(result, "late ticks        10\n"));
    std::size_t last = 0;
    for (const std::string name : {"colour", "depth", "started", "duration", "ticks", "late ticks",
                                   "device", "algorithm", "stiffness", "a-fact", "row_count"}) {
        CAPTURE(name);
        const std::size_t at = result.output.find("\n  " + name + " ");
        REQUIRE(at != std::string::npos);
        CHECK(at > last);
        CHECK(result.output.find("\n  " + name + " ", at + 1) == std::string::npos);  // said once
        last = at;
    }
    for (const auto& [library, version] : library_versions()) {
        CAPTURE(library);
        CHECK(says(result, "  " + library));
        CHECK(says(result, " " + version + "\n"));
    }
}

TEST_CASE("info rounds a session's numbers and names the settings of its device alone", "[info]") {
    const TemporaryFolder folder;
    record_over_pictures(folder);
    run_shell(folder,
              "sqlite3 mine.dibhr \"INSERT OR REPLACE INTO session VALUES"
              "('relief', '226.66666666666669'), ('libx', '1.10'), ('falcon-gear', '7.7'), "
              "('device', 'Haply Inverse3 (049D)'), ('inverse3-tilt', '20')\"");
    const ProgramResult result = run_dibhr(folder, {"info", "mine.dibhr"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(says(result, "relief            226.667\n"));
    CHECK(says(result, "libx              1.10\n"));
    CHECK(says(result, "inverse3-tilt     20\n"));
    CHECK_FALSE(says(result, "falcon-gear"));
    const Json facts =
        parsed_json(run_dibhr(folder, {"info", "mine.dibhr", "--json"}).output)["facts"];
    CHECK(facts["relief"] == "226.66666666666669");
    CHECK(facts["falcon-gear"] == "7.7");
}

TEST_CASE("info says for how much of a session the mouse stood in", "[info]") {
    const int mouse_fallback = GENERATE(0, 1, 372, 1000);
    const TemporaryFolder folder;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder / "mine.dibhr", *ring, {{"device", "Novint Falcon 1234"}});
        for (int k = 0; k < 1010; ++k) {
            TickRecord record;
            record.tick = k;
            record.surface = k < 1000;  // or there is no hand
            record.mouse_fallback = k < mouse_fallback;
            REQUIRE(ring->push(record));
        }
    }
    const ProgramResult result = run_dibhr(folder, {"info", "mine.dibhr"});
    INFO(result.output << result.errors);
    const std::map<int, std::string> devices{
        {0, "Novint Falcon 1234\n"},
        {1, "Novint Falcon 1234; the mouse replaced it for 0.1 % of the ticks\n"},
        {372, "Novint Falcon 1234; the mouse replaced it for 37.2 % of the ticks\n"},
        {1000, " mouse\n"}};
    CHECK(says(result, devices.at(mouse_fallback)));
}

TEST_CASE("info tells of the file it cannot read and describes the others", "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "good.png", 30, 20, 10);
    write_text(folder / "bad.dibhr", "no session\n");
    const ProgramResult result = run_dibhr(folder, {"info", "bad.dibhr", "good.png", "none.png"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(says(result, "30x20"));
    CHECK(split(result.errors, '\n').size() == 3);
    CHECK(result.errors.find("bad.dibhr") != std::string::npos);
    CHECK(result.errors.find("none.png") != std::string::npos);
}

TEST_CASE("info goes on after a name that leads nowhere", "[info]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "good.png", 30, 20, 10);
    const std::string too_long(5000, 'x');
    const ProgramResult result = run_dibhr(folder, {"info", too_long, "good.png/x", "good.png"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(says(result, "30x20"));
    CHECK(split(result.errors, '\n').size() == 3);
}

TEST_CASE("nothing that a session says reaches the terminal but letters", "[info]") {
    const TemporaryFolder folder;
    const std::string nasty =
        "red \x1b[31m\a\r\n\xc2\x9b"
        "2J \xff stop";
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder / "mine.dibhr", *ring, {{"note", nasty}, {nasty, "value"}});
        recorder.mark(nasty, nasty);
        REQUIRE(ring->push({}));
    }
    const ProgramResult result = run_dibhr(folder, {"info", "mine.dibhr", "none\x1b[31m.png"});
    INFO(result.output << result.errors);
    CHECK(says(result, "red "));
    for (const std::string& text : {result.output, result.errors}) {
        for (const char* control : {"\x1b", "\a", "\r", "\xc2\x9b", "\xff"}) {
            CHECK(text.find(control) == std::string::npos);
        }
    }
    CHECK(split(result.errors, '\n').size() == 2);
    for (const std::string& line : split(result.output, '\n')) CHECK_FALSE(line.starts_with("2J"));
}

TEST_CASE("every command warns of a recording that was copied without its log", "[info]") {
    const TemporaryFolder folder;
    record_over_pictures(folder);
    run_shell(folder,
              "sqlite3 mine.dibhr \"PRAGMA journal_mode = WAL; "
              "UPDATE session SET value = '0' WHERE key = 'complete'\"");
    for (const std::vector<std::string>& command : {std::vector<std::string>{"info", "mine.dibhr"},
                                                    {"replay", "mine.dibhr"},
                                                    {"export", "mine.dibhr", "--csv", "mine.csv"},
                                                    {"report", "mine.dibhr", "--out", "report"}}) {
        const ProgramResult result = run_dibhr(folder, command);
        CAPTURE(command, result.output, result.errors);
        CHECK(result.exit_code == 0);
        CHECK(result.errors.starts_with("dibhr: warning: mine.dibhr: its recording was broken"));
        CHECK(result.errors.find("mine.dibhr-wal") != std::string::npos);
        CHECK(split(result.errors, '\n').size() == 2);
    }
}

TEST_CASE("every command refuses a session made to keep it busy, or reads it without that part",
          "[info]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i testsrc2=size=60x40:rate=30:duration=0.2 -c:v ffv1 "
              "film_color.mkv && cp film_color.mkv film_depth.mkv");
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "film_color.mkv", .depth = folder / "film_depth.mkv"});
    const std::string endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) ";
    const std::string sql = GENERATE_COPY(
        as<std::string>{},
        "DROP VIEW tick; CREATE VIEW tick AS " + endless +
            "SELECT x / 1e3 AS t, 1 AS gx, 1 AS gy, 1 AS gz, x AS tick, 1 AS contact FROM c",
        "DROP TABLE session; CREATE VIEW session AS " + endless +
            "SELECT x AS key, hex(zeroblob(1000)) AS value FROM c",
        "INSERT INTO session " + endless + "SELECT x, hex(zeroblob(400000)) FROM c LIMIT 100");
    CAPTURE(sql);
    run_shell(folder, "sqlite3 mine.dibhr \"" + sql + "\"");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", "mine.dibhr"},
          {"export", "mine.dibhr", "--csv", "mine.csv"},
          {"report", "mine.dibhr", "--out", "report"},
          {"replay", "mine.dibhr"},
          {"experiment", "human", "--session", "mine.dibhr"}}) {
        CAPTURE(command[0]);
        const ProgramResult result = run_dibhr(folder, command);
        // Ticks are coded in one way; an experiment takes none over another video than the sample.
        const bool needless = sql.starts_with("DROP VIEW tick") && command[0] != "experiment";
        CHECK(result.exit_code == (needless ? 0 : 1));
        CHECK(result.output.empty() != needless);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(result.errors.find("mine.dibhr: ") != std::string::npos);
        CHECK((result.errors.find("a damaged view of its ticks") != std::string::npos) == needless);
        CHECK(result.peak_memory_bytes < std::size_t{300} << 20);
    }
}

TEST_CASE("devices lists the mouse as usable and says what it knows of a Falcon", "[devices]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(folder, {"devices"});
    CHECK(result.exit_code == 0);
    CHECK(says(result, "mouse: usable"));
    CHECK(says(result, "Novint Falcon"));
    CHECK(result.errors.empty());
}
