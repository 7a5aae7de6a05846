// A participant in front of the study's window: by keys, by device buttons, with interruptions.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/psychophysics/random.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "core/study/study_run.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/app/program/stand_in_arm.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kDisplayColumns = 1280;
constexpr int kDisplayRows = 800;

/// A film, and a still picture, for which two pictures of the window can be compared. Made once.
const std::filesystem::path& media_folder() {
    static const TemporaryFolder folder;
    static const bool made = [] {
        run_shell(folder,
                  "ffmpeg -v error -f lavfi -i testsrc=s=64x48:d=1:r=10 -c:v ffv1 c.mkv && "
                  "ffmpeg -v error -f lavfi -i gradients=s=64x48:d=1:r=10:seed=3:c0=black:c1=white "
                  "-pix_fmt gray -c:v ffv1 d.mkv && "
                  "ffmpeg -v error -i c.mkv -frames:v 1 c.png && "
                  "ffmpeg -v error -i d.mkv -frames:v 1 d.png");
        return true;
    }();
    static_cast<void>(made);
    return folder.path();
}

/// `kind`: extension of the files, "mkv" or "png".
std::string media(const std::string& kind) {
    const std::string folder = media_folder().string();
    return "[[media]]\nname = \"own\"\ncolour = \"" + folder + "/c." + kind + "\"\ndepth = \"" +
           folder + "/d." + kind + "\"\n";
}

const std::string kTitle = R"(title = "T"
instructions = "You will feel surfaces."
thanks = "Thank you."
)";

const std::string kOwnMedia = R"([base]
media = "own"
relief = 40
)";

const std::string kBase = kOwnMedia + R"(friction = 0.4
[[condition]]
name = "secret-ice"
material = "ice"
[[condition]]
name = "secret-bark"
material = "bark"
algorithm = "pga"
)";

std::string head() {
    return kTitle + media("mkv") + kBase;
}

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
question = "Which was smoother?"
)";

const std::string kRatings = R"([[block]]
name = "rating"
form = "rating"
question = "How smooth?"
break-after = 1
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

const std::string kBlank = R"([[block]]
name = "yes"
form = "explore"
conditions = ["secret-ice"]
view = "blank"
question = "Was it smooth?"
)";

