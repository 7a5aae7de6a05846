// `dibhr replay` as a person runs it, over sessions that the real loop recorded.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "app/commands/output.hpp"
#include "app/settings/assets_path.hpp"
#include "core/video/formats/libraries.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

bool is_one_line(const std::string& text) {
    return text.starts_with("dibhr: ") && text.find('\n') == text.size() - 1;
}

/// A small colour and depth film with holes and noise, so that cleaning has something to do; half a
/// second, so that a second of touching repeats it. Made once, for cases that do not change it.
const TemporaryFolder& film() {
    static const TemporaryFolder folder;
    static const bool made = [] {
        const std::string source =
            "ffmpeg -v error -f lavfi -i testsrc2=size=120x90:rate=30:duration=0.5";
        run_shell(folder, source + " -c:v ffv1 film_color.mkv && " + source +
                              ",format=gray -c:v ffv1 film_depth.mkv");
        return true;
    }();
    static_cast<void>(made);
    return folder;
}

/// For cases that change it.
void copy_film(const fs::path& folder) {
    for (const char* const name : {"film_color.mkv", "film_depth.mkv"})
        fs::copy_file(film() / name, folder / name);
}

RecordedSession session_over(const fs::path& folder) {
    return {.colour = folder / "film_color.mkv", .depth = folder / "film_depth.mkv"};
}

RecordedSession film_session() {
    return session_over(film().path());
}

/// A second over the film, recorded once.
void copy_session(const fs::path& file) {
    static const TemporaryFolder folder;
    const fs::path recorded = folder / "mine.dibhr";
    if (!fs::exists(recorded)) record_session(recorded, film_session());
    fs::copy_file(recorded, file);
}

/// Of mine.dibhr, the last one in contact.
void spoil_one_proxy(const TemporaryFolder& folder) {
    run_shell(folder,
              "sqlite3 mine.dibhr 'UPDATE tick_data SET pz = pz + 1e-9 WHERE tick = "
              "(SELECT max(tick) FROM tick WHERE contact)'");
}

void set_fact(const TemporaryFolder& folder, const std::string& session, const std::string& key,
              const std::string& value) {
    run_shell(folder, "sqlite3 " + session + " \"UPDATE session SET value = '" + value +
                          "' WHERE key = '" + key + "'\"");
}

}  // namespace

TEST_CASE("a session replays bit for bit, cleaned or raw, with any algorithm and a bump map",
          "[replay]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "bumps.png", 32, 24, 0, 8);
    RecordedSession session = film_session();
    const std::string kind = GENERATE(as<std::string>{}, "dibhr", "raw", "pga", "neighborhood",
                                      "god-object", "bump", "filtered");
    CAPTURE(kind);
    session.parameters.algorithm = named<Algorithm>(kind).value_or(Algorithm::dibhr);
    if (kind == "raw") session.cleaning.preset = CleaningPreset::raw;
    if (kind == "god-object") session.parameters.coupling.damping_newton_s_per_m = 1.5;
    if (kind == "filtered") {
        session.parameters.coupling.damping_newton_s_per_m = 5.0;
        session.parameters.coupling.damping_cutoff_hz = 50.0;
    }
    if (kind == "bump") {
        session.bump = folder / "bumps.png";
        session.parameters.shape.roughness_px = 7.5;
    }
    record_session(folder / "mine.dibhr", session);
    const ProgramResult result = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(contains(result.output,
                   "as recorded: all 1000 proxies and forces are identical, bit for bit"));
    CHECK(result.errors.empty());
}

