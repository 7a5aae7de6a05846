// Playing a session without a window, and what a recording keeps of what a person typed.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/viewer/explaining.hpp"
#include "app/viewer/recording.hpp"
#include "app/viewer/replay.hpp"
#include "core/error.hpp"
#include "core/replay/session_player.hpp"
#include "core/replay/session_replay.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// A session of a second over a small film with noise.
struct Recorded {
    Recorded() {
        const std::string film =
            "ffmpeg -v error -f lavfi -i testsrc2=size=120x90:rate=30:duration=0.5";
        run_shell(folder, film + " -c:v ffv1 film_color.mkv");
        run_shell(folder, film + ",format=gray -c:v ffv1 film_depth.mkv");
        record_session(folder / "mine.dibhr",
                       {.colour = folder / "film_color.mkv", .depth = folder / "film_depth.mkv"});
    }
    [[nodiscard]] std::unique_ptr<OpenedSession> open() const {
        return std::make_unique<OpenedSession>(folder / "mine.dibhr", false);
    }
    [[nodiscard]] std::vector<TickRecord> ticks() const {
        const Session session(folder / "mine.dibhr");
        std::vector<TickRecord> ticks;
        Session::Ticks rows(session);
        for (TickRecord tick; rows.next(tick);) ticks.push_back(tick);
        return ticks;
    }
    TemporaryFolder folder{};
};

/// Makes pictures until `done`; what passed meanwhile.
template <typename Done>
std::vector<SessionMoment> play_until(SessionPlayer& player, Done done) {
    std::vector<SessionMoment> passed;
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!done(passed)) {
        REQUIRE(std::chrono::steady_clock::now() < patience);
        player.advance([&passed](const SessionMoment& moment) { passed.push_back(moment); });
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
    return passed;
}

std::vector<SessionMoment> play_to_end(SessionPlayer& player) {
    return play_until(player, [&player](const auto&) { return !player.playback().playing; });
}

/// The moment after a jump, computed if that was asked for.
SessionMoment arrival(SessionPlayer& player) {
    const auto passed = play_until(
        player, [](const auto& moments) { return !moments.empty() && !moments.back().preview; });
    return passed.back();
}

}  // namespace

TEST_CASE("a replay passes every tick once and in order, over exactly the frames it touched",
          "[player]") {
    const Recorded recorded;
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    const std::vector<SessionMoment> passed = play_to_end(player);
    const std::vector<TickRecord> ticks = recorded.ticks();
    REQUIRE(passed.size() == ticks.size());
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        REQUIRE(passed[k].tick.tick == ticks[k].tick);
        REQUIRE_FALSE(passed[k].computed);
        if (!ticks[k].surface) continue;
        REQUIRE(passed[k].frames);
        const TouchedFrames& frames = *passed[k].frames;
        REQUIRE_THAT(frames.from.media_s, WithinAbs(ticks[k].frames.from_s, 0.0));
        REQUIRE_THAT(frames.to.media_s, WithinAbs(ticks[k].frames.to_s, 0.0));
        REQUIRE(frames.from.index == ticks[k].frames.from_frame);
        REQUIRE_FALSE(frames.from.colour->rgb.empty());
    }
    CHECK_THAT(player.playback().now_s, WithinAbs(ticks.back().t_s, 1e-9));
    player.play();  // from the beginning again
    CHECK(arrival(player).tick.tick == ticks.front().tick);
}

