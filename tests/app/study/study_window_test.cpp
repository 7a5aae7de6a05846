// A participant in front of the study's window: led by keys, by the grip's buttons, interrupted.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/psychophysics/random.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;

namespace {

const std::string kTitle = R"(title = "T"
instructions = "You will feel surfaces."
thanks = "Thank you."
)";

const std::string kConditions = R"(friction = 0.4
[[condition]]
name = "secret-ice"
material = "ice"
[[condition]]
name = "secret-bark"
material = "bark"
algorithm = "pga"
)";

const std::string kHead = kTitle + "[base]\n" + kConditions;

/// Of a picture that stands still, so that two of the window can be compared.
const std::string kStillHead =
    kTitle + "[[media]]\nname = \"still\"\ncolour = \"c.png\"\ndepth = \"d.png\"\n[base]\n" +
    "media = \"still\"\n" + kConditions;

const std::string kPractice = R"([[block]]
name = "practice"
practice = true
form = "two-interval"
conditions = ["secret-ice"]
vary = "friction"
reference = 0.2
levels = [0.5]
question = "Which held you back more?"
instructions = "First for practice."
)";

const std::string kPairs = R"([[block]]
name = "pairs"
form = "two-interval"
pairs = "all"
repetitions = 2
break-after = 1
question = "Which was smoother?"
)";

const std::string kAdjustment = R"([[block]]
name = "adjustment"
form = "adjust"
conditions = ["secret-ice"]
vary = "friction"
reference = 0.3
question = "Turn it until equal"
[block.adjust]
lowest = 0
highest = 0.6
)";

const std::string kOthers = R"([[block]]
name = "rating"
form = "rating"
conditions = ["secret-bark"]
question = "How smooth?"
)" + kAdjustment + R"([[block]]
name = "yes"
form = "explore"
conditions = ["secret-ice"]
view = "blank"
question = "Was it smooth?"
)";

/// A participant on a display of their own.
struct Sitting {
    explicit Sitting(const std::string& page) { write_text(folder / "study.toml", page); }

    [[nodiscard]] std::vector<std::string> words(const std::string& device = "mouse") const {
        return {"study",   "run",      "study.toml", "--participant", "P7",     "--out",
                "answers", "--device", device,       "--mute",        "--size", "1280x800"};
    }
    void press(const std::string& keys) const { desk.act("key " + keys + " sleep 0.35"); }
    /// Does it again and again until the study is finished, or the patience.
    template <typename Act>
    void until_it_ends(Process& program, const Act& act,
                       std::chrono::seconds patience = 150s) const {
        const auto latest = std::chrono::steady_clock::now() + patience;
        while (!program.has_ended() && std::chrono::steady_clock::now() < latest) act();
    }
    [[nodiscard]] StudyRecord record() const { return read_study(study_file()); }
    [[nodiscard]] std::filesystem::path study_file() const {
        return folder / "answers/P7.dibhr-study";
    }
    [[nodiscard]] std::filesystem::path running_session() const {
        return folder / "answers/P7.dibhr-study.trial.dibhr";
    }
    [[nodiscard]] std::string errors() const { return read_text(folder / "errors.txt"); }

    Desk desk{};
    TemporaryFolder folder{};
};

/// "interval 1", "rest", "interval 2", "rest" and so on.
void require_intervals_and_rests(const std::vector<SessionMark>& marks) {
    REQUIRE_FALSE(marks.empty());
    REQUIRE(marks.size() % 2 == 0);
    for (std::size_t k = 0; k < marks.size(); k += 2) {
        CHECK(marks[k].tag.starts_with("interval "));
        CHECK(marks[k + 1].tag == "rest");
    }
    CHECK(marks.front().tag == "interval 1");
}

/// Whether no interval is felt then: a mark is as exact as the thread that puts it is quick.
bool rests_at(const std::vector<SessionMark>& marks, double t_s) {
    constexpr double kExact_s = 0.01;
    bool rests = true;
    for (const SessionMark& mark : marks) {
        if (std::abs(mark.t_s - t_s) < kExact_s) return false;
        if (mark.t_s < t_s) rests = mark.tag == "rest";
    }
    return rests;
}