TEST_CASE("silhouettes at the colour's edges are replayed with the colour, bit for bit",
          "[replay]") {
    const TemporaryFolder folder;
    const std::string grey =
        "ffmpeg -v error -f lavfi -i color=size=480x90:rate=30:duration=0.5,"
        "format=gray,geq=lum=";
    run_shell(folder, grey + "'50+130*clip((X-318.5)/13\\,0\\,1)' -c:v ffv1 film_depth.mkv");
    run_shell(folder, grey + "'if(gt(X\\,319+N)\\,200\\,50)' -c:v ffv1 film_color.mkv");
    RecordedSession session = session_over(folder.path());
    session.cleaning = {.preset = CleaningPreset::own,
                        .own = {.sharpen_silhouettes = true, .colour_edges = true}};
    record_session(folder / "mine.dibhr", session);
    const auto replayed = [&](const std::string& file) {
        return run_dibhr(folder, {"replay", file});
    };
    const std::string identical = "all 1000 proxies and forces are identical";
    CHECK(contains(replayed("mine.dibhr").output, identical));
    run_shell(
        folder,
        "cp mine.dibhr other.dibhr; sqlite3 other.dibhr 'UPDATE source SET colour_edges = 0'");
    CHECK_FALSE(contains(replayed("other.dibhr").output, identical));  // else no proof
    fs::remove(folder / "film_color.mkv");
    const ProgramResult without = replayed("mine.dibhr");
    CHECK(without.exit_code == 1);
    CHECK(is_one_line(without.errors));
    CHECK(contains(without.errors, "film_color.mkv"));
}

TEST_CASE("sparse depth is replayed with the colour that it was interpolated with, bit for bit",
          "[replay]") {
    const TemporaryFolder folder;
    std::mt19937 random(3);
    std::string depth = "Pf\n120 90\n-1.0\n";
    for (int k = 0; k < 120 * 90; ++k) {
        const float surface = k % 120 < 63 ? 60.0F : 180.0F;
        const float level = random() % 10 == 0 ? surface : std::nanf("");
        const auto bytes = std::bit_cast<std::array<char, sizeof level>>(level);
        depth.append(bytes.data(), bytes.size());
    }
    write_text(folder / "mine_depth.pfm", depth);
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i color=size=120x90,format=gray,"
              "geq=lum='if(gt(X\\,65)\\,200\\,50)' -frames:v 1 mine_color.png");
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "mine_color.png",
                    .depth = folder / "mine_depth.pfm",
                    .cleaning = {.preset = CleaningPreset::own, .own = {.densify = true}}});
    const auto replayed = [&](const std::string& file) {
        return run_dibhr(folder, {"replay", file});
    };
    const std::string identical = "all 1000 proxies and forces are identical";
    CHECK(contains(replayed("mine.dibhr").output, identical));
    run_shell(folder,
              "cp mine.dibhr other.dibhr; sqlite3 other.dibhr 'UPDATE source SET densify = 0'");
    CHECK_FALSE(contains(replayed("other.dibhr").output, identical));  // else no proof
    fs::remove(folder / "mine_color.png");
    const ProgramResult without = replayed("mine.dibhr");
    CHECK(without.exit_code == 1);
    CHECK(contains(without.errors, "mine_color.png"));
}

TEST_CASE("several algorithms are compared in one table, the recorded one among them", "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    const ProgramResult result =
        run_dibhr(folder, {"replay", "mine.dibhr", "--algorithm", "pga", "--algorithm", "dibhr",
                           "--algorithm", "god-object"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    for (const char* word :
         {"\n  pga ", "\n  dibhr ", "\n  god-object ", "median us", "contact %"}) {
        CAPTURE(word);
        CHECK(contains(result.output, word));
    }
    CHECK(contains(result.output, "dibhr, as recorded: all 1000"));
    CHECK_FALSE(contains(result.output, "pga, as recorded"));
}

TEST_CASE("other parameters are a comparison, not a failure", "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    for (const std::vector<std::string>& change :
         {std::vector<std::string>{"--friction", "0.1"}, {"--raw-depth"}, {"--stiffness", "1.5"}}) {
        std::vector<std::string> arguments{"replay", "mine.dibhr"};
        arguments.insert(arguments.end(), change.begin(), change.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        CAPTURE(change, result.output, result.errors);
        CHECK(result.exit_code == 0);
        CHECK_FALSE(contains(result.output, "identical"));
    }
}

TEST_CASE("a session is felt again over depth that is cleaned otherwise, or with a finger",
          "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    const auto rows_with = [&](std::vector<std::string> change) {
        change.insert(change.begin(), {"replay", "mine.dibhr", "--csv", "again.csv"});
        const ProgramResult result = run_dibhr(folder, change);
        CAPTURE(change, result.output, result.errors);
        REQUIRE(result.exit_code == 0);
        auto rows = split(read_text(folder / "again.csv"), '\n');
        for (std::string& row : rows) row = row.substr(0, row.rfind(','));  // without its time
        return rows;
    };
    const auto recorded = rows_with({});
    const auto raw = rows_with({"--raw-depth"});
    CHECK((rows_with({"--cleaning", "raw"}) == raw));
    const auto sensor = rows_with({"--cleaning", "sensor"});
    CHECK((sensor != raw));
    const auto finger = rows_with({"--finger", "3"});
    CHECK((finger != recorded));
    CHECK((rows_with({"--cleaning", "sensor", "--finger", "3"}) != sensor));
    const auto gentle = rows_with({"--cleaning", "gentle"});
    CHECK((gentle != sensor));
}

TEST_CASE("what a session's depth meant is not changed by a word, nor its relief by none",
          "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    for (const std::vector<std::string>& word :
         {std::vector<std::string>{"--near", "dark"}, {"--relief", "auto"}}) {
        std::vector<std::string> arguments{"replay", "mine.dibhr"};
        arguments.insert(arguments.end(), word.begin(), word.end());
        const ProgramResult result = run_dibhr(folder, arguments);
        CAPTURE(word, result.errors);
        CHECK(result.exit_code == 2);
        CHECK(is_one_line(result.errors));
        CHECK(contains(result.errors, word.front()));
    }
}

