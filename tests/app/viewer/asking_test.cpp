// The question which meaning of the depth is right, and near and far turned by a key.
#include "app/viewer/asking.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "core/files/names.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

DepthAlternative alternative(NearLevels near, DepthUnit unit, double scale = 1.0,
                             DepthRange range = {}) {
    return {.statement = {.near = near, .unit = unit, .scale = scale}, .range = range};
}

constexpr NearLevels kBright = NearLevels::bright;
constexpr NearLevels kDark = NearLevels::dark;

/// Two recordings of which nobody can say whether they show a corridor or a thing: 16-bit levels,
/// bright in the middle.
struct OpenFiles {
    TemporaryFolder folder{};

    OpenFiles() {
        const std::string still = "ffmpeg -nostdin -v error -f lavfi -i nullsrc=s=64x48,";
        for (const char* const name : {"first", "second"}) {
            run_shell(folder, still +
                                  "format=gray16le,geq=lum='58000-1000*max(abs(X-32)\\,abs(Y-24))' "
                                  "-frames:v 1 -pix_fmt gray16be " +
                                  std::string(name) + "_depth.png");
            run_shell(folder, still + "geq=r='4*X':g=128:b='5*Y' -frames:v 1 -pix_fmt rgb24 " +
                                  std::string(name) + "_color.png");
        }
    }
    [[nodiscard]] fs::path choices() const { return folder / "config/dibhr/depth"; }
    [[nodiscard]] DepthRequest request() const { return {.find_out = true, .kept_in = choices()}; }
    [[nodiscard]] fs::path depth(const std::string& name) const {
        return folder / (name + "_depth.png");
    }
    [[nodiscard]] MediaDescription opened(const std::string& name) const {
        return open_depth(depth(name), request())->description();
    }
    [[nodiscard]] WindowProgram view(const Desk& desk, const std::string& name,
                                     std::vector<std::string> more = {}) const {
        std::vector<std::string> words{
            name + "_color.png", name + "_depth.png", "--device", "mouse", "--size", "1280x720"};
        words.insert(words.end(), more.begin(), more.end());
        return desk.start_viewer(folder, words);
    }
};

/// The place of the likeliest answer by which the other end is near.
std::size_t other_end_of(const std::vector<DepthAlternative>& answers) {
    REQUIRE(answers.size() >= 2);
    std::size_t other = 1;
    while (other < answers.size() && answers[other].statement.near == answers[0].statement.near)
        ++other;
    REQUIRE(other < answers.size());
    return other;
}

bool is_asked(const Seen& seen) {
    return seen.depth_answers > 0 && seen.depth_reliefs == seen.depth_answers;
}

void wait_until_asked(const WindowProgram& viewer) {
    viewer.wait_until(is_asked);
}

/// Until the file is open by another statement than before.
void wait_until_opened_again(const WindowProgram& viewer, std::uint32_t media) {
    viewer.wait_until([media](const Seen& now) {
        return now.drawn_media != media && !now.opening && now.touchable;
    });
}

void quit(const Desk& desk, WindowProgram& viewer) {
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
}

}  // namespace

TEST_CASE("a few words tell the answers apart, with sizes where they are distances", "[asking]") {
    using Labels = std::vector<std::string>;
    const auto bright = alternative(kBright, DepthUnit::levels);
    const auto dark = alternative(kDark, DepthUnit::levels);
    const auto mm = alternative(kDark, DepthUnit::mm, 1.0, {400.0, 3140.0});
    CHECK(labels_of({bright, dark}) == Labels{"Near is bright", "Near is dark"});
    CHECK(labels_of({bright, alternative(kBright, DepthUnit::disparity)}) ==
          Labels{"Near is bright, in equal steps", "Near is bright, as 1 / distance"});
    CHECK(labels_of({mm, dark}) ==
          Labels{"Millimetres, 0.4 to 3.1 m", "Near is dark, size not known"});
    CHECK(labels_of({mm, alternative(kDark, DepthUnit::m, 1.0 / 256.0, {1.5, 12.0}),
                     alternative(kDark, DepthUnit::mm, 0.2, {12.0, 61.0}),
                     alternative(kDark, DepthUnit::m, 1.0, {1.0, 120.0})}) ==
          Labels{"Millimetres, 0.4 to 3.1 m", "Steps of 3.91 mm, 1.5 to 12 m",
                 "Steps of 0.2 mm, 12 to 61 mm", "Metres, 1 to 120 m"});
}

