// What the program has written is there when the power comes back, or what was there before.
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/estimate/depth_cache.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/power_cut/cut_work.hpp"
#include "tests/app/power_cut/power_cut.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

constexpr int kFew = 5;
constexpr int kMany = 50;

PowerCut::Work writing(const std::string& what) {
    return cut_work().at(what);
}

/// So many moments from the first step to the last, and one when the program has ended.
std::vector<int> moments(int steps, int most) {
    std::vector<int> all;
    const int count = std::min(steps, most);
    for (int k = 0; k < count; ++k) all.push_back(k * steps / count);
    all.push_back(steps);
    return all;
}

/// Cuts the power at so many moments; `check` looks at each disk that may be left.
template <typename Check>
void cut(PowerCut& program, int most, const Check& check) {
    REQUIRE(program.run());
    const int steps = program.steps();
    REQUIRE(steps > 0);
    for (const int at : moments(steps, most)) {
        const bool ended = program.run(at);
        const int lines = program.lines();
        for (const Lost lost : {Lost::all, Lost::contents, Lost::some}) {
            CAPTURE(at, steps, static_cast<int>(lost));
            program.come_back(lost, static_cast<unsigned>(at));
            check(ended, lines, lost);
        }
    }
}

bool is_unfinished(const std::string& name) {
    return name.find(".part") != std::string::npos;
}

/// Every file is what it was or what it was to become, and that when the program has ended; and the
/// program does all of it again, and clears away.
void check_whole_files(PowerCut& program, int most) {
    REQUIRE(program.run());
    program.come_back(Lost::contents, 0);
    const FileTree after = program.files();
    program.run(0);
    program.come_back(Lost::all, 0);
    const FileTree before = program.files();
    REQUIRE(after != before);
    cut(program, most, [&](bool ended, int, Lost lost) {
        const FileTree now = program.files();
        for (const auto& [name, bytes] : now) {
            if (is_unfinished(name)) continue;
            CAPTURE(name);
            const auto as_in = [&name = name, &bytes = bytes](const FileTree& tree) {
                const auto found = tree.find(name);
                return found != tree.end() && found->second == bytes;
            };
            CHECK((as_in(after) || (!ended && as_in(before))));
        }
        for (const auto& [name, bytes] : ended ? after : before) CHECK(now.contains(name));
        if (lost != Lost::some) return;
        REQUIRE(program.run_again());
        CHECK(program.files() == after);
    });
}

void nothing(const fs::path&) {}

void put_settings(const fs::path& disk) {
    fs::create_directory(disk / "dibhr");
    write_text(disk / "dibhr" / "settings.toml", "version = 1\n");
}

void put_depth(const fs::path& disk) {
    write_picture(disk / "depth.png", 64, 48, 8, 1, [](int i, int j, int) { return i + j; });
}

void put_estimator(const fs::path& disk) {
    make_flat_clip(disk / "colour.mkv", 3, 30, kLossless);
    write_text(disk / "estimator", "#!/bin/sh\ncp \"$1\"/*.png \"$2\"\n");
    fs::permissions(disk / "estimator", fs::perms::owner_all);
}

/// The same each time.
void put_session(const fs::path& disk) {
    static const TemporaryFolder folder;
    const fs::path file = folder / "mine.dibhr";
    if (!fs::exists(file)) cut_work().at("session")(folder.path());
    fs::copy_file(file, disk / "mine.dibhr");
}

PowerCut::Work prepare_for(const std::string& what) {
    if (what == "maps") return put_depth;
    if (what == "settings") return put_settings;
    if (what == "report") return put_session;
    return nothing;
}

void check_files_of(const std::string& what, int most) {
    CAPTURE(what);
    PowerCut program(writing(what), prepare_for(what));
    check_whole_files(program, most);
}

void check_export(const std::vector<std::string>& arguments, int most,
                  const PowerCut::Work& prepare = put_depth) {
    CAPTURE(arguments);
    PowerCut program(PowerCut::program(arguments), prepare);
    check_whole_files(program, most);
}

void check_session(const std::string& what, int most) {
    PowerCut program(writing(what), nothing);
    cut(program, most, [&](bool ended, int kept, Lost) {
        const fs::path file = program.disk() / "mine.dibhr";
        if (kept == 0) return;  // not yet begun
        try {
            const Session session(file);
            session.check();
            CHECK(session.missing() == 0);
            if (!ended) return;
            CHECK(session.rows() == kCutTicks);
            CHECK(session.fact("complete") == "1");
        } catch (const InputError& error) {
            FAIL(error.what());
        }
    });
}

void check_study(int most) {
    PowerCut program(writing("study"), nothing);
    cut(program, most, [&](bool ended, int kept, Lost) {
        const fs::path file = study_file_of(program.disk(), "P07");
        const int answers = std::max(0, std::min(kept - 1, kCutTrials));
        if (kept > 0) {
            const StudyRecord study = read_study(file);
            CHECK(static_cast<int>(study.answered.size()) >= answers);
            CHECK((study.finished || !ended));
        }
        StudyFile again(file, cut_identity());
        const auto count = static_cast<int>(again.answered().size());
        CHECK(count >= answers);
        for (int number = count; number < kCutTrials; ++number) again.add(cut_trial(number));
    });
}

void check_cache(int most) {
    PowerCut program(writing("cache"), put_estimator);
    cut(program, most, [&](bool ended, int, Lost) {
        EstimateWatch watch;
        const auto made = estimate_depth(cut_request(program.disk()), watch);
        REQUIRE(made);
        CHECK((made->kept_before || !ended));
        const auto depth = open_depth(made->depth);
        int frame = 0;
        for (; const auto next = depth->next(); ++frame)
            CHECK(next->depth.at(3, 3) == 5.0F * static_cast<float>(frame));
        CHECK(frame == 3);
    });
}

}  // namespace

TEST_CASE(
    "settings, history, maps, materials, pictures and clips are the old or the new ones after "
    "a power cut, and the new ones once they are written",
    "[power]") {
    check_files_of(GENERATE("settings", "history", "maps", "material", "pictures"), kFew);
}

TEST_CASE("an export is there whole or not at all after a power cut", "[power]") {
    check_export({"surface", "@depth.png", "--out", "@made.ply"}, 2);
}

TEST_CASE("a session that has ended lasts through a power cut, and is sound before", "[power]") {
    check_session("session", kFew);
}

TEST_CASE("no answer of a person is lost by a power cut", "[power]") {
    check_study(kFew);
}

TEST_CASE("depth that is kept is what was made, whatever a power cut has left of it", "[power]") {
    check_cache(kFew);
}

TEST_CASE("the power is cut at fifty moments of everything that is written", "[power][long]") {
    for (const char* const what : {"settings", "history", "maps", "material", "pictures", "report"})
        check_files_of(what, kMany);
    check_export({"surface", "@depth.png", "--out", "@made.ply"}, kMany);
    check_export({"export", "@mine.dibhr", "--csv", "@made.csv"}, kMany, put_session);
    check_session("session", kMany);
    check_session("recording", 10);
    check_study(kMany);
    check_cache(kMany);
}