TEST_CASE("a session felt with plain damping is computed again with a filtered one", "[replay]") {
    const TemporaryFolder folder;
    RecordedSession session = film_session();
    session.parameters.coupling.damping_newton_s_per_m = 5.0;
    record_session(folder / "mine.dibhr", session);
    const ProgramResult other =
        run_dibhr(folder, {"replay", "mine.dibhr", "--damping-cutoff", "50"});
    INFO(other.output << other.errors);
    CHECK(other.exit_code == 0);
    CHECK_FALSE(contains(other.output, "identical"));
    const ProgramResult same = run_dibhr(folder, {"replay", "mine.dibhr", "--damping-cutoff", "0"});
    CHECK(contains(same.output, "all 1000 proxies and forces are identical"));
}

TEST_CASE("the rows of a replay are those of touch, and the recorded ones", "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    REQUIRE(run_dibhr(folder, {"replay", "mine.dibhr", "--csv", "again.csv"}).exit_code == 0);
    REQUIRE(run_dibhr(folder, {"export", "mine.dibhr", "--csv", "mine.csv"}).exit_code == 0);
    const auto again = split(read_text(folder / "again.csv"), '\n');
    const auto mine = split(read_text(folder / "mine.csv"), '\n');
    REQUIRE(again.size() == 1002);  // heading, rows, and nothing after the last line's end
    REQUIRE(mine.size() == again.size());
    CHECK(again[0] + '\n' == kOutputHeader);
    for (std::size_t k = 0; k + 1 < again.size(); ++k) {
        const std::string before_time = again[k].substr(0, again[k].rfind(',') + 1);
        REQUIRE(mine[k].starts_with(before_time));
    }
    const ProgramResult out = run_dibhr(folder, {"replay", "mine.dibhr", "--csv", "-"});
    CHECK(out.exit_code == 0);
    CHECK(split(out.output, '\n').size() == 1002);
    const ProgramResult several = run_dibhr(folder, {"replay", "mine.dibhr", "--csv", "x",
                                                     "--algorithm", "pga", "--algorithm", "dibhr"});
    CHECK(several.exit_code == 2);
    CHECK(is_one_line(several.errors));
    const std::string before = read_text(folder / "mine.dibhr");
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr", "--csv", "mine.dibhr"}).exit_code == 1);
    CHECK(read_text(folder / "mine.dibhr") == before);
}

TEST_CASE("a result that is not the recorded one is told, with where it begins", "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    spoil_one_proxy(folder);
    const ProgramResult result = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(is_one_line(result.errors));
    CHECK(contains(result.errors, "mine.dibhr: dibhr differs from the recording in 1 of 1000"));
    CHECK(contains(result.errors, "first in tick "));

    // Ticks and times are counted from the session's first, wherever the loop's began.
    run_shell(folder, "sqlite3 mine.dibhr 'UPDATE tick_data SET tick = tick + 5000, t = t + 40'");
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr"}).errors == result.errors);
}