TEST_CASE("a file is asked about where its meaning is not sure, with its folder", "[asking]") {
    const OpenFiles files;
    const MediaDescription media = files.opened("first");
    const auto question = question_on(media);
    REQUIRE(question);
    CHECK(question->alternatives.size() >= 2);
    CHECK(question->alternatives.size() <= 4);
    CHECK(question->folder == shown(files.folder.path().filename()));
    CHECK(question->alternatives.front().range == media.meaning->range.value);
    keep_choice(files.choices(), files.depth("first"), {.near = kDark});
    CHECK_FALSE(question_on(files.opened("first")));
    write_sidecar(files.depth("second"), {.unit = DepthUnit::mm});
    CHECK_FALSE(question_on(files.opened("second")));
}

TEST_CASE("the depth by another meaning is what opening the file by it gives", "[asking]") {
    const OpenFiles files;
    const MediaDescription media = files.opened("first");
    const auto frame_by = [&](const DepthStatement& panel) {
        DepthRequest request = files.request();
        request.panel = panel;
        Frame frame;
        frame.depth = std::make_shared<const DepthImage>(
            open_depth(files.depth("first"), request)->next()->depth);
        return frame;
    };
    const Frame now = frame_by({});
    for (const DepthAlternative& other : media.conclusion.alternatives) {
        DepthMeaning meaning = *media.meaning;
        DepthStatement whole = other.statement;
        whole.range = other.range;
        merge_by_priority({{Origin::panel, whole}}, meaning);
        const DepthImage seen = depth_by(now, *media.meaning, meaning);
        const DepthImage wanted = *frame_by(other.statement).depth;
        REQUIRE(seen.levels.size() == wanted.levels.size());
        for (std::size_t k = 0; k < seen.levels.size(); ++k)
            CHECK_THAT(
                static_cast<double>(seen.levels[k]) / seen.highest_level,
                WithinAbs(static_cast<double>(wanted.levels[k]) / wanted.highest_level, 0.02));
    }
}

TEST_CASE("an empty beginning is not what the question shows: a frame with a thing in it is",
          "[asking]") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -nostdin -v error -f lavfi -i color=gray:s=64x48:r=10:d=2 -vf "
              "\"drawbox=x=16:y=12:w=32:h=24:color=white:t=fill:enable='gte(t,1)'\" "
              "-c:v ffv1 depth.mkv");
    const DepthRequest request{.find_out = true};
    const auto media = open_media({}, folder / "depth.mkv", request);
    Frame empty;
    empty.depth = std::make_shared<const DepthImage>(media->next()->depth);
    const auto telling = telling_frame(media->description(), request);
    REQUIRE(telling);
    CHECK(spread_of(*telling) > spread_of(empty) + 0.1);
    CHECK_FALSE(telling_frame({.still = true}, request));
}

TEST_CASE("a key answers which depth is right: no force before, and nobody asks again",
          "[asking]") {
    const Desk desk;
    const OpenFiles files;
    const std::vector<DepthAlternative> answers = files.opened("first").conclusion.alternatives;
    const std::size_t other = other_end_of(answers);
    double middle = 0.0;
    {
        WindowProgram viewer = files.view(desk, "first");
        viewer.wait_for_surface();
        wait_until_asked(viewer);
        CHECK(viewer.seen().depth_answers == answers.size());
        middle = viewer.seen().drawn_middle;
        CHECK((middle > 0.5) == (answers[0].statement.near == kBright));
        viewer.act("mousemove 470 120 mousedown 1");
        wait_for_ticks(viewer, kTicksToRest);
        CHECK(viewer.seen().sent_newton == 0.0);
        viewer.act("mouseup 1 key x key space key 9");  // they are no answers
        CHECK(is_asked(viewer.seen()));
        const std::uint32_t media = viewer.seen().drawn_media;
        viewer.act("key " + std::to_string(other + 1));
        wait_until_opened_again(viewer, media);
        CHECK(viewer.seen().depth_answers == 0);
        CHECK_THAT(viewer.seen().drawn_middle, WithinAbs(1.0 - middle, 0.1));
        quit(desk, viewer);
    }
    CHECK(files.opened("first").panel == answers[other].statement);
    CHECK(question_on(files.opened("second")));
    WindowProgram viewer = files.view(desk, "first");
    viewer.wait_for_surface();
    CHECK(viewer.seen().depth_answers == 0);
    CHECK_THAT(viewer.seen().drawn_middle, WithinAbs(1.0 - middle, 0.1));
    quit(desk, viewer);
}