TEST_CASE(
    "Explain in a replay shows the next tick's update, and ends when the replay goes elsewhere",
    "[player]") {
    const Recorded recorded;
    const std::vector<TickRecord> ticks = recorded.ticks();
    const auto touching = std::find_if(ticks.begin(), ticks.end(), [](const TickRecord& tick) {
        return tick.contact && tick.moves > 2;
    });
    REQUIRE(ticks.end() - touching > 10);
    const TickRecord& next = *touching;
    const TickRecord& before = *std::prev(touching);
    ViewerState state;
    Player player;
    Camera camera;
    ViewerReplay replay;
    ViewerExplaining explaining;
    replay.begin(recorded.open(), {}, state);
    const auto show_until = [&](auto done) {
        play_until(*replay.player(), [&](const auto&) {
            replay.advance(state);
            explaining.advance(replay.shown(), state, camera, 0.0);
            return done();
        });
    };
    replay.player()->pause();
    replay.player()->seek(before.t_s);
    show_until([&] { return state.replay->tick.tick == before.tick && state.haptic.touchable; });
    const glm::dmat4 view = camera.clip_from_grid(1.5);

    REQUIRE(explaining.perform(Action::explain, state, player, replay.player()));
    show_until([&] { return !state.explained || !state.explained->waits; });
    REQUIRE(state.explained);
    CHECK(state.replay->tick.tick == next.tick);
    CHECK(state.explained->update.result.position == next.proxy);
    CHECK(state.explained->update.result.moves == next.moves);
    CHECK(camera.clip_from_grid(1.5) != view);

    SECTION("by a seek") {
        replay.player()->seek(ticks.back().t_s);
        show_until([&] { return state.replay->tick.tick == ticks.back().tick; });
        const auto answer = explaining.perform(Action::explain, state, player, replay.player());
        REQUIRE(answer);
        CHECK(answer->words == "No update comes after this");
    }
    SECTION("by playing on") {
        replay.player()->play();
        show_until([&] { return state.replay->tick.tick != next.tick; });
    }
    CHECK_FALSE(state.explained);
    CHECK(camera.clip_from_grid(1.5) == view);
}

TEST_CASE("a replay keeps the session's time", "[player]") {
    const Recorded recorded;
    SessionPlayer player(recorded.open());
    static_cast<void>(arrival(player));
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<SessionMoment> passed = play_to_end(player);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    // Never faster; slower only as far as a busy machine makes it.
    CHECK(took.count() > 0.9 * (passed.back().tick.t_s - passed.front().tick.t_s));
}

TEST_CASE("a replay goes to any time, and by single ticks, whether it plays or not", "[player]") {
    const Recorded recorded;
    const std::vector<TickRecord> ticks = recorded.ticks();
    SessionPlayer player(recorded.open());
    player.pause();
    static_cast<void>(arrival(player));
    for (const std::size_t k : {700U, 20U, 999U, 0U}) {
        player.seek(ticks[k].t_s);
        CHECK(arrival(player).tick.tick == ticks[k].tick);
        CHECK_FALSE(player.playback().playing);
    }
    player.seek(ticks[300].t_s);
    static_cast<void>(arrival(player));
    player.step(1);
    CHECK(arrival(player).tick.tick == ticks[301].tick);
    player.step(3);
    play_until(player, [](const auto& moments) { return moments.size() == 3; });
    CHECK(player.moment()->tick.tick == ticks[304].tick);
    player.step(-1);
    CHECK(arrival(player).tick.tick == ticks[303].tick);
    player.seek(-5.0);
    CHECK(arrival(player).tick.tick == ticks.front().tick);
    player.seek(1e9);
    CHECK(arrival(player).tick.tick == ticks.back().tick);
}

TEST_CASE("of a replay a part is played again and again, or once", "[player]") {
    const Recorded recorded;
    SessionPlayer player(recorded.open());
    const double begin_s = player.playback().begin_s;
    const MediaPart part{begin_s + 0.2, begin_s + 0.4};
    player.set_part(part);
    player.seek(part.from_s);
    SECTION("again and again") {
        player.set_looping(true);
        int laps = 0;
        double last_s = 0.0;
        const auto passed = play_until(player, [&](const auto& moments) {
            if (!moments.empty() && moments.back().tick.t_s < last_s) ++laps;
            if (!moments.empty()) last_s = moments.back().tick.t_s;
            return laps == 3;
        });
        // From where it began to play until it was sought to the part it was before it.
        const auto first = std::find_if(passed.begin(), passed.end(), [&](const auto& moment) {
            return moment.tick.t_s >= part.from_s;
        });
        for (auto moment = first; moment != passed.end(); ++moment) {
            CHECK(moment->tick.t_s >= part.from_s - 2e-3);
            CHECK(moment->tick.t_s <= part.to_s);
        }
    }
    SECTION("once") {
        static_cast<void>(play_to_end(player));
        CHECK_THAT(player.playback().now_s, WithinAbs(part.to_s, 1e-9));
        player.play();
        CHECK_THAT(arrival(player).tick.t_s, WithinAbs(part.from_s, 2e-3));
    }
}