TEST_CASE("a difference is told with the libraries that are not those of the recording",
          "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    spoil_one_proxy(folder);
    const ProgramResult same = run_dibhr(folder, {"replay", "mine.dibhr"});
    CHECK(same.exit_code == 1);
    CHECK_FALSE(contains(same.errors, "recorded with"));

    const std::map<std::string, std::string> here = library_versions();
    set_fact(folder, "mine.dibhr", "libavcodec", "1.2.3");
    const ProgramResult one = run_dibhr(folder, {"replay", "mine.dibhr"});
    CHECK(one.exit_code == 1);
    CHECK(is_one_line(one.errors));
    CHECK(contains(one.errors, "; it was recorded with libavcodec 1.2.3, this is " +
                                   here.at("libavcodec") + "\n"));

    set_fact(folder, "mine.dibhr", "opencv", "3.4.5");
    const ProgramResult two = run_dibhr(folder, {"replay", "mine.dibhr"});
    CHECK(is_one_line(two.errors));
    CHECK(contains(two.errors, here.at("libavcodec") + "; with opencv 3.4.5, this is " +
                                   here.at("opencv") + "\n"));

    copy_session(folder / "good.dibhr");
    set_fact(folder, "good.dibhr", "libavcodec", "1.2.3");
    const ProgramResult good = run_dibhr(folder, {"replay", "good.dibhr"});
    CHECK(good.exit_code == 0);  // the bits count, not the versions
    CHECK(good.errors.empty());
}

TEST_CASE("SQL, report and replay tell the same share of the ticks in contact", "[replay]") {
    const TemporaryFolder folder;
    RecordedSession session = film_session();
    session.ticks_without_surface = 250;
    record_session(folder / "mine.dibhr", session);
    run_shell(folder,
              "sqlite3 mine.dibhr 'SELECT sum(1 - surface) FROM tick; "
              "SELECT printf(\"%.3f\", 100 * avg(contact)) FROM tick' > sql");
    const auto sql = split(read_text(folder / "sql"), '\n');
    REQUIRE(sql.at(0) == "250");
    const std::string percent = sql.at(1);
    const ProgramResult replay = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(percent << '\n' << replay.output << replay.errors);
    CHECK(replay.exit_code == 0);
    CHECK(contains(replay.output, " " + percent + "\n"));
    REQUIRE(run_dibhr(folder, {"report", "mine.dibhr", "--out", "report"}).exit_code == 0);
    run_shell(folder,
              "sqlite3 :memory: \"SELECT printf('%.3f', 100 * json_extract(readfile("
              "'report/report.json'), '\\$.contact_share'))\" > json");
    CHECK(read_text(folder / "json") == percent + "\n");
}

TEST_CASE("updates that end before the proxy has caught up are told, and replay to the same bits",
          "[replay]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i \"nullsrc=s=1200x20:r=30,format=gray,"
              "geq=lum='100+mod(X*X+7*Y,3)'\" -frames:v 3 -c:v ffv1 film_depth.mkv && "
              "cp film_depth.mkv film_color.mkv");
    RecordedSession session = session_over(folder.path());
    session.cleaning.preset = CleaningPreset::raw;
    session.parameters.friction = {0.0, 0.0};
    session.jumps = true;
    record_session(folder / "mine.dibhr", session);
    const ProgramResult result =
        run_dibhr(folder, {"replay", "mine.dibhr", "--algorithm", "dibhr", "--algorithm", "pga"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    const auto lines = split(result.output, '\n');
    for (const std::string algorithm : {"dibhr: ", "pga: "}) {
        CHECK(std::any_of(lines.begin(), lines.end(), [&algorithm](const std::string& line) {
            return line.starts_with(algorithm) &&
                   line.ends_with(
                       " of 1000 updates ended before the proxy had caught up with its goal");
        }));
    }
    CHECK(contains(result.output, "dibhr, as recorded: all 1000 proxies and forces are identical"));
}

TEST_CASE("a roughness without a bump map is told to be without effect", "[replay]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "bumps.png", 32, 24, 0, 8);
    copy_session(folder / "mine.dibhr");
    const ProgramResult result = run_dibhr(folder, {"replay", "mine.dibhr", "--roughness", "8"});
    CHECK(result.exit_code == 0);
    CHECK(is_one_line(result.errors));
    CHECK(contains(result.errors, "warning: --roughness changes nothing without a bump map"));
    CHECK(contains(result.errors, "--bump IMAGE"));
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr", "--roughness", "0"}).errors.empty());
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr", "--roughness", "8", "--bump", "bumps.png"})
              .errors.empty());
    RecordedSession bumpy = film_session();
    bumpy.bump = folder / "bumps.png";
    record_session(folder / "bumpy.dibhr", bumpy);
    CHECK(run_dibhr(folder, {"replay", "bumpy.dibhr", "--roughness", "8"}).errors.empty());
}

