// Names of pictures and clips.
#include "app/settings/name_pattern.hpp"

#include <string>

#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

NameFacts facts() {
    NameFacts facts{.file = "hand.v2/left", .media_s = 64.6314, .frame = 139};
    facts.now.tm_year = 126;
    facts.now.tm_mon = 10;
    facts.now.tm_mday = 3;
    facts.now.tm_hour = 6;
    facts.now.tm_min = 7;
    facts.now.tm_sec = 42;
    return facts;
}

}  // namespace

TEST_CASE("a name is made of date, file, time and frame", "[names]") {
    CHECK(name_from({}, facts()) == "dibhr-20261103-060742");
    CHECK(name_from({"shots/{file}-{time}-{frame} 100%%"}, facts()) ==
          "shots/hand.v2-left-01m04.631s-000139 100%");
}

TEST_CASE("names of later moments stand after those before", "[names]") {
    const NamePattern pattern{"{time}-{frame}"};
    std::string before;
    for (int frame = 1; frame < 200; frame += 7) {
        const std::string name = name_from(pattern, {.media_s = 0.77 * frame, .frame = frame});
        CHECK(name > before);
        before = name;
    }
}

TEST_CASE("a pattern with another placeholder, or that names no file, is none", "[names]") {
    CHECK(problem_of({}).empty());
    CHECK(problem_of({"%Y%m%d%H%M%S%%{file}{time}{frame} {"}) != "");
    for (const char* pattern : {"", "folder/", "%", "%Q", "x%", "{name}", "{file", "a\nb"}) {
        CAPTURE(pattern);
        CHECK_FALSE(problem_of({pattern}).empty());
    }
    const TemporaryFolder folder;
    const ProgramResult result =
        run_dibhr(folder, {"view", "--screenshot-name", "{name}", "--seconds", "0"});
    CHECK(result.exit_code == 2);
    CHECK(contains(result.errors, "--screenshot-name"));
}