double now_s() {
    using Clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// A study, and a display for its participant.
struct Sitting {
    explicit Sitting(const std::string& page) { write_text(folder / "study.toml", page); }

    [[nodiscard]] StudyRecord record() const {
        return read_study(folder / "answers/P7.dibhr-study");
    }
    [[nodiscard]] std::filesystem::path running_session() const {
        return folder / "answers/P7.dibhr-study.trial.dibhr";
    }
    [[nodiscard]] std::string errors() const { return read_text(folder / "errors.txt"); }

    Desk desk{};
    TemporaryFolder folder{};
};

/// The participant, in front of the program from its start on.
class Participant {
  public:
    explicit Participant(const Sitting& at) : Participant(at, {"--device", "mouse"}, {}) {}
    Participant(const Sitting& at, const std::vector<std::string>& device,
                const std::vector<std::string>& host)
        : at_(at), program_(at.desk.start(at.folder, words(device), host)) {}

    /// Waits for the condition. Presses after this call count.
    void wait_until(const std::function<bool(const Seen&)>& is_so) const {
        program_.wait_until(is_so);
        wait_until_asked();
    }
    /// X's times are whole milliseconds: a key in the millisecond of the first picture is early.
    void wait_until_asked() const {
        constexpr double kStamp_s = 0.001;
        program_.wait_until(
            [](const Seen& now) { return now.asked_s > 0.0 && now_s() > now.asked_s + kStamp_s; });
    }
    void wait_for(StudyStep step) const {
        wait_until([step](const Seen& now) { return is_at(now, step) && !now.waits; });
    }
    /// Waits until the interval is felt; trials and intervals are counted from 0.
    void wait_for_interval(int trial, int interval) const {
        wait_until([=](const Seen& now) {
            return now.trial == trial && now.interval == interval && now.force_enabled;
        });
    }
    void press(const std::string& keys) const { program_.act("key " + keys); }
    void act(const std::string& events) const { program_.act(events); }
    /// Leaves the step by Enter.
    void leave(StudyStep step) const {
        wait_for(step);
        press("Return");
    }
    void touch_interval(int trial, int interval) const {
        wait_for_interval(trial, interval);
        act("mousemove 320 240 mousedown 1");
        program_.wait_until([](const Seen& now) { return now.contact && now.sent_newton > 0.05; });
        act("mousemove_relative 30 10 mouseup 1");
    }
    /// Answers a trial by keys, from its first interval on.
    void answer_pair(int trial, const std::string& key) const {
        for (const int interval : {0, 1}) {
            wait_for_interval(trial, interval);
            press("Return");
        }
        wait_for(StudyStep::question);
        press(key);
    }
    /// Leaves the last page.
    [[nodiscard]] int close() {
        wait_for(StudyStep::thanks);
        at_.desk.press("key Return");
        return program_.wait();
    }
    [[nodiscard]] int leave_early() {
        press("Escape");
        wait_until_asked();
        at_.desk.press("key l");
        return program_.wait();
    }
    [[nodiscard]] int ended_by(int signal) {
        program_.send(signal);
        return end();
    }
    /// Waits for the end; returns the exit code.
    [[nodiscard]] int end() { return program_.wait(); }
    /// One press that continues, whatever is shown.
    void go_on() const { press(is_at(program_.seen(), StudyStep::question) ? "1" : "Return"); }
    /// A picture of the display, once it does not change.
    [[nodiscard]] std::string picture() const {
        std::string last;
        std::string now = at_.desk.picture();
        while (now != last) {
            program_.wait_for_turn();
            last = std::move(now);
            now = at_.desk.picture();
        }
        return now;
    }
    [[nodiscard]] Seen seen() const { return program_.seen(); }
    /// Stops the window soon after a picture in which the condition holds.
    void hang_window_when(const std::function<bool(const Seen&)>& is_so) const {
        program_.wait_until(is_so);
        program_.hang();
    }
    void resume_window() const { program_.go_on(); }

    static bool is_at(const Seen& now, StudyStep step) {
        return now.study && now.study_step == static_cast<int>(step);
    }

  private:
    [[nodiscard]] static std::vector<std::string> words(const std::vector<std::string>& device) {
        std::vector<std::string> all{"study", "run",     "study.toml", "--participant", "P7",
                                     "--out", "answers", "--mute",     "--size",        "640x480"};
        all.insert(all.end(), device.begin(), device.end());
        return all;
    }

    const Sitting& at_;
    WindowProgram program_;
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

/// Whether no interval is felt at that time.
bool rests_at(const std::vector<SessionMark>& marks, double t_s) {
    bool rests = true;
    for (const SessionMark& mark : marks)
        if (mark.t_s < t_s) rests = mark.tag == "rest";
    return rests;
}

/// Whether any force was felt; fails the test where one was before its interval or after it.
bool check_felt_in_intervals_only(const Session& session, const std::vector<Row>& rows) {
    bool touched = false;
    std::size_t beside = 0;
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        const bool felt = glm::length(rows[k].sent_newton) > 0.0;
        touched = touched || (rows[k].contact && glm::length(rows[k].sent_newton) > 0.05);
        // A tick that began before the mark of its interval may already have force.
        const bool rests =
            rests_at(session.marks(), rows[k].t_s) && rests_at(session.marks(), rows[k + 1].t_s);
        beside += felt && rests ? 1 : 0;
    }
    CHECK(beside == 0);
    return touched;
}

void check_same_bits(const Sitting& at, const std::string& session) {
    const ProgramResult result = run_dibhr(at.folder, {"replay", "s/" + session});
    INFO(result.errors);
    CHECK(contains(result.output, "identical, bit for bit"));
}

/// A key that was struck between two times.
struct Struck {
    char key{'1'};
    double after_s{0.0}, before_s{0.0};  // by the steady clock
};

/// Strikes random keys, among them Return, until the last question was answered.
class Hammer {
  public:
    Hammer(const Sitting& at, const Participant& person) : at_(at), person_(person) {}

    void strike_until_over() {
        using enum StudyStep;
        for (Seen now = person_.seen(); !Participant::is_at(now, thanks); now = look()) {
            const double which = dice_.uniform();
            if (which < 0.15)
                at_.desk.press("key Return");
            else
                strike(which < 0.6 ? '1' : '2');
        }
    }
    [[nodiscard]] const std::vector<Struck>& struck() const { return struck_; }
    /// For each trial: when its question was on the screen.
    [[nodiscard]] const std::map<int, double>& asked_s() const { return asked_s_; }

  private:
    void strike(char key) {
        const double after_s = now_s();
        at_.desk.press(std::string("keydown ") + key);
        struck_.push_back({key, after_s, now_s()});
        at_.desk.press(std::string("keyup ") + key);
    }
    /// Waits a random time; GLFW drops a key that comes twice in a millisecond.
    Seen look() {
        constexpr double kShortest_s = 0.003;
        constexpr double kLongest_s = 0.03;
        const double until_s = now_s() + kShortest_s + dice_.uniform() * kLongest_s;
        Seen now = person_.seen();
        while (now_s() < until_s) now = person_.seen();
        if (now.question_trial >= 0) asked_s_[now.question_trial] = now.question_seen_s;
        return now;
    }

    const Sitting& at_;
    const Participant& person_;
    Random dice_{11};
    std::vector<Struck> struck_{};
    std::map<int, double> asked_s_{};
};

/// The answer is the first key that was struck since the question was on the screen, and its
/// reaction is as long as that took; fails the test where it is not.
void check_first_since(const AnsweredTrial& one, double asked_s, const std::vector<Struck>& all) {
    constexpr double kNear_s = 0.002;
    CAPTURE(one.trial.number, one.answer.reaction_s, one.answer.choice);
    CHECK(one.answer.reaction_s >= 0.0);
    const double answered_s = asked_s + one.answer.reaction_s;
    const auto by = std::find_if(all.begin(), all.end(), [&](const Struck& struck) {
        return struck.after_s - kNear_s <= answered_s && answered_s <= struck.before_s + kNear_s;
    });
    REQUIRE(by != all.end());
    CHECK(by->key - '1' == one.answer.choice);
    const auto missed = std::find_if(
        all.begin(), by, [&](const Struck& struck) { return struck.after_s > asked_s + kNear_s; });
    CHECK(missed == by);
}

/// How many values of two pictures of the display differ between two rows.
std::size_t different(const std::string& first, const std::string& second, std::size_t from_row,
                      std::size_t to_row) {
    REQUIRE(first.size() == kDisplayColumns * kDisplayRows * 3);
    REQUIRE(second.size() == first.size());
    std::size_t count = 0;
    for (std::size_t k = from_row * kDisplayColumns * 3; k < to_row * kDisplayColumns * 3; ++k)
        count += std::abs(static_cast<unsigned char>(first[k]) -
                          static_cast<unsigned char>(second[k])) > 2
                     ? 1
                     : 0;
    return count;
}

// Of the window, without "1 of 2" above and the button below.
constexpr std::size_t kReliefFrom = 80;
constexpr std::size_t kReliefTo = 390;

bool same_relief(const std::string& first, const std::string& second) {
    return different(first, second, kReliefFrom, kReliefTo) == 0;
}

std::size_t bright_values(const std::string& picture) {
    std::size_t bright = 0;
    for (std::size_t k = kReliefFrom * kDisplayColumns * 3; k < kReliefTo * kDisplayColumns * 3;
         ++k)
        bright += static_cast<unsigned char>(picture[k]) > 120 ? 1 : 0;
    return bright;
}

/// A study whose second trial a signal ends, after one that was killed in its first.
void check_going_on(int signal, int exit_code) {
    const Sitting at(head() + kPairs + "repetitions = 2\n");
    {
        Participant person(at);
        person.leave(StudyStep::instructions);
        person.wait_for_interval(0, 0);
        CHECK(person.ended_by(SIGKILL) == 128 + SIGKILL);
    }
    CHECK(at.record().answered.empty());
    {
        Participant person(at);
        person.leave(StudyStep::instructions);
        person.answer_pair(0, "1");
        person.wait_for_interval(1, 0);
        person.press("Return");
        person.wait_for_interval(1, 1);
        CHECK(person.ended_by(signal) == exit_code);
    }
    const std::vector<AnsweredTrial> before = at.record().answered;
    REQUIRE(before.size() == 1);
    Participant person(at);
    person.wait_until(
        [](const Seen& now) { return Participant::is_at(now, StudyStep::interval) && !now.waits; });
    CHECK_FALSE(person.seen().force_enabled);
    CHECK_FALSE(person.seen().surface);
    person.press("Return");
    person.answer_pair(1, "2");
    CHECK(person.close() == 0);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 2);
    CHECK(record.answered[0].answer == before[0].answer);
    CHECK(record.answered[1].answer.choice == 1);
    CHECK_FALSE(std::filesystem::exists(at.running_session()));
}

}  // namespace