/// How many values of two pictures differ, of those rows of the display.
std::size_t different(const std::string& first, const std::string& second, std::size_t from_row,
                      std::size_t to_row) {
    REQUIRE(first.size() == 1280 * 800 * 3);
    REQUIRE(second.size() == first.size());
    std::size_t count = 0;
    for (std::size_t k = from_row * 1280 * 3; k < to_row * 1280 * 3; ++k)
        count += std::abs(static_cast<unsigned char>(first[k]) -
                          static_cast<unsigned char>(second[k])) > 2
                     ? 1
                     : 0;
    return count;
}

/// For kStillHead, beside the page.
void make_still(const Sitting& at) {
    run_shell("cd " + at.folder.path().string() +
              " && ffmpeg -nostdin -v error -y -f lavfi -i testsrc=s=320x240:d=1:r=1 -frames:v 1 "
              "c.png && ffmpeg -nostdin -v error -y -f lavfi -i "
              "gradients=s=320x240:d=1:r=1:seed=3:c0=black:c1=white -frames:v 1 -pix_fmt gray "
              "d.png");
}

void find_window(const Sitting& at) {
    at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.5");
}

void leave(const Sitting& at, Process& program) {
    at.press("Escape");
    at.press("l");
    CHECK(program.wait() == 0);
}

/// Each key does something at its own step only, whatever is slow: pages and intervals go on by
/// Enter, as do scales and adjustments; the others are answered by 1.
void touch_and_answer(const Sitting& at) {
    at.desk.act(
        "mousemove 640 420 mousedown 1 sleep 0.2 mousemove_relative 30 10 sleep 0.2 mouseup 1");
    at.press("Return");
    at.press("1");
}

}  // namespace

TEST_CASE("a newcomer is led from the first page to the thanks by keys alone", "[study window]") {
    const Sitting at(kHead + kPractice + kPairs + kOthers);
    Process program = at.desk.start(at.folder, at.words());
    at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.3");
    at.until_it_ends(program, [&] { touch_and_answer(at); });
    INFO(at.errors());
    CHECK(program.wait() == 0);
    CHECK(at.errors().empty());
    const StudyRecord record = at.record();
    CHECK(record.finished);
    CHECK(record.identity.pilot.empty());
    REQUIRE(record.answered.size() == 6);
    CHECK(record.answered[0].trial.practice);
    CHECK(record.answered[1].answer.choice == 0);
    CHECK(record.answered[3].answer.number.value_or(0.0) >= 1.0);
    CHECK(record.answered[4].answer.number.has_value());
    for (const AnsweredTrial& one : record.answered) CHECK(one.answer.reaction_s > 0.0);
    CHECK_FALSE(std::filesystem::exists(at.running_session()));

    REQUIRE(run_dibhr(at.folder, {"study", "sessions", "answers/P7.dibhr-study", "--out", "s"})
                .exit_code == 0);
    CHECK(names_in(at.folder / "s").size() == 6);
    bool touched = false;
    for (const std::string& name : names_in(at.folder / "s")) {
        CAPTURE(name);
        CHECK_FALSE(contains(name, "secret"));
        require_same_bits(at.folder, at.folder / "s" / name);
        const Session session(at.folder / "s" / name);
        REQUIRE_FALSE(session.marks().empty());
        require_intervals_and_rests(session.marks());
        for (const Row& row : read_session(at.folder / "s" / name)) {
            touched = touched || (row.contact && glm::length(row.sent_newton) > 0.05);
            // Nothing is felt before it is to be felt, and after that.
            if (rests_at(session.marks(), row.t_s)) CHECK(glm::length(row.sent_newton) == 0.0);
        }
    }
    CHECK(touched);
}