TEST_CASE("a tick over a video that the session does not name is told with its number",
          "[replay]") {
    const TemporaryFolder folder;
    copy_session(folder / "mine.dibhr");
    run_shell(folder, "sqlite3 mine.dibhr 'UPDATE tick_data SET pair = 999 WHERE tick = 500'");
    const ProgramResult result = run_dibhr(folder, {"replay", "mine.dibhr"});
    CHECK(result.exit_code == 1);
    CHECK(is_one_line(result.errors));
    CHECK(contains(result.errors, "mine.dibhr: does not say which video tick 500 touched"));
}

TEST_CASE("a video that is gone is looked for beside the session, and named", "[replay]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "films");
    copy_film(folder / "films");
    const RecordedSession session = session_over(folder / "films");
    record_session(folder / "mine.dibhr", session);
    fs::rename(folder / "films" / "film_depth.mkv", folder / "film_depth.mkv");
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr"}).exit_code == 0);
    fs::remove(folder / "film_depth.mkv");
    const ProgramResult result = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(result.errors);
    CHECK(result.exit_code == 1);
    CHECK(is_one_line(result.errors));
    CHECK(contains(result.errors, session.depth.string() + ", is not there"));
    CHECK(contains(result.errors, (folder / "film_depth.mkv").string()));
}

TEST_CASE("a video that has changed is refused, unless it is asked for", "[replay]") {
    const TemporaryFolder folder;
    copy_film(folder.path());
    record_session(folder / "mine.dibhr", session_over(folder.path()));
    const std::string recorded = read_text(folder / "film_depth.mkv");
    run_shell(folder, "printf x >>film_depth.mkv");
    const ProgramResult refused = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(refused.errors);
    CHECK(refused.exit_code == 1);
    CHECK(is_one_line(refused.errors));
    CHECK(contains(refused.errors, (folder / "film_depth.mkv").string() + ": has changed"));
    const ProgramResult taken = run_dibhr(folder, {"replay", "mine.dibhr", "--any-media"});
    CHECK(contains(taken.errors, "warning"));
    CHECK(taken.exit_code == 0);  // the file changed, its frames did not
    // The same length, other content.
    std::string other = recorded;
    other[other.size() / 2] = static_cast<char>(~other[other.size() / 2]);
    write_text(folder / "film_depth.mkv", other);
    CHECK(run_dibhr(folder, {"replay", "mine.dibhr"}).exit_code == 1);
    // The original beside the session wins over a changed one in its place.
    fs::create_directory(folder / "elsewhere");
    fs::rename(folder / "mine.dibhr", folder / "elsewhere" / "mine.dibhr");
    write_text(folder / "elsewhere" / "film_depth.mkv", recorded);
    CHECK(run_dibhr(folder, {"replay", "elsewhere/mine.dibhr"}).exit_code == 0);
}