TEST_CASE("an answer can hold for the other files of the folder", "[asking]") {
    const Desk desk;
    const OpenFiles files;
    {
        WindowProgram viewer = files.view(desk, "first");
        viewer.wait_for_surface();
        wait_until_asked(viewer);
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
    }
    {
        WindowProgram viewer = files.view(desk, "first");
        viewer.wait_for_surface();
        wait_until_asked(viewer);
        viewer.act("key 0");
        CHECK(viewer.seen().depth_for_folder);
        const std::uint32_t media = viewer.seen().drawn_media;
        viewer.act("key 2");
        wait_until_opened_again(viewer, media);
        quit(desk, viewer);
    }
    const MediaDescription second = files.opened("second");
    CHECK(second.meaning->near.origin == Origin::folder);
    CHECK(second.meaning->near.value == files.opened("first").meaning->near.value);
    WindowProgram viewer = files.view(desk, "second");
    viewer.wait_for_surface();
    CHECK(viewer.seen().depth_answers == 0);
    quit(desk, viewer);
}

TEST_CASE("Escape goes on with the likelier depth and keeps nothing, and a key turns it",
          "[asking]") {
    const Desk desk;
    const OpenFiles files;
    WindowProgram viewer = files.view(desk, "first");
    viewer.wait_for_surface();
    wait_until_asked(viewer);
    const double middle = viewer.seen().drawn_middle;
    viewer.act("key Escape");
    CHECK(viewer.seen().depth_answers == 0);
    CHECK(contains(viewer.seen().notice.str(), "X turns near and far"));
    CHECK_FALSE(fs::exists(files.choices()));
    std::uint32_t media = viewer.seen().drawn_media;
    viewer.act("key x");
    wait_until_opened_again(viewer, media);
    CHECK_THAT(viewer.seen().drawn_middle, WithinAbs(1.0 - middle, 0.01));
    CHECK(eventually([&] { return files.opened("first").panel.near.has_value(); }));
    media = viewer.seen().drawn_media;
    viewer.act("key x");
    wait_until_opened_again(viewer, media);
    CHECK_THAT(viewer.seen().drawn_middle, WithinAbs(middle, 0.01));
    CHECK(eventually([&] { return files.opened("first").panel == DepthStatement{}; }));
    quit(desk, viewer);
}

TEST_CASE("a key turns near and far against the command line, too", "[asking]") {
    const Desk desk;
    const OpenFiles files;
    WindowProgram viewer = files.view(desk, "first", {"--near", "dark", "--depth-unit", "mm"});
    viewer.wait_for_surface();
    CHECK(viewer.seen().depth_answers == 0);
    const double middle = viewer.seen().drawn_middle;
    const std::uint32_t media = viewer.seen().drawn_media;
    viewer.act("key x");
    wait_until_opened_again(viewer, media);
    CHECK_THAT(viewer.seen().drawn_middle, WithinAbs(1.0 - middle, 0.01));
    quit(desk, viewer);
}

TEST_CASE("a window that fills the screen asks no visitor: stderr says what is assumed",
          "[asking]") {
    const Desk desk;
    const OpenFiles files;
    WindowProgram viewer = files.view(desk, "first", {"--full-screen"});
    viewer.wait_for_surface();
    CHECK(viewer.seen().depth_answers == 0);
    quit(desk, viewer);
    CHECK(contains(read_text(files.folder / "errors.txt"), "% sure): look at it"));
}