TEST_CASE("nothing on the display tells one condition from another", "[study window]") {
    const Sitting at(kStillHead + kPairs);
    make_still(at);
    Process program = at.desk.start(at.folder, at.words());
    at.desk.act("search --sync --onlyvisible --name dibhr mousemove 640 731 sleep 0.3");
    at.press("Return");
    std::this_thread::sleep_for(3s);
    const std::string first = at.desk.picture();
    at.press("Return");
    std::this_thread::sleep_for(3s);
    const std::string second = at.desk.picture();
    REQUIRE(first.size() == 1280 * 800 * 3);
    std::size_t bright = 0;
    for (std::size_t k = 120 * 1280 * 3; k < 640 * 1280 * 3; ++k)
        bright += static_cast<unsigned char>(first[k]) > 120 ? 1 : 0;
    CHECK(bright > 10'000);                          // the relief is there
    CHECK(different(first, second, 120, 640) == 0);  // without "1 of 2" and the button
    leave(at, program);
    CHECK(at.record().answered.empty());
}

TEST_CASE("what is seen tells nothing of friction, unless the study wants it", "[study window]") {
    const auto [view, same] =
        GENERATE(table<std::string, bool>({{"relief", true}, {"touch", false}}));
    CAPTURE(view);
    const Sitting at(kTitle + R"([[media]]
name = "still"
colour = "c.png"
depth = "d.png"
[base]
media = "still"
[[condition]]
name = "slippery"
friction = 0
[[condition]]
name = "dull"
friction = 3
[[block]]
form = "two-interval"
pairs = "all"
order = "listed"
question = "Which was smoother?"
)" + "view = \"" + view +
                     "\"\n");
    make_still(at);
    Process program = at.desk.start(at.folder, at.words());
    find_window(at);
    const auto pressed_and_moved = [&] {
        at.press("Return");
        std::this_thread::sleep_for(2s);
        at.desk.act("mousemove 400 420 sleep 0.5 mousedown 1 sleep 0.7");
        for (int k = 0; k < 12; ++k) at.desk.act("mousemove_relative 5 2 sleep 0.05");
        at.desk.act("sleep 1");
        std::string picture = at.desk.picture();
        at.desk.act("mouseup 1");
        return picture;
    };
    const std::string first = pressed_and_moved();
    const std::string second = pressed_and_moved();
    CHECK((different(first, second, 120, 640) == 0) == same);
    leave(at, program);
}

TEST_CASE("a rating that nobody chose is no answer", "[study window]") {
    const auto [scale, chosen] = GENERATE(table<std::string, double>(
        {{"lowest = 0\nhighest = 100", 51.0}, {"lowest = 1\nhighest = 7", 5.0}}));
    CAPTURE(scale);
    const Sitting at(kHead + R"([[block]]
form = "rating"
conditions = ["secret-ice"]
question = "How smooth?"
[block.scale]
)" + scale + "\n");
    Process program = at.desk.start(at.folder, at.words());
    find_window(at);
    at.press("Return");
    std::this_thread::sleep_for(2s);
    for (int k = 0; k < 5; ++k) at.press("Return");        // the interval, and then the question
    CHECK(std::filesystem::exists(at.running_session()));  // nobody has answered
    at.press("Right");                                     // the middle,
    at.press("Right");                                     // and one more
    at.press("Return");
    at.until_it_ends(program, [&] { at.press("Return"); });
    CHECK(program.wait() == 0);
    REQUIRE(at.record().answered.size() == 1);
    CHECK(at.record().answered[0].answer.number == chosen);
}

TEST_CASE("the button of a page is in sight however long the page is", "[study window]") {
    std::string text;
    for (int k = 0; k < 60; ++k) text += "A paragraph that is to be read before it begins.\\n\\n";
    const Sitting at("title = \"T\"\ninstructions = \"" + text + "\"\n[base]\n" + kConditions +
                     kPairs);
    Process program = at.desk.start(at.folder, at.words());
    find_window(at);
    const std::string above = at.desk.picture();
    at.press("Next");
    CHECK(different(above, at.desk.picture(), 0, 800) > 1000);  // it is scrolled
    CHECK_FALSE(std::filesystem::exists(at.running_session()));
    at.desk.act("mousemove 640 743 sleep 0.3 mousedown 1 sleep 0.2 mouseup 1");
    FalconOnUsb::wait_until([&] { return std::filesystem::exists(at.running_session()); });
    leave(at, program);
}

TEST_CASE("what was broken off goes on when its participant says so", "[study window]") {
    const Sitting at(kHead + kPairs);
    {
        Process program = at.desk.start(at.folder, at.words());
        find_window(at);
        at.press("Return");
        FalconOnUsb::wait_until([&] { return std::filesystem::exists(at.running_session()); });
        while (std::filesystem::exists(at.running_session())) touch_and_answer(at);
        program.send(SIGTERM);
        CHECK(program.wait() == 0);
    }
    REQUIRE(at.record().answered.size() == 1);
    Process again = at.desk.start(at.folder, at.words());
    find_window(at);
    std::this_thread::sleep_for(3s);
    CHECK_FALSE(std::filesystem::exists(at.running_session()));
    at.press("Return");
    FalconOnUsb::wait_until([&] { return std::filesystem::exists(at.running_session()); });
    leave(at, again);
}