TEST_CASE("a session over a folder of pictures replays, unless a picture has changed", "[replay]") {
    const TemporaryFolder folder;
    copy_film(folder.path());
    fs::create_directories(folder / "shots/rgb");
    fs::create_directories(folder / "shots/depth");
    run_shell(folder, "ffmpeg -v error -i film_color.mkv shots/rgb/%d.png");
    run_shell(folder, "ffmpeg -v error -i film_depth.mkv -pix_fmt gray16be shots/depth/%d.png");
    const bool as_one = GENERATE(true, false);
    const RecordedSession shots{.colour = as_one ? folder / "shots" : folder / "shots/rgb",
                                .depth = as_one ? folder / "shots" : folder / "shots/depth"};
    record_session(folder / "mine.dibhr", shots);
    const ProgramResult replayed = run_dibhr(folder, {"replay", "mine.dibhr"});
    INFO(replayed.output << replayed.errors);
    CHECK(replayed.exit_code == 0);
    CHECK(replayed.errors.empty());
    CHECK(contains(replayed.output, "as recorded: all 1000"));
    run_shell(folder, "cp shots/depth/1.png shots/depth/2.png");
    const ProgramResult refused = run_dibhr(folder, {"replay", "mine.dibhr"});
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.errors, "has changed"));
}

TEST_CASE("what can be read of a damaged session is, by every command, and one line says the rest",
          "[replay]") {
    const TemporaryFolder folder;
    RecordedSession session = film_session();
    session.seconds = 2.0;
    record_session(folder / "mine.dibhr", session);
    const std::string whole = read_text(folder / "mine.dibhr");
    std::string torn = whole;
    constexpr std::size_t kPage = 16384;
    for (std::size_t page = 4 * kPage; page + kPage <= torn.size(); page += 4 * kPage)
        std::fill_n(torn.begin() + static_cast<std::ptrdiff_t>(page), kPage, 'x');
    for (const auto& [bytes, word] :
         {std::pair(whole.substr(0, whole.size() * 4 / 5), "mine.dibhr: is cut short ("),
          std::pair(torn, "mine.dibhr: is damaged: ")}) {
        write_text(folder / "mine.dibhr", bytes);
        for (const std::vector<std::string>& command : {std::vector<std::string>{"info"},
                                                        {"export", "--csv", "-"},
                                                        {"report", "--out", "r"}}) {
            std::vector<std::string> arguments = command;
            arguments.push_back("mine.dibhr");
            const ProgramResult result = run_dibhr(folder, arguments);
            CAPTURE(command, word, result.errors);
            CHECK(result.exit_code == 0);
            CHECK_FALSE(result.output.empty());
            CHECK(is_one_line(result.errors));
            CHECK(contains(result.errors, word));
            CHECK(contains(result.errors, " of 2000 ticks cannot be read ("));
            CHECK(contains(result.errors, "from "));  // behind "the first ..." where these are torn
        }
        CHECK(read_text(folder / "mine.dibhr") == bytes);
        // Until the first tick that is lost, the bits are the same.
        const ProgramResult replayed = run_dibhr(folder, {"replay", "mine.dibhr"});
        CHECK(contains(replayed.errors, word));
        CHECK(replayed.exit_code == (bytes == torn ? 1 : 0));
    }
}

TEST_CASE("files that are no session are refused by every command in one line", "[replay]") {
    const TemporaryFolder folder;
    RecordedSession session = film_session();
    session.seconds = 0.2;
    record_session(folder / "good.dibhr", session);
    const std::string good = read_text(folder / "good.dibhr");
    constexpr std::ptrdiff_t kHead = 9000;  // in which there is no tick
    write_text(folder / "short.dibhr", good.substr(0, kHead));
    write_text(folder / "text.dibhr", "t,x,y,z\n");
    write_text(folder / "empty.dibhr", "");
    run_shell(folder, "sqlite3 other.dibhr 'CREATE TABLE a(b)'");
    run_shell(folder,
              "sqlite3 P07.dibhr-study 'PRAGMA application_id = 1684566900; CREATE TABLE a(b)'");
    std::string damaged = good;
    std::fill(damaged.begin() + kHead, damaged.end(), 'x');
    write_text(folder / "damaged.dibhr", damaged);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info"}, {"replay"}, {"export", "--csv", "-"}}) {
        for (const auto& [name, word] :
             std::vector<std::pair<std::string, std::string>>{{"short.dibhr", "cut short"},
                                                              {"text.dibhr", "no SQLite file"},
                                                              {"empty.dibhr", "empty"},
                                                              {"other.dibhr", "another program"},
                                                              {"P07.dibhr-study", "study report"},
                                                              {"damaged.dibhr", "damaged"},
                                                              {"none.dibhr", "no such file"}}) {
            std::vector<std::string> arguments = command;
            arguments.push_back(name);
            const ProgramResult result = run_dibhr(folder, arguments);
            CAPTURE(command, name, result.errors);
            CHECK(result.exit_code == 1);
            CHECK(result.output.empty());
            CHECK(is_one_line(result.errors));
            CHECK(contains(result.errors, name));
            CHECK(contains(result.errors, word));
        }
    }
}