TEST_CASE("a newcomer is led from the first page to the thanks by keys alone", "[study window]") {
    using enum StudyStep;
    const Sitting at(head() + kPractice + kRatings + kAdjustment + kBlank);
    Participant person(at);
    person.leave(instructions);
    person.leave(block_instructions);
    for (const int number : {0, 1}) {
        person.touch_interval(0, number);
        person.press("Return");
    }
    person.leave(question);  // tries to leave
    CHECK(Participant::is_at(person.seen(), question));
    person.press("1");
    person.leave(feedback);
    for (const int trial : {1, 2}) {
        person.touch_interval(trial, 0);
        person.press("Return");
        person.wait_for(question);
        person.press("Right");
        person.press("Return");
        if (trial == 1) person.leave(pause);
    }
    person.touch_interval(3, 0);
    person.press("Return");
    person.touch_interval(3, 1);
    person.press("Tab");
    person.wait_for_interval(3, 0);
    person.press("Return");  // equal
    person.touch_interval(4, 0);
    person.press("Return");
    person.wait_for(question);
    person.press("1");
    CHECK(person.close() == 0);

    CHECK(at.errors().empty());
    const StudyRecord record = at.record();
    CHECK(record.finished);
    CHECK(record.identity.pilot.empty());
    REQUIRE(record.answered.size() == 5);
    CHECK(record.answered[0].trial.practice);
    CHECK(record.answered[0].answer.choice == 0);
    CHECK(record.answered[1].answer.number.value_or(0.0) >= 1.0);
    CHECK(record.answered[3].answer.number.has_value());
    for (const AnsweredTrial& one : record.answered) CHECK(one.answer.reaction_s > 0.0);
    CHECK_FALSE(std::filesystem::exists(at.running_session()));

    REQUIRE(run_dibhr(at.folder, {"study", "sessions", "answers/P7.dibhr-study", "--out", "s"})
                .exit_code == 0);
    const std::vector<std::string> sessions = names_in(at.folder / "s");
    CHECK(sessions.size() == 5);
    for (const std::string& name : sessions) {
        CAPTURE(name);
        CHECK_FALSE(contains(name, "secret"));
        check_same_bits(at, name);
        const Session session(at.folder / "s" / name);
        require_intervals_and_rests(session.marks());
        CHECK(check_felt_in_intervals_only(session, read_session(at.folder / "s" / name)));
    }
}

