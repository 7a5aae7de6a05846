// What people write to start an estimator, and what estimators print.
#include "core/estimate/estimator_command.hpp"

#include <cstdlib>
#include <string>
#include <vector>

#include "core/estimate/printed_progress.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& command) {
    return EstimatorCommand(command).words({"/a b/clip.mp4", "/c/frames", "/c/output"});
}

std::string refused(const std::string& command) {
    return refusal([&command] { EstimatorCommand{command}; });
}

}  // namespace

TEST_CASE("a command is split as a shell splits it, and places take paths as they are",
          "[estimate]") {
    CHECK(words_of("run {input} {output}") == Words{"run", "/a b/clip.mp4", "/c/output"});
    CHECK(
        words_of("  'a program'  \"with \\\"this\\\" and '\" that\\ too --in={input}\n{output}") ==
        Words{"a program", "with \"this\" and '", "that too", "--in=/a b/clip.mp4", "/c/output"});
    CHECK(words_of("r '' {frames} {output.mp4}") ==
          Words{"r", "", "/c/frames", "/c/output/depth.mp4"});
    CHECK(words_of("r '{\"a\": 1}' {} {input} {output}").at(1) == "{\"a\": 1}");
    CHECK(words_of("r $HOME * {input} {output}").at(1) == "$HOME");
    const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "~";
    CHECK(words_of("~/r a~ '~' {input} {output}") ==
          Words{home + "/r", "a~", "~", "/a b/clip.mp4", "/c/output"});
    CHECK(EstimatorCommand("r {frames} {output}").takes_frames());
    CHECK_FALSE(EstimatorCommand("r {input} {output}").takes_frames());
}

TEST_CASE("what cannot be a command is told what it lacks", "[estimate]") {
    CHECK(contains(refused(""), "is empty"));
    CHECK(contains(refused("run {input}"), "has no {output}"));
    CHECK(contains(refused("run {output}"), "neither {input}, the video, nor {frames}"));
    CHECK(contains(refused("run {input} {frames} {output}"), "both {input} and {frames}"));
    CHECK(contains(refused("run {video} {output}"), "has {video}: its places are"));
    CHECK(contains(refused("run 'open {input} {output}"), "has a ' that is not closed"));
    CHECK(contains(refused("cd x && run {input} {output}"),
                   "has &&, but is started without a shell"));
    CHECK(contains(refused("run {input} {output} > log"), "has >"));
    CHECK(contains(refused("sh -c 'cd x; run {input}' {output}"), "inside a longer text"));
}

TEST_CASE("of what an estimator prints the count of its frames is understood", "[estimate]") {
    PrintedProgress spoken;
    CHECK_FALSE(spoken.done_of(24));
    spoken.take("Loading checkpoint shards: 100%|##| 2/2 [00:01<00:00]\n");
    CHECK_FALSE(spoken.done_of(24));
    spoken.take("infer:  25%|##");
    spoken.take("      | 6/24 [00:0\r");
    CHECK(spoken.done_of(24) == 6U);
    spoken.take("infer:  29%|##        | 7/24");
    CHECK(spoken.done_of(24) == 7U);
    CHECK(spoken.last_line() == "infer:  29%|##        | 7/24");
    spoken.take("\n  processing a.png (8 of 24)\n   \n");
    CHECK(spoken.done_of(24) == 8U);
    CHECK(spoken.last_line() == "  processing a.png (8 of 24)");
    CHECK(spoken.done_of(25) == 8U);
    CHECK_FALSE(spoken.done_of(60));
    spoken.take(std::string("\x01\x02\xff 99999999999999999999/3 /// of 1/0\n"));
    spoken.take(std::string(100000, '7'));
    CHECK(spoken.done_of(24) == 8U);
}