TEST_CASE("a session of every schema is read by every command, and replayed to its bits",
          "[replay]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    const auto& [name, ticks] =
        GENERATE(from_range(std::vector<std::pair<std::string, int>>{{"schema_1", 3},
                                                                     {"schema_2_first_view", 80},
                                                                     {"schema_2_first", 80},
                                                                     {"schema_3", 500},
                                                                     {"schema_4", 500}}));
    CAPTURE(name);
    run_shell(folder, "sqlite3 old.dibhr \".read '" DIBHR_SOURCE_DIR "/tests/data/sessions/" +
                          name + ".sql'\"");
    const auto succeeds = [&folder](const std::vector<std::string>& arguments) {
        const ProgramResult result = run_dibhr(folder, arguments);
        CAPTURE(arguments, result.errors);
        REQUIRE(result.exit_code == 0);
        return result;
    };
    CHECK(contains(succeeds({"info", "old.dibhr"}).output, std::to_string(ticks)));
    CHECK(split(succeeds({"export", "old.dibhr", "--csv", "-"}).output, '\n').size() ==
          static_cast<std::size_t>(ticks) + 2);
    succeeds({"report", "old.dibhr", "--out", "r"});
    CHECK(contains(read_text(folder / "r/report.html"), "of the first day"));
    const std::vector<std::string> replay{"replay",      "old.dibhr", "--algorithm", "dibhr",
                                          "--algorithm", "pga",       "--algorithm", "neighborhood",
                                          "--algorithm", "god-object"};
    if (name != "schema_1") {
        CHECK(contains(succeeds(replay).output,
                       "dibhr, as recorded: all " + std::to_string(ticks) + " proxies and forces"));
        return;
    }
    const ProgramResult refused = run_dibhr(folder, replay);
    CHECK(refused.exit_code != 0);
    CHECK(contains(refused.errors, "is of format 1, the first"));
    CHECK(contains(refused.errors, "it can be exported, but not replayed"));
}

TEST_CASE("every command reads a session of a newer dibhr, and says in one line what it is",
          "[replay]") {
    const TemporaryFolder folder;
    RecordedSession session = film_session();
    session.seconds = 0.2;
    record_session(folder / "newer.dibhr", session);
    run_shell(folder, "sqlite3 newer.dibhr 'PRAGMA user_version = 99'");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info"}, {"replay"}, {"export", "--csv", "-"}}) {
        std::vector<std::string> arguments = command;
        arguments.push_back("newer.dibhr");
        const ProgramResult result = run_dibhr(folder, arguments);
        CAPTURE(command, result.errors);
        CHECK(result.exit_code == 0);
        CHECK_FALSE(result.output.empty());
        CHECK(is_one_line(result.errors));
        CHECK(contains(result.errors, "newer.dibhr: was recorded by a newer dibhr (format 99"));
    }
}

TEST_CASE("twenty seconds of the sample go through all four algorithms in two seconds of a core",
          "[replay][bench]") {
    const TemporaryFolder folder;
    const SampleFiles sample = sample_files();
    record_session(folder / "mine.dibhr",
                   {.colour = sample.colour, .depth = sample.depth, .seconds = 20.0});
    const ProgramResult result =
        run_dibhr(folder, {"replay", "mine.dibhr", "--algorithm", "dibhr", "--algorithm", "pga",
                           "--algorithm", "neighborhood", "--algorithm", "god-object"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(contains(result.output, "dibhr, as recorded: all 20000"));
#if !DIBHR_SANITIZED
    // Other work on the same core and caches makes a replay at most three times as slow.
    CHECK(result.cpu_s < 3.0 * 2.0);
#endif
}