TEST_CASE("what is seen tells nothing of a condition, unless the study wants it",
          "[study window]") {
    const std::string pairs = R"([[block]]
form = "two-interval"
pairs = "all"
order = "listed"
question = "Which was smoother?"
)";
    const Sitting at(kTitle + media("png") + kOwnMedia + R"([[condition]]
name = "slippery"
friction = 0
[[condition]]
name = "dull"
material = "bark"
algorithm = "pga"
friction = 3
)" + pairs + "view = \"relief\"\n" +
                     pairs + "view = \"touch\"\n");
    Participant person(at);
    struct Pictures {
        std::string before{}, touched{};
    };
    const auto felt = [&](int trial, int interval) {
        person.wait_for_interval(trial, interval);
        person.act("mousemove 900 600");  // beside the window
        Pictures pictures{.before = person.picture()};
        person.act("mousemove 200 240 mousedown 1");
        person.wait_until([](const Seen& now) { return now.contact; });
        for (int k = 0; k < 6; ++k) person.act("mousemove_relative 10 4");
        pictures.touched = person.picture();
        person.act("mouseup 1 key Return");
        return pictures;
    };
    person.leave(StudyStep::instructions);
    const Pictures slippery = felt(0, 0);
    const Pictures dull = felt(0, 1);
    CHECK(bright_values(slippery.before) > 10'000);  // the relief is there
    CHECK(same_relief(slippery.before, dull.before));
    CHECK_FALSE(same_relief(slippery.before, slippery.touched));  // the hand is seen
    CHECK(same_relief(slippery.touched, dull.touched));
    person.wait_for(StudyStep::question);
    person.press("1");
    const Pictures sliding = felt(1, 0);
    const Pictures sticking = felt(1, 1);
    CHECK_FALSE(same_relief(sliding.touched, sticking.touched));
    CHECK(person.leave_early() == 0);
    CHECK(at.record().answered.size() == 1);
}

