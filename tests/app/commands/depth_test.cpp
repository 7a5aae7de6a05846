// `dibhr depth` as people and scripts use it, with small programs in place of an estimator.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/settings/settings.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// Made once.
fs::path clip() {
    static const TemporaryFolder folder;
    const fs::path file = folder / "clip.mp4";
    if (!fs::exists(file))
        run_shell(folder,
                  "ffmpeg -v error -f lavfi -i \"color=black:s=64x48:r=30,format=gray,"
                  "geq=lum='X+5*N'\" -frames:v 12 -c:v libx264 -crf 8 -pix_fmt yuv420p clip.mp4");
    return file;
}

/// A folder with clip.mp4, colour alone, and an estimator that copies frames.
struct Home {
    TemporaryFolder folder{};

    Home() {
        fs::copy_file(clip(), folder / "clip.mp4");
        write_estimator("estimator", "");
    }
    void write_estimator(const std::string& name, const std::string& each) const {
        write_text(folder / name, "#!/bin/sh\necho once >> '" + (folder / "starts").string() +
                                      "'\nfor f in \"$1\"/*.png; do\nn=${f##*/}\n" + each +
                                      "\ncp \"$f\" \"$2/.$n\" && mv \"$2/.$n\" \"$2/$n\"\ndone\n");
        fs::permissions(folder / name, fs::perms::owner_all);
    }
    [[nodiscard]] ProgramResult depth(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "depth");
        return run_dibhr(folder, arguments);
    }
    [[nodiscard]] std::size_t starts() const { return read_text(folder / "starts").size() / 5; }
};

constexpr std::chrono::seconds kPatience{60};  // of a test; a hung estimator waits for longer
const std::string kWith = "./estimator {frames} {output}";

void check_refused(const ProgramResult& result, int exit_code, const std::string& words) {
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    CHECK(split(result.errors, '\n').size() == 2);
    CHECK(contains(result.errors, words));
}

}  // namespace

TEST_CASE("depth prints where the depth is, which is known by its meaning and kept", "[depth]") {
    const Home home;
    const ProgramResult first = home.depth({"clip.mp4", "--with", kWith});
    INFO(first.errors);
    REQUIRE(first.exit_code == 0);
    CHECK(first.errors.empty());
    const std::string file = first.output.substr(0, first.output.find('\n'));
    CHECK(file.starts_with((home.folder / "cache/dibhr/depth/").string()));
    CHECK(home.depth({"clip.mp4", "--with", kWith}).output == first.output);
    CHECK(home.starts() == 1);
    const std::string info = run_dibhr(home.folder, {"info", file}).output;
    CHECK(contains(info, "near is bright"));
    CHECK(contains(info, "assumed           nothing"));
    CHECK(contains(info, "frames            12"));
    CHECK(home.depth({"clip.mp4", "--with", kWith, "--depth-unit", "disparity"}).exit_code == 0);
    CHECK(contains(run_dibhr(home.folder, {"info", file}).output, "disparity"));
    CHECK(home.starts() == 1);
}

TEST_CASE("depth copied beside its colour is found with it", "[depth]") {
    const Home home;
    const ProgramResult made = home.depth({"clip.mp4", "--with", kWith, "--out", "."});
    REQUIRE(made.exit_code == 0);
    CHECK(made.output == "./clip_depth.mkv\n");
    CHECK(fs::exists(home.folder / "clip_depth.toml"));
    const ProgramResult felt =
        run_dibhr(home.folder, {"surface", "clip.mp4", "--time", "0.1", "--out", "felt.png"});
    INFO(felt.errors);
    CHECK(felt.exit_code == 0);
    CHECK(home.depth({"clip.mp4", "--with", kWith, "--out", "other.mkv"}).output == "other.mkv\n");
    CHECK(home.starts() == 1);
    check_refused(home.depth({"clip.mp4", "--with", kWith, "--out", "other.mp4"}), 1,
                  "the depth is written as .mkv");
}

