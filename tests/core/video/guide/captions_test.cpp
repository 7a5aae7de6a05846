// Captions beside a recording: WebVTT as editors write it.
#include "core/video/guide/captions.hpp"

#include <string>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kTwo =
    "WEBVTT - of the cup\n\nNOTE\nnothing --\n\n1\n00:01.000 --> 00:02.500 line:0\nA "
    "<b>blue</b> cup,\nhalf full.\n\n01:00:03.250 --> 01:00:04.000\nMilk &amp; sugar\n";

}  // namespace

TEST_CASE("a caption is shown from its begin until its end", "[captions]") {
    const Captions captions = captions_in(kTwo, "cup.vtt");
    REQUIRE(captions.all.size() == 2);
    CHECK(captions.at(0.999).empty());
    CHECK(captions.at(1.0) == "A blue cup,\nhalf full.");
    CHECK(captions.at(2.499) == "A blue cup,\nhalf full.");
    CHECK(captions.at(2.5).empty());
    CHECK(captions.at(3603.5) == "Milk & sugar");
}

TEST_CASE("captions that overlap are shown together in the order of their begins", "[captions]") {
    const Captions captions = captions_in(
        "WEBVTT\r\n\r\n00:02.000 --> 00:05.000\r\nlater\r\n\r\n00:01.000 --> "
        "00:03.000\r\nfirst\r\n",
        "cup.vtt");
    CHECK(captions.at(1.5) == "first");
    CHECK(captions.at(2.5) == "first\nlater");
    CHECK(captions.at(4.0) == "later");
}

TEST_CASE("cues with broken times are left out and a text without captions is refused",
          "[captions]") {
    const Captions captions = captions_in(
        "WEBVTT\n\n00:05.000 --> 00:01.000\nback\n\n5 --> 6\nnone\n\n00:xx.000 --> "
        "00:02.000\nnone\n\n00:01.000 --> 00:02.000\ngood\n",
        "cup.vtt");
    REQUIRE(captions.all.size() == 1);
    CHECK(captions.all.front().text == "good");
    CHECK_THROWS_WITH(captions_in("1\n00:00:01,000 --> 00:00:02,000\nSubRip\n", "cup.vtt"),
                      Contains("cup.vtt") && Contains("WEBVTT"));
    CHECK_THROWS_WITH(captions_in("WEBVTT\n", "cup.vtt"), Contains("holds no caption"));
}

TEST_CASE("captions are found beside the depth by the name of the recording", "[captions]") {
    const TemporaryFolder folder;
    CHECK(read_captions(folder / "cup_depth.mp4") == nullptr);
    CHECK(read_captions({}) == nullptr);
    write_text(folder / "cup.vtt", kTwo);
    const auto captions = read_captions(folder / "cup_depth.mp4");
    REQUIRE(captions);
    CHECK(captions->all.size() == 2);
}