TEST_CASE("a rating that nobody chose is no answer", "[study window]") {
    const auto block = [](const std::string& scale) {
        return "[[block]]\nform = \"rating\"\nconditions = [\"secret-ice\"]\nquestion = \"Q\"\n"
               "[block.scale]\n" +
               scale + '\n';
    };
    const Sitting at(head() + block("lowest = 0\nhighest = 100") +
                     block("lowest = 1\nhighest = 7"));
    Participant person(at);
    person.leave(StudyStep::instructions);
    for (const int trial : {0, 1}) {
        person.wait_for_interval(trial, 0);
        person.press("Return");
        person.wait_for(StudyStep::question);
        for (int k = 0; k < 3; ++k) person.press("Return");
        CHECK(Participant::is_at(person.seen(), StudyStep::question));
        CHECK(std::filesystem::exists(at.running_session()));  // nobody has answered
        person.press("Right");                                 // the middle,
        person.press("Right");                                 // and one more
        person.press("Return");
    }
    CHECK(person.close() == 0);
    const StudyRecord record = at.record();
    REQUIRE(record.answered.size() == 2);
    CHECK(record.answered[0].answer.number == 51.0);
    CHECK(record.answered[1].answer.number == 5.0);
}

TEST_CASE("the button of a page is in sight however long the page is", "[study window]") {
    std::string text;
    for (int k = 0; k < 60; ++k)
        text += "Paragraph " + std::to_string(k) + ", to be read before it begins.\\n\\n";
    const Sitting at("title = \"T\"\ninstructions = \"" + text + "\"\n" + media("mkv") + kBase +
                     kPairs);
    Participant person(at);
    person.wait_for(StudyStep::instructions);
    const std::string above = person.picture();
    person.press("Next");
    CHECK(different(above, person.picture(), 0, kDisplayRows) > 1000);  // it is scrolled
    CHECK(Participant::is_at(person.seen(), StudyStep::instructions));
    person.act("mousemove 320 423 click 1");
    person.wait_for_interval(0, 0);
    CHECK(person.leave_early() == 0);
    CHECK(at.record().answered.empty());
}

TEST_CASE("where time is short a trial goes on by itself, and nobody has answered it",
          "[study window]") {
    const Sitting at(head() + R"([[block]]
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
    Participant person(at);
    person.leave(StudyStep::instructions);
    person.leave(StudyStep::feedback);
    CHECK(person.close() == 0);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 1);
    CHECK(record.answered[0].answer.choice == -1);
    CHECK(record.answered[0].right == false);
}

TEST_CASE("of keys that are hammered none answers before its question is on the screen",
          "[study window]") {
    constexpr std::size_t kTrials = 4;
    const Sitting at(head() + kBlank + "repetitions = " + std::to_string(kTrials) + "\n");
    Participant person(at);
    person.leave(StudyStep::instructions);
    Hammer hammer(at, person);
    hammer.strike_until_over();
    CHECK(person.close() == 0);
    const std::vector<AnsweredTrial> answered = at.record().answered;
    REQUIRE(answered.size() == kTrials);
    REQUIRE(hammer.asked_s().size() == kTrials);
    std::size_t used = 0;
    for (const AnsweredTrial& one : answered) {
        check_first_since(one, hammer.asked_s().at(one.trial.number), hammer.struck());
        used += 1 + static_cast<std::size_t>(one.answer.early.value());
    }
    // Keys after the last answer have no question.
    const double last_s = hammer.asked_s().at(kTrials - 1) + answered.back().answer.reaction_s;
    const auto counts = [&](double margin_s) {
        return static_cast<std::size_t>(std::count_if(
            hammer.struck().begin(), hammer.struck().end(),
            [&](const Struck& struck) { return struck.after_s <= last_s + margin_s; }));
    };
    CHECK(used >= counts(-0.002));
    CHECK(used <= counts(0.002));
}