TEST_CASE("an estimator is named once, and is then the one that is taken", "[depth]") {
    const Home home;
    check_refused(home.depth({"clip.mp4"}), 2, "no estimator is known");
    REQUIRE(home.depth({"clip.mp4", "--with", kWith, "--as", "mine", "--near", "dark"}).exit_code ==
            0);
    CHECK(contains(read_text(home.folder / "dibhr/settings.toml"), "[estimators]\nmine = { "));
    REQUIRE(home.depth({"clip.mp4", "--again"}).exit_code == 0);
    CHECK(home.starts() == 2);
    const std::string file = home.depth({"clip.mp4", "--with", "mine"}).output;
    CHECK(contains(run_dibhr(home.folder, {"info", file.substr(0, file.size() - 1)}).output,
                   "near is dark"));
    CHECK(home.starts() == 2);
    check_refused(home.depth({"clip.mp4", "--with", "other"}), 2,
                  "nor the name of an estimator (mine)");
}

TEST_CASE("an estimator of somebody's settings is not run until it is given here", "[depth]") {
    const Home home;
    fs::create_directories(home.folder / "dibhr");
    write_text(home.folder / "dibhr/settings.toml",
               "[estimators]\nmine = \"./estimator  {frames}\\u001b[8m {output}\"\n"
               "second = \"" +
                   kWith + "\"\n");
    check_refused(home.depth({"clip.mp4"}), 1,
                  "the command is ./estimator \\x20{frames}\\x1b[8m {output}\n");
    check_refused(home.depth({"clip.mp4", "--with", "second"}), 1,
                  "the command is " + kWith + "\n");
    CHECK(home.starts() == 0);
    CHECK(home.depth({"clip.mp4", "--with", kWith}).exit_code == 0);
    CHECK(home.depth({"clip.mp4", "--with", "second", "--again"}).exit_code == 0);
    CHECK(home.starts() == 2);
    check_refused(home.depth({"clip.mp4"}), 1,
                  "the estimator mine, but nobody on this machine has agreed to run");
}

TEST_CASE("estimators in the settings come back as they were, and one that cannot be is told",
          "[depth]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "settings.toml";
    write_text(file,
               "[estimators]\nb = \"run \\\"it\\\" {input} {output}\"\n"
               "a = { command = 'm {frames} {output}', unit = \"m\", scale = 0.5 }\n"
               "c = 7\nd = { command = \"x\", unit = \"ells\" }\n\"e f\" = \"x\"\n");
    std::vector<std::string> warnings;
    const Settings settings = load_settings(file, warnings);
    const std::vector<Estimator> wanted{
        {"b", "run \"it\" {input} {output}", {}},
        {"a", "m {frames} {output}", {.unit = DepthUnit::m, .scale = 0.5}}};
    CHECK(settings.estimators == wanted);
    REQUIRE(warnings.size() == 3);
    CHECK(contains(warnings[0], ":4: estimators.c is neither a command in quotes nor a table"));
    CHECK(contains(warnings[1], ":5: estimators.d is not understood: "));
    CHECK(contains(warnings[2], ":6: estimators.e f is not a name of letters"));
    save_settings(settings, file);
    warnings.clear();
    CHECK(load_settings(file, warnings).estimators == wanted);
    CHECK(warnings.empty());
}

TEST_CASE("what is kept is listed, and goes when it is asked to", "[depth]") {
    const Home home;
    CHECK(home.depth({"--list"}).output.starts_with("0 MB in "));
    REQUIRE(home.depth({"clip.mp4", "--with", kWith}).exit_code == 0);
    const std::string list = home.depth({"--list"}).output;
    CHECK(contains(list, "clip.mp4: 12 frames, "));
    CHECK(contains(list, "by " + kWith));
    CHECK(home.depth({"--forget", "other.mp4"}).output == "0 MB removed\n");
    CHECK(home.depth({"--forget", "clip.mp4"}).output.ends_with(" MB removed\n"));
    CHECK(home.depth({"--list"}).output.starts_with("0 MB in "));
}

TEST_CASE("wrong use ends with 2, a failure with 1, each in a line", "[depth]") {
    const Home home;
    check_refused(home.depth({}), 2, "COLOR is required");
    check_refused(home.depth({"clip.mp4", "--with", "x"}), 2, "--with 'x' is neither a command");
    check_refused(home.depth({"clip.mp4", "--with", "run {input}"}), 1, "has no {output}");
    check_refused(home.depth({"none.mp4", "--with", kWith}), 1, "none.mp4");
    check_refused(home.depth({"clip.mp4", "--with", "./none {input} {output}"}), 1,
                  "there is no program './none'");
    check_refused(home.depth({"clip.mp4", "--with", "x", "--patience", "0"}), 2, "--patience");
    home.write_estimator("crash", "[ $n = 000007.png ] && kill -SEGV $$");
    check_refused(home.depth({"clip.mp4", "--with", "./crash {frames} {output}"}), 1,
                  "at frame 7 of 12; 6 are kept: run it again to go on from there");
    CHECK(contains(home.depth({"--list"}).output, "clip.mp4: 6 of 12 frames, "));
}

