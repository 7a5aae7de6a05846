// Playing a session without a window, and the typed facts of a recording.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/touching/recording.hpp"
#include "app/viewer/explaining.hpp"
#include "app/viewer/replay.hpp"
#include "core/error.hpp"
#include "core/replay/session_player.hpp"
#include "core/replay/session_replay.hpp"
#include "core/sqlite/database.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// A session of a second over a small film with noise.
struct Recorded {
    Recorded() {
        const std::string film =
            "ffmpeg -v error -f lavfi -i testsrc2=size=64x48:rate=30:duration=0.5";
        run_shell(folder, film + " -c:v ffv1 film_color.mkv");
        run_shell(folder, film + ",format=gray -c:v ffv1 film_depth.mkv");
        record_session(file,
                       {.colour = folder / "film_color.mkv", .depth = folder / "film_depth.mkv"});
    }
    [[nodiscard]] std::unique_ptr<OpenedSession> open() const { return open(file); }
    [[nodiscard]] static std::unique_ptr<OpenedSession> open(const std::filesystem::path& session) {
        return std::make_unique<OpenedSession>(session, false);
    }
    [[nodiscard]] std::vector<TickRecord> ticks() const {
        const Session session(file);
        std::vector<TickRecord> ticks;
        Session::Ticks rows(session);
        for (TickRecord tick; rows.next(tick);) ticks.push_back(tick);
        return ticks;
    }
    TemporaryFolder folder{};
    std::filesystem::path file{folder / "mine.dibhr"};
};

/// For tests that change nothing of it.
const Recorded& recorded_once() {
    static const Recorded once;
    return once;
}

/// When the next picture is shown: the replay's clock goes on by pictures, not by the machine.
SessionPlayer::Time next_picture() {
    static SessionPlayer::Time now{};
    return now += std::chrono::milliseconds(50);
}

/// Makes pictures until `done`; returns the moments played meanwhile.
template <typename Done>
std::vector<SessionMoment> play_until(SessionPlayer& player, Done done) {
    std::vector<SessionMoment> passed;
    const auto keep = [&passed](const SessionMoment& moment) { passed.push_back(moment); };
    REQUIRE(eventually([&] {
        if (done(passed)) return true;
        player.advance(next_picture(), keep);
        return done(passed);
    }));
    return passed;
}

std::vector<SessionMoment> play_to_end(SessionPlayer& player) {
    return play_until(player, [&player](const auto&) { return !player.playback().playing; });
}

/// The moment after a jump, computed if requested.
SessionMoment arrival(SessionPlayer& player) {
    const auto passed = play_until(
        player, [](const auto& moments) { return !moments.empty() && !moments.back().preview; });
    return passed.back();
}

/// The number of the last tick that is due.
std::int64_t last_due(const std::vector<TickRecord>& ticks, double due_s) {
    const auto next =
        std::upper_bound(ticks.begin(), ticks.end(), due_s,
                         [](double time_s, const TickRecord& tick) { return time_s < tick.t_s; });
    REQUIRE(next != ticks.begin());
    return std::prev(next)->tick;
}

}  // namespace

TEST_CASE("a damaged session shows where its hand touched, but for what cannot be read",
          "[session]") {
    constexpr std::streamoff kPage = 16384;
    const Recorded recorded;
    const auto band_of = [&recorded] {
        const auto opened = recorded.open();
        ContactBandReader reader(*opened);
        REQUIRE(eventually([&] { return reader.band() != nullptr; }));
        CHECK(reader.band()->hand.all > 0);
        return reader.band()->contact;
    };
    const auto whole = band_of();
    const std::int64_t page = Database(recorded.file)
                                  .number(
                                      "SELECT pageno FROM dbstat WHERE name = 'tick_data' AND "
                                      "pagetype = 'leaf' ORDER BY pageno LIMIT 1 OFFSET 2");
    std::fstream(recorded.file, std::ios::in | std::ios::out | std::ios::binary)
        .seekp((page - 1) * kPage)
        .write(std::string(kPage, '\0').data(), kPage);
    const auto part = band_of();
    const auto touched = [](const auto& band) { return std::ranges::count(band, true); };
    CHECK(touched(part) > 0);
    CHECK(touched(part) < touched(whole));
}

TEST_CASE("a replay passes every tick once and in order, over exactly the frames it touched",
          "[player]") {
    const Recorded& recorded = recorded_once();
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
        REQUIRE(frames.from.has_colour());
    }
    CHECK_THAT(player.playback().now_s, WithinAbs(ticks.back().t_s, 1e-9));
    player.play();  // from the beginning again
    CHECK(arrival(player).tick.tick == ticks.front().tick);
}