TEST_CASE("a study that has stability off begins when whoever leads it agrees, once",
          "[study window]") {
    const Sitting at(kTitle + media("png") + kBase + "stability = false\n" + kPairs);
    const std::vector<std::string> device{"--device", "auto"};
    const auto asks = [](const Seen& now) { return now.study && now.asks_consent; };
    {
        Participant person(at, device, {});
        person.wait_until(asks);
        person.press("Return");
        person.press("space");
        CHECK(asks(person.seen()));
        CHECK(person.leave_early() == 0);
    }
    CHECK_FALSE(std::filesystem::exists(at.folder / "state/dibhr/agreed"));
    {
        Participant person(at, device, {});
        person.wait_until(asks);
        person.press("a");
        person.wait_until([](const Seen& now) { return !now.asks_consent; });
        CHECK(Participant::is_at(person.seen(), StudyStep::instructions));
        CHECK(person.leave_early() == 0);
    }
    CHECK(contains(read_text(at.folder / "state/dibhr/agreed"), "touch.stability false\n"));
    Participant person(at, device, {});
    person.wait_for(StudyStep::instructions);
    CHECK_FALSE(person.seen().asks_consent);
    CHECK(person.leave_early() == 0);
    CHECK(at.errors().empty());
}

TEST_CASE("a study that is killed goes on at that trial when its participant says so",
          "[study window]") {
    check_going_on(SIGKILL, 128 + SIGKILL);
}

// 600 ms after the signal the program would end itself at once, with exit code 1.
TEST_CASE("a study that is broken off goes on at that trial when its participant says so",
          "[study window][realtime]") {
    check_going_on(SIGTERM, 0);
}

TEST_CASE("a study that is killed at any picture loses no answer and doubles none",
          "[study window][long]") {
    constexpr int kKills = 8;
    const Sitting at(head() + kPairs + "repetitions = " + std::to_string(kKills) + "\n");
    Random dice(7);
    std::vector<AnsweredTrial> before;
    // A study whose last answer is in the file ends as soon as it is started again.
    for (int kill = 0; kill < kKills && before.size() < kKills - 1; ++kill) {
        Participant person(at);
        const double pictures = 20.0 + 200.0 * dice.uniform();
        while (static_cast<double>(person.seen().picture) < pictures &&
               person.seen().trial < kKills - 1)
            person.go_on();
        CHECK(person.ended_by(SIGKILL) == 128 + SIGKILL);
        const std::vector<AnsweredTrial> now = at.record().answered;
        REQUIRE(now.size() >= before.size());
        for (std::size_t k = 0; k < before.size(); ++k) CHECK(now[k].answer == before[k].answer);
        before = now;
    }
    Participant person(at);
    while (!Participant::is_at(person.seen(), StudyStep::thanks)) person.go_on();
    CHECK(person.close() == 0);
    const StudyRecord record = at.record();
    CHECK(record.finished);
    CHECK(record.answered.size() == kKills);
    CHECK_FALSE(std::filesystem::exists(at.running_session()));
}

TEST_CASE("the button that takes the force off counts in the picture that begins an interval, too",
          "[study window]") {
    const Sitting at(head() + kPairs);
    write_firmware(at.folder / "firmware.bin");
    const FalconOnUsb falcon(at.folder.path(), {"firmware", "home", "place 0 0 140"});
    const Participant person(at, {"--device", "falcon", "--firmware", "firmware.bin"},
                             falcon.host());
    person.leave(StudyStep::instructions);
    // The surface is ready; the interval begins 0.9 s after the press.
    const auto is_about_to_begin = [](int interval) {
        return [interval](const Seen& now) {
            return Participant::is_at(now, StudyStep::interval) && now.interval == interval &&
                   (now.force_enabled || (now.waits && now.records && now.surface));
        };
    };
    person.hang_window_when(is_about_to_begin(0));
    if (!person.seen().waits) {  // on a busy machine it may have begun: the next one, then
        person.resume_window();
        person.wait_for_interval(0, 0);
        person.press("Return");
        person.hang_window_when(is_about_to_begin(1));
    }
    REQUIRE(person.seen().waits);
    falcon.wait_for_commands(2000);  // 1.5 s of them: the interval is due
    falcon.tell("press 8");          // minus
    falcon.wait_for_commands(50);
    person.resume_window();
    person.wait_until(
        [](const Seen& now) { return Participant::is_at(now, StudyStep::interval) && !now.waits; });
    CHECK_FALSE(person.seen().force_enabled);
}