TEST_CASE("of many seeks in a row the last one counts", "[player]") {
    const Recorded recorded;
    const std::vector<TickRecord> ticks = recorded.ticks();
    SessionPlayer player(recorded.open());
    player.pause();
    for (std::size_t k = 0; k <= 900; k += 10) player.seek(ticks[k].t_s);
    play_until(player, [&](const auto& moments) {
        return !moments.empty() && moments.back().tick.tick == ticks[900].tick;
    });
    CHECK_THAT(player.playback().now_s, WithinAbs(ticks[900].t_s, 1e-9));
}

TEST_CASE("the recorded parameters, computed again, give the recorded bits; others do not",
          "[player]") {
    const Recorded recorded;
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    const bool same = GENERATE(true, false);
    TouchParameters parameters = Session(recorded.folder / "mine.dibhr").parameters().front().touch;
    if (!same) parameters.friction = {0.0, 0.0};
    player.compute(parameters);
    std::size_t compared = 0, different = 0;
    for (const SessionMoment& moment : play_to_end(player)) {
        // Halfway the recording's own friction changes.
        if (!moment.computed || moment.tick.settings > 1) continue;
        ++compared;
        if (!same_bits(*moment.computed, moment.tick)) ++different;
    }
    CHECK(compared > 400);
    CHECK((different == 0) == same);
    player.compute({});
    CHECK_FALSE(arrival(player).computed);
}

TEST_CASE("people count ticks from 0, the session's first, wherever the loop's began", "[player]") {
    const Recorded recorded;
    run_shell(recorded.folder, "sqlite3 mine.dibhr 'UPDATE tick_data SET tick = tick + 5000'");
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    std::int64_t count = 0;
    for (const SessionMoment& moment : play_to_end(player)) {
        REQUIRE(moment.count == count++);
        REQUIRE(moment.tick.tick == moment.count + 5000);
    }
    CHECK(count == static_cast<std::int64_t>(recorded.ticks().size()));
}

TEST_CASE("beside other parameters the recorded algorithm's proxy is where it was recorded",
          "[player]") {
    const Recorded recorded;
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    TouchParameters parameters = Session(recorded.folder / "mine.dibhr").parameters().front().touch;
    const Algorithm recorded_algorithm = std::exchange(parameters.algorithm, Algorithm::pga);
    REQUIRE(recorded_algorithm == Algorithm::dibhr);
    player.compute(parameters);
    player.compare(true);
    std::size_t compared = 0;
    for (const SessionMoment& moment : play_to_end(player)) {
        // Halfway the recording's own friction changes.
        if (moment.others.empty() || moment.tick.settings > 1) continue;
        REQUIRE(moment.others.size() == all_algorithms().size() - 1);
        CHECK(moment.others.front().algorithm == recorded_algorithm);
        CHECK(same_bits(moment.others.front().proxy.position, moment.tick.proxy));
        ++compared;
    }
    CHECK(compared > 400);
    player.compute({});
    const std::vector<AlgorithmProxy> others = arrival(player).others;
    CHECK(others.size() == all_algorithms().size() - 1);
    for (const AlgorithmProxy& other : others) CHECK(other.algorithm != recorded_algorithm);
    player.compare(false);
    CHECK(arrival(player).others.empty());
}