TEST_CASE(
    "Explain in a replay shows the next tick's update, and ends when the replay goes elsewhere",
    "[player]") {
    const Recorded& recorded = recorded_once();
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
        REQUIRE(eventually([&] {
            replay.advance(state, next_picture());
            explaining.advance(replay.shown(), state, camera, 0.0);
            return done();
        }));
    };
    replay.player()->pause();
    replay.player()->seek(before.t_s);
    const auto& replayed = state.touch.replay;
    show_until([&] { return replayed->tick.tick == before.tick && state.touch.haptic.touchable; });
    const glm::dmat4 view = camera.clip_from_grid(1.5);

    REQUIRE(explaining.perform(Action::explain, state, player, replay.player()));
    show_until([&] { return !state.ui.explained || !state.ui.explained->waits; });
    REQUIRE(state.ui.explained);
    CHECK(state.touch.replay->tick.tick == next.tick);
    CHECK(state.ui.explained->update.result.position == next.proxy);
    CHECK(state.ui.explained->update.result.moves == next.moves);
    CHECK(camera.clip_from_grid(1.5) != view);

    SECTION("by a seek") {
        replay.player()->seek(ticks.back().t_s);
        show_until([&] { return state.touch.replay->tick.tick == ticks.back().tick; });
        const auto answer = explaining.perform(Action::explain, state, player, replay.player());
        REQUIRE(answer);
        CHECK(answer->words == "No update comes after this");
    }
    SECTION("by playing on") {
        replay.player()->play();
        show_until([&] { return state.touch.replay->tick.tick != next.tick; });
    }
    CHECK_FALSE(state.ui.explained);
    CHECK(camera.clip_from_grid(1.5) == view);
}

TEST_CASE("a replay keeps the session's time, and stands still only for what is not read yet",
          "[player]") {
    const double speed = GENERATE(0.5, 1.0, 4.0);
    CAPTURE(speed);
    const Recorded& recorded = recorded_once();
    const std::vector<TickRecord> ticks = recorded.ticks();
    SessionPlayer player(recorded.open());
    player.set_speed(speed);
    double begin_s = 0.0;  // of the session, at `begin`
    SessionPlayer::Time begin{};
    const auto anchor = [&](SessionPlayer::Time now) {
        begin = now;
        begin_s = player.moment()->tick.t_s;
    };
    std::size_t in_time = 0;
    REQUIRE(eventually([&] {
        const bool had_begun = player.moment() != nullptr;
        const SessionPlayer::Time now = next_picture();
        player.advance(now, [](const SessionMoment&) {});
        if (player.moment() == nullptr) return false;
        if (!had_begun) anchor(now);
        const std::chrono::duration<double> passed = now - begin;
        const double due_s = begin_s + speed * passed.count();
        CHECK(player.moment()->tick.t_s <= due_s);
        if (player.playback().waiting) {
            anchor(now);
        } else {
            CHECK(player.moment()->tick.tick == last_due(ticks, due_s));
            ++in_time;
        }
        return !player.playback().playing;
    }));
    CHECK(in_time > 0);
    CHECK(player.moment()->tick.tick == ticks.back().tick);
}