TEST_CASE("trials are felt and answered with the Falcon alone", "[study window]") {
    const Sitting at(head() + kPairs + "repetitions = 2\nbreak-after = 1\n" + kAdjustment);
    write_firmware(at.folder / "firmware.bin");
    const FalconOnUsb falcon(at.folder.path(), {"firmware", "home", "place 0 0 140"});
    Participant person(at, {"--device", "falcon", "--firmware", "firmware.bin"}, falcon.host());
    falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    // Presses buttons (numbers from 0) until the study continues. The window must have seen the
    // release before, else there is no new press.
    const auto press = [&](int button, const std::function<bool(const Seen&)>& has_gone_on) {
        person.wait_until([](const Seen& now) { return now.buttons == 0; });
        falcon.tell("press " + std::to_string(1 << button));
        person.wait_until(has_gone_on);
        falcon.tell("press 0");
    };
    const auto leave = [&](StudyStep step) {
        person.wait_for(step);
        press(0, [step](const Seen& now) { return !Participant::is_at(now, step); });
    };
    const auto feel = [&](int trial, int interval) {
        person.wait_for_interval(trial, interval);
        person.wait_until([](const Seen& now) { return now.ready; });
        FalconOnUsb::wait_until([&] { return falcon.vector("motor_newton").z > 0.5; });
    };
    const auto leave_interval = [&](int trial, int interval) {
        feel(trial, interval);
        press(0, [=](const Seen& now) {
            return now.interval != interval || !Participant::is_at(now, StudyStep::interval);
        });
    };
    const auto answer = [&](int button) {
        person.wait_for(StudyStep::question);
        press(button,
              [](const Seen& now) { return !Participant::is_at(now, StudyStep::question); });
    };
    leave(StudyStep::instructions);
    for (const int trial : {0, 1}) {
        leave_interval(trial, 0);
        leave_interval(trial, 1);
        answer(trial);
        if (trial == 0) leave(StudyStep::pause);
    }
    leave_interval(2, 0);
    feel(2, 1);
    press(2, [](const Seen& now) { return !Participant::is_at(now, StudyStep::adjust); });
    person.wait_for(StudyStep::thanks);
    falcon.tell("press 1");
    CHECK(person.end() == 0);

    CHECK(at.errors().empty());
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 3);
    CHECK(record.answered[0].answer.choice == 0);
    CHECK(record.answered[1].answer.choice == 1);
    CHECK(record.answered[2].answer.number.has_value());
    REQUIRE(run_dibhr(at.folder, {"study", "sessions", "answers/P7.dibhr-study", "--out", "s"})
                .exit_code == 0);
    check_same_bits(at, "P7-001.dibhr");
}

TEST_CASE("a trial is felt and answered with an arm below a maker's library alone",
          "[study window]") {
    const Sitting at(head() + kPairs);
    const auto arm =
        make_stand_in(GENERATE(as<std::string>{}, "forcedimension", "openhaptics"), at.folder);
    CAPTURE(arm->kind());
    Participant person(at, {"--device", arm->kind()}, {});
    arm->move_hand(0.0, 10.0, 100);
    const auto press = [&](unsigned button, const std::function<bool(const Seen&)>& has_gone_on) {
        person.wait_until([](const Seen& now) { return now.buttons == 0; });
        arm->press_buttons(1U << button);
        person.wait_until(has_gone_on);
        arm->press_buttons(0);
    };
    person.wait_for(StudyStep::instructions);
    press(0, [](const Seen& now) { return !Participant::is_at(now, StudyStep::instructions); });
    for (const int interval : {0, 1}) {
        person.wait_for_interval(0, interval);
        person.wait_until([&](const Seen& now) { return now.ready && arm->newton() > 0.3; });
        press(0, [=](const Seen& now) {
            return now.interval != interval || !Participant::is_at(now, StudyStep::interval);
        });
    }
    person.wait_for(StudyStep::question);
    // The arm's second button keeps its use: it takes the force off.
    press(0, [](const Seen& now) { return !Participant::is_at(now, StudyStep::question); });
    person.wait_for(StudyStep::thanks);
    person.wait_until([](const Seen& now) { return now.buttons == 0; });
    arm->press_buttons(1);
    CHECK(person.end() == 0);

    CHECK(at.errors().empty());
    const StudyRecord record = at.record();
    CHECK(record.finished);
    REQUIRE(record.answered.size() == 1);
    CHECK(record.answered[0].answer.choice == 0);
    REQUIRE(run_dibhr(at.folder, {"study", "sessions", "answers/P7.dibhr-study", "--out", "s"})
                .exit_code == 0);
    check_same_bits(at, "P7-001.dibhr");
    CHECK(arm->wrong_calls() == 0);
    CHECK_FALSE(arm->force_is_on());
}