TEST_CASE("an estimator's exit code is reported where dibhr inherits an ignored SIGCHLD",
          "[depth]") {
    const Home home;
    home.write_estimator("crash", "[ $n = 000007.png ] && exit 3");
    const ProgramResult result =
        run_dibhr(home.folder, {"depth", "clip.mp4", "--with", "./crash {frames} {output}"},
                  {"/usr/bin/env", "--ignore-signal=CHLD"});
    check_refused(result, 1, "ended with 3 at frame 7 of 12");
}

TEST_CASE("a picture that an estimator leaves broken is named, and made anew the next time",
          "[depth]") {
    const Home home;
    home.write_estimator("careless", "[ $n = 000007.png ] && [ ! -e '" +
                                         (home.folder / "go").string() +
                                         "' ] && head -c 60 \"$f\" > \"$2/$n\" && continue");
    const std::vector<std::string> words{"clip.mp4", "--with", "./careless {frames} {output}"};
    check_refused(home.depth(words), 1, "cannot be read, '000007.png', which is removed");
    write_text(home.folder / "go", "");
    CHECK(home.depth(words).exit_code == 0);
}

TEST_CASE("Ctrl+C ends the estimator, and the next run goes on", "[depth]") {
    const Home home;
    home.write_estimator("slow", "[ $n = 000004.png ] && [ ! -e '" + (home.folder / "go").string() +
                                     "' ] && sleep 600");
    const std::string cache = "XDG_CACHE_HOME=" + (home.folder / "cache").string();
    const std::string config = "XDG_CONFIG_HOME=" + home.folder.path().string();
    const std::string with = (home.folder / "slow").string() + " {frames} {output}";
    const std::vector<std::string> words{DIBHR_PROGRAM, "depth",
                                         (home.folder / "clip.mp4").string(), "--with", with};
    const auto under_way = [&] {
        std::error_code changed;
        for (const auto& entry : fs::recursive_directory_iterator(home.folder / "cache", changed))
            if (entry.path().filename() == "000003.png" &&
                entry.path().parent_path().filename() == "output")
                return true;
        return false;
    };
    {
        Process slow(words, {cache, config}, home.folder / "errors.txt");
        CHECK(eventually(under_way, kPatience));
        slow.interrupt();
        CHECK(slow.wait() == 130);
    }
    CHECK(contains(read_text(home.folder / "errors.txt"), "cancelled"));
    CHECK(home.starts() == 1);
    CHECK(contains(home.depth({"--list"}).output, ": 3 of 12 frames"));
    write_text(home.folder / "go", "");
    CHECK(home.depth({words[2], "--with", with}).exit_code == 0);
    CHECK(home.starts() == 2);
}

TEST_CASE("a program that is killed leaves no estimator behind, and the next run goes on",
          "[depth]") {
    const Home home;
    const fs::path pid = home.folder / "pid";
    const fs::path go = home.folder / "go";
    home.write_estimator("slow", "[ $n = 000004.png ] && [ ! -e '" + go.string() +
                                     "' ] && echo $$ > '" + pid.string() + "' && exec sleep 600");
    const std::string with = (home.folder / "slow").string() + " {frames} {output}";
    const std::string clip = (home.folder / "clip.mp4").string();
    {
        Process slow({DIBHR_PROGRAM, "depth", clip, "--with", with},
                     {"XDG_CACHE_HOME=" + (home.folder / "cache").string(),
                      "XDG_CONFIG_HOME=" + home.folder.path().string()},
                     home.folder / "errors.txt");
        REQUIRE(eventually([&] { return read_text(pid).ends_with('\n'); }, kPatience));
        slow.send(SIGKILL);
        slow.wait();
    }
    const std::string estimator = read_text(pid);
    const fs::path there = "/proc/" + estimator.substr(0, estimator.find('\n')) + "/stat";
    CHECK(eventually(
        [&] {
            const std::string state = read_text(there);
            return state.empty() || state.find(") Z ") != std::string::npos;
        },
        kPatience));
    write_text(go, "");
    CHECK(home.depth({clip, "--with", with}).exit_code == 0);
    CHECK(home.starts() == 2);
}
