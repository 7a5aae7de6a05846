// The example in the room's README, run as it stands there by SQLite's own shell.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "core/session/recorder.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The text between ```sql and ``` in the README.
std::string example() {
    const std::string text =
        text_of(std::filesystem::path(DIBHR_SOURCE_DIR) / "core/session/README.md");
    const std::string begin = "```sql\n";
    const std::size_t at = text.find(begin);
    REQUIRE(at != std::string::npos);
    return text.substr(at + begin.size(), text.find("```", at + begin.size()) - at - begin.size());
}

}  // namespace

TEST_CASE("the README's ten lines run in SQLite's own shell", "[session]") {
    if (std::system("command -v sqlite3 >/dev/null") != 0) {
        WARN("the sqlite3 shell is not installed");
        return;
    }
    const SessionFolder folder;
    MovingSurface surface;
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {{"device", "a made-up hand"}});
        Exploration hand(surface);
        recorder.parameters(hand.parameters);
        recorder.media(1, {}, "/depth.mp4");  // the shell breaks a longer path, wherever we run
        for (int k = 0; k < 1500; ++k) push(*ring, hand.next());
        recorder.mark("M1");
    }
    const auto script = folder.path() / "example.sql";
    const auto output = folder.path() / "output";
    std::ofstream(script) << example();
    const std::string command = "sqlite3 -bail -readonly '" + folder.file().string() + "' <'" +
                                script.string() + "' >'" + output.string() + "' 2>&1";
    const int result = std::system(command.c_str());
    const std::string answers = text_of(output);
    CAPTURE(answers);
    CHECK(result == 0);
    for (const char* expected : {"a made-up hand", "1500", "share_in_contact", "dibhr", "depth.mp4",
                                 "triangle", "dwell", "M1"}) {
        CAPTURE(expected);
        CHECK(answers.find(expected) != std::string::npos);
    }
}