TEST_CASE("a replay goes to any time, and by single ticks, whether it plays or not", "[player]") {
    const Recorded& recorded = recorded_once();
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
    const Recorded& recorded = recorded_once();
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
        // The moments before the seek to the part are outside of it.
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
    const Recorded& recorded = recorded_once();
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
    const Recorded& recorded = recorded_once();
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    const bool same = GENERATE(true, false);
    TouchParameters parameters = Session(recorded.file).parameters().front().touch;
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
    const Recorded& recorded = recorded_once();
    const TemporaryFolder folder;
    std::filesystem::copy_file(recorded.file, folder / "later.dibhr");
    run_shell(folder, "sqlite3 later.dibhr 'UPDATE tick_data SET tick = tick + 5000'");
    SessionPlayer player(Recorded::open(folder / "later.dibhr"));
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
    const Recorded& recorded = recorded_once();
    SessionPlayer player(recorded.open());
    player.set_speed(4.0);
    TouchParameters parameters = Session(recorded.file).parameters().front().touch;
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

TEST_CASE("after a jump other parameters are computed from earlier on, and shown when ready",
          "[player]") {
    const Recorded& recorded = recorded_once();
    const std::vector<TickRecord> ticks = recorded.ticks();
    SessionPlayer player(recorded.open());
    player.pause();
    player.compute(Session(recorded.file).parameters().front().touch);
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

TEST_CASE("after a jump into a long contact other parameters are computed from its begin",
          "[player]") {
    const Recorded recorded;
    const std::filesystem::path file = recorded.folder / "long.dibhr";
    record_session(file, {.colour = recorded.folder / "film_color.mkv",
                          .depth = recorded.folder / "film_depth.mkv",
                          .seconds = 6.0,
                          .jumps = true});
    std::vector<TickRecord> ticks;
    const Session session(file);
    Session::Ticks rows(session);
    for (TickRecord tick; rows.next(tick);) ticks.push_back(tick);
    SessionPlayer player(Recorded::open(file));
    player.pause();
    player.compute(session.parameters().front().touch);
    for (const int at : {1450, 2150, 2850}) {  // the friction changes at 3000
        REQUIRE(std::all_of(ticks.begin() + at - 1100, ticks.begin() + at + 1,
                            [](const TickRecord& tick) { return tick.contact; }));
        player.seek(ticks[at].t_s);
        play_until(player, [&](const auto& moments) {
            return !moments.empty() && moments.back().tick.tick == ticks[at].tick &&
                   moments.back().computed;
        });
        CHECK(same_bits(*player.moment()->computed, ticks[at]));
    }
}

TEST_CASE("a film that has changed or is gone, and a session without ticks, are told when opened",
          "[player]") {
    const Recorded recorded;
    const auto told_of = [&recorded](const std::filesystem::path& session) {
        std::string told;
        try {
            static_cast<void>(Recorded::open(session));
        } catch (const InputError& error) {
            told = error.what();
        }
        CAPTURE(told);
        CHECK(told.find('\n') == std::string::npos);
        const ProgramResult result = run_dibhr(recorded.folder, {session.string()});
        CHECK(result.exit_code == 1);
        CHECK(result.errors == "dibhr: " + told + "\n");
        return told;
    };
    const std::filesystem::path empty = recorded.folder / "empty.dibhr";
    std::filesystem::copy_file(recorded.file, empty);
    run_shell(recorded.folder, "sqlite3 empty.dibhr 'DELETE FROM tick_data'");
    CHECK(contains(told_of(empty), empty.string() + ": holds no tick"));
    const std::string film = (recorded.folder / "film_color.mkv").string();
    run_shell(recorded.folder, "printf x >>film_color.mkv");
    const std::string changed = told_of(recorded.file);
    CHECK(contains(changed, film));
    run_shell(recorded.folder, "rm film_color.mkv");
    const std::string gone = told_of(recorded.file);
    CHECK(contains(gone, film));
    CHECK(gone != changed);
}

TEST_CASE("what cannot be said of a replay is bad usage", "[player]") {
    const Recorded& recorded = recorded_once();
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
    CrashNote crash_note;
    Player player;
    FeltFrames felt_frames;
    const auto state = std::make_unique<ViewerState>();
    const KeyTable& keys = state->keys;
    TouchRecording recording(*ticks, crash_note, player, felt_frames,
                             {state->settings, state->touch, state->media});
    const auto type = [](TextField& field, const std::string& text) {
        std::strncpy(field.data(), text.c_str(), field.size() - 1);
    };
    CHECK(recording.mark(keys).find("Ctrl+R") != std::string::npos);
    type(state->touch.session_fields.participant, "P07");
    recording.start(folder / "mine.dibhr");
    REQUIRE(recording.active());
    recording.record_parameters({.recording = true, .version = 1});
    for (std::int64_t k = 0; k < 50; ++k) {
        REQUIRE(ticks->push({.tick = k,
                             .t_s = 0.001 * static_cast<double>(k),
                             .zero_ns = 1,
                             .settings = 1,
                             .surface = false}));
    }
    type(state->touch.session_fields.note, note);
    type(state->touch.session_fields.tag, note);
    recording.poll();
    CHECK(recording.mark(keys).find(note) != std::string::npos);
    type(state->touch.session_fields.tag, "");
    recording.mark(keys);
    REQUIRE(state->touch.recording);
    CHECK(state->touch.recording->marks.size() == 2);
    CHECK(recording.stop() == "Recorded 0.0 s into " + (folder / "mine.dibhr").string());
    CHECK_FALSE(recording.active());
    CHECK_FALSE(state->touch.recording);
    const Session session(folder / "mine.dibhr");
    CHECK(session.fact("participant") == "P07");
    CHECK(session.fact("note") == note);
    REQUIRE(session.marks().size() == 2);
    CHECK(session.marks()[0].tag == note);
    CHECK(session.marks()[1].tag == "mark");
    CHECK(session.rows() == 50);
}