TEST_CASE("trials are felt and answered with the Falcon alone", "[study window]") {
    const Sitting at(kHead + kPairs + kAdjustment);
    write_firmware(at.folder / "firmware.bin");
    const FalconOnUsb falcon(at.folder.path(), {"firmware", "home", "place 0 0 140"});
    std::vector<std::string> words = at.words("falcon");
    words.insert(words.end(), {"--firmware", "firmware.bin"});
    Process program = at.desk.start(at.folder, words, falcon.host());
    at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.5");
    falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    bool pushed = false;
    at.until_it_ends(program, [&] {
        // Goes on; at a question the first, or the second.
        for (const char* const bit : {"1", "0", "2", "0"}) {
            if (!falcon.try_to_tell(std::string("press ") + bit)) return;
            std::this_thread::sleep_for(200ms);
        }
        // At an adjustment: the other one, and, held, equal.
        for (const auto& [bit, held] :
             {std::pair{"4", 200ms}, {"0", 1500ms}, {"4", 1300ms}, {"0", 0ms}}) {
            if (!falcon.try_to_tell(std::string("press ") + bit)) return;
            std::this_thread::sleep_for(held);
            pushed = pushed || falcon.vector("motor_newton").z > 0.5;
        }
    });
    INFO(at.errors());
    CHECK(program.wait() == 0);
    CHECK(pushed);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 3);
    CHECK(record.answered[0].answer.choice >= 0);
    CHECK(record.answered[1].answer.choice >= 0);
    CHECK(record.answered[2].answer.number.has_value());
    REQUIRE(run_dibhr(at.folder, {"study", "sessions", "answers/P7.dibhr-study", "--out", "s"})
                .exit_code == 0);
    require_same_bits(at.folder, at.folder / "s/P7-001.dibhr");
}

TEST_CASE("where time is short a trial goes on by itself, and nobody has answered it",
          "[study window]") {
    const Sitting at(kHead + R"([[block]]
name = "quick"
form = "two-interval"
conditions = ["secret-ice"]
vary = "friction"
reference = 0.2
levels = [0.5]
feedback = true
interval-s = 0.5
answer-s = 0.7
question = "Which was smoother?"
)");
    Process program = at.desk.start(at.folder, at.words());
    at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.5");
    // Pages go on by Enter; nothing that is pressed answers a question.
    at.until_it_ends(program, [&] { at.press("Return"); });
    CHECK(program.wait() == 0);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 1);
    CHECK(record.answered[0].answer.choice == -1);
    CHECK(record.answered[0].right == false);
}

TEST_CASE("a study that is killed at any moment goes on at that trial, no answer lost or doubled",
          "[study window]") {
    const char* const asked = std::getenv("DIBHR_STUDY_KILLS");  // 50 is the long form
    const int kills = asked == nullptr ? 1 : std::atoi(asked);
    const Sitting at(kHead + R"([[block]]
name = "pairs"
form = "two-interval"
pairs = "all"
repetitions = )" + std::to_string(2 * kills) +
                     "\nquestion = \"Which was smoother?\"\n");
    Random dice(7);
    std::vector<AnsweredTrial> before;
    for (int kill = 0; kill < kills; ++kill) {
        Process program = at.desk.start(at.folder, at.words());
        at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.5");
        at.press("Return");
        if (kill == 0)  // the first time while something is felt
            FalconOnUsb::wait_until([&] { return std::filesystem::exists(at.running_session()); });
        const auto moment = std::chrono::steady_clock::now() +
                            std::chrono::duration<double>(1.0 + 5.0 * dice.uniform());
        while (kill > 0 && std::chrono::steady_clock::now() < moment) touch_and_answer(at);
        std::this_thread::sleep_until(moment);
        program.send(SIGKILL);
        CHECK(program.wait() == 128 + SIGKILL);
        const std::vector<AnsweredTrial> now = at.record().answered;
        REQUIRE(now.size() >= before.size());
        for (std::size_t k = 0; k < before.size(); ++k) CHECK(now[k].answer == before[k].answer);
        before = now;
    }
    Process again = at.desk.start(at.folder, at.words());
    at.desk.act("search --sync --onlyvisible --name dibhr sleep 0.5");
    at.until_it_ends(
        again, [&] { touch_and_answer(at); }, 150s + kills * 10s);
    CHECK(again.wait() == 0);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    CHECK(record.answered.size() == 2 * static_cast<std::size_t>(kills));
    CHECK_FALSE(std::filesystem::exists(at.running_session()));
}