TEST_CASE("after a jump other parameters are computed from a second earlier, and shown when ready",
          "[player]") {
    const Recorded recorded;
    const std::vector<TickRecord> ticks = recorded.ticks();
    SessionPlayer player(recorded.open());
    player.pause();
    player.compute(Session(recorded.folder / "mine.dibhr").parameters().front().touch);
    static_cast<void>(arrival(player));
    player.seek(ticks[400].t_s);
    const auto passed = play_until(player, [&ticks](const auto& moments) {
        return !moments.empty() && moments.back().tick.tick == ticks[400].tick &&
               moments.back().computed;
    });
    REQUIRE(passed.size() >= 2);
    const SessionMoment& preview = passed[passed.size() - 2];
    CHECK(preview.preview);
    CHECK_FALSE(preview.computed);
    CHECK(preview.tick.tick == ticks[400].tick);
    CHECK(same_bits(*passed.back().computed, ticks[400]));
}

TEST_CASE("a film that is gone or has changed, and a session without ticks, are told when opened",
          "[player]") {
    const Recorded recorded;
    const auto file = recorded.folder / "film_color.mkv";
    const std::string change = GENERATE("rm film_color.mkv", "printf x >>film_color.mkv");
    run_shell(recorded.folder, change);
    std::string told;
    try {
        static_cast<void>(recorded.open());
    } catch (const InputError& error) {
        told = error.what();
    }
    CAPTURE(told);
    CHECK(told.find(file.string()) != std::string::npos);
    CHECK(told.find('\n') == std::string::npos);
    const ProgramResult result =
        run_dibhr(recorded.folder, {(recorded.folder / "mine.dibhr").string()});
    CHECK(result.exit_code == 1);
    CHECK(result.errors == "dibhr: " + told + "\n");
}

TEST_CASE("what cannot be said of a replay is bad usage", "[player]") {
    const Recorded recorded;
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--record", "x.dibhr"}, {"depth.mkv"}, {"--raw-depth"}}) {
        std::vector<std::string> arguments{"view", "mine.dibhr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        CHECK(run_dibhr(recorded.folder, arguments).exit_code == 2);
    }
}

TEST_CASE("participant, note and marks are kept as they were typed, before and while recording",
          "[recording]") {
    const TemporaryFolder folder;
    const std::string note = "O'Brien; \"x\" -- %s \\ \u00e9\u20ac\u4e16 \xF0\x9F\x96\x90";
    const auto ticks = std::make_unique<TickRing>();
    LastWords words;
    Player player;
    ViewerRecording recording(*ticks, words, player);
    const auto state = std::make_unique<ViewerState>();
    const auto type = [](TextFields::Field& field, const std::string& text) {
        std::strncpy(field.data(), text.c_str(), field.size() - 1);
    };
    CHECK(recording.mark(*state).find("Ctrl+R") != std::string::npos);
    type(state->fields.participant, "P07");
    recording.start(folder / "mine.dibhr", *state);
    REQUIRE(recording.active());
    recording.hand_over({.recording = true, .version = 1}, {});
    for (std::int64_t k = 0; k < 50; ++k) {
        REQUIRE(ticks->push({.tick = k,
                             .t_s = 0.001 * static_cast<double>(k),
                             .zero_ns = 1,
                             .settings = 1,
                             .surface = false}));
    }
    type(state->fields.note, note);
    type(state->fields.tag, note);
    recording.take_news(*state);
    CHECK(recording.mark(*state).find(note) != std::string::npos);
    type(state->fields.tag, "");
    recording.mark(*state);
    REQUIRE(state->recording);
    CHECK(state->recording->marks.size() == 2);
    CHECK(recording.stop(*state).find("Recorded 50 ticks") == 0);
    CHECK_FALSE(recording.active());
    CHECK_FALSE(state->recording);
    const Session session(folder / "mine.dibhr");
    CHECK(session.fact("participant") == "P07");
    CHECK(session.fact("note") == note);
    REQUIRE(session.marks().size() == 2);
    CHECK(session.marks()[0].tag == note);
    CHECK(session.marks()[1].tag == "mark");
    CHECK(session.rows() == 50);
}
