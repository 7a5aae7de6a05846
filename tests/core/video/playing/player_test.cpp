// The player as the program uses it: its own thread, real files, two readers.
#include "core/video/playing/player.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Clock = std::chrono::steady_clock;

namespace {

/// 40 frames of 25 a second, level 5 n, as colour and depth.
struct Clip {
    Clip() {
        make_flat_clip(folder / "color.mkv", 40, 25, kLossless);
        make_flat_clip(folder / "depth.mkv", 40, 25, kLossless);
    }
    [[nodiscard]] std::unique_ptr<Media> open() const { return open_media(folder / "color.mkv"); }
    TemporaryFolder folder{};
};

const Clip& clip() {
    static const Clip made;
    return made;
}

/// Paused on the frame: shown, and then in the status, which is published after the picture.
bool rests_on(Player& player, std::int64_t frame) {
    return eventually([&] {
        const FrameWindow& window = player.picture().front();
        const PlaybackStatus status = player.status();
        return window.count > 0 && window.frames[0].index == frame && status.frame == frame &&
               !status.playing;
    });
}

float level_of(const Frame& frame) {
    return frame.depth->at(3, 3);
}

}  // namespace

TEST_CASE("a player without a media shows nothing and ends", "[player]") {
    Player player;
    player.play();
    player.step(1);
    player.seek(1.0);
    CHECK_FALSE(player.status().open);
    CHECK(player.haptics().front().count == 0);
}

TEST_CASE("what was asked for is told at once, whatever the reading still takes", "[player]") {
    Player player;
    player.play_media(clip().open());
    player.pause();
    REQUIRE(rests_on(player, 0));
    for (int k = 1; k <= 5; ++k) {
        player.seek(player.status().media_s + 0.2);
        CHECK_THAT(player.status().media_s, WithinAbs(0.2 * k, 1e-9));
    }
    REQUIRE(rests_on(player, 25));
    player.set_speed(2.0);
    CHECK_THAT(player.status().speed, WithinAbs(2.0, 1e-12));
    player.play();
    CHECK(player.status().playing);
    player.step(1);
    CHECK_FALSE(player.status().playing);
    player.set_looping(false);
    CHECK_FALSE(player.status().looping);
    player.set_part(MediaPart{0.2, 0.4});
    CHECK(player.status().part == MediaPart{0.2, 0.4});
}

TEST_CASE("both readers see the media play: depth and colour of the same frame", "[player]") {
    Player player;
    player.play_media(clip().open());
    double last_s = -1.0;
    for (const double wanted_s : {0.08, 0.24}) {
        REQUIRE(eventually([&] {
            const FrameWindow& window = player.haptics().front();
            // A busy machine may have been late at the first one already.
            return window.count > 1 && window.frames[0].time_s >= std::max(wanted_s, last_s + 0.01);
        }));
        const FrameWindow& window = player.haptics().front();
        last_s = window.frames[0].time_s;
        for (std::size_t k = 0; k < window.count; ++k) {
            const Frame& frame = window.frames[k];
            CHECK_THAT(level_of(frame), WithinAbs(5.0 * static_cast<double>(frame.index), 0.5));
            CHECK_THAT(frame.rgb()->rgb[0], WithinAbs(5.0 * static_cast<double>(frame.index), 0.5));
        }
    }
    CHECK(eventually([&] { return player.picture().front().count == FrameWindow::kFrames; }));
    const PlaybackStatus status = player.status();
    CHECK(status.open);
    CHECK(status.playing);
    CHECK(status.decode_ms > 0.0);
    CHECK(status.handover_us > 0.0);
    CHECK(status.failure.empty());
}

TEST_CASE("pause, seek and steps land on the very frame", "[player]") {
    Player player;
    player.play_media(clip().open());
    player.pause();
    const double time_s = GENERATE(0.0, 0.61, 1.56, 9.0);
    const auto frame = std::min<std::int64_t>(39, static_cast<std::int64_t>(time_s * 25.0));
    CAPTURE(time_s);
    player.seek(1.0);
    player.seek(time_s);
    REQUIRE(rests_on(player, frame));
    CHECK_THAT(player.status().media_s, WithinAbs(static_cast<double>(frame) / 25.0, 0.001));
    player.step(-1);
    REQUIRE(rests_on(player, std::max<std::int64_t>(0, frame - 1)));
    player.step(2);
    REQUIRE(rests_on(player, std::min<std::int64_t>(39, std::max<std::int64_t>(0, frame - 1) + 2)));
    player.play();
    CHECK(eventually([&] { return player.status().playing; }));
}

TEST_CASE("with cleaning off the depth is exactly the file's", "[player]") {
    const TemporaryFolder folder;
    write_picture(folder / "rgb.png", 40, 30, 8, 3, [](int, int, int) { return 7; });
    write_picture(folder / "depth.png", 40, 30, 8, 1,
                  [](int i, int j, int) { return (i * 37 + j * 91) % 256; });
    const auto raw = open_depth(folder / "depth.png")->next();
    REQUIRE(raw);
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(folder / "rgb.png"));
    REQUIRE(rests_on(player, 0));
    CHECK(player.picture().front().frames[0].depth->levels == raw->depth.levels);
    player.set_cleaning({.preset = CleaningPreset::gentle});
    CHECK(eventually(
        [&] { return player.picture().front().frames[0].depth->levels != raw->depth.levels; }));
    CHECK(player.picture().front().count == 1);
}

TEST_CASE("a new file takes over from the one before, and raises the discontinuity", "[player]") {
    const TemporaryFolder folder;
    write_picture(folder / "rgb.png", 40, 30, 8, 3, [](int, int, int) { return 7; });
    write_picture(folder / "depth.png", 40, 30, 8, 1, [](int, int, int) { return 99; });
    Player player;
    player.play_media(clip().open());
    REQUIRE(eventually([&] { return player.picture().front().count > 0; }));
    const auto before = player.picture().front().discontinuity;
    player.play_media(open_media(folder / "rgb.png"));
    REQUIRE(eventually([&] { return player.picture().front().frames[0].depth->columns == 40; }));
    CHECK(player.picture().front().discontinuity > before);
}

TEST_CASE("whoever reads during play, seeks and loops never tears or goes back", "[player]") {
    Player player;
    player.set_cleaning(
        {.preset = CleaningPreset::own, .own = {.remove_spikes = true, .fill_holes = true}});
    player.set_speed(4.0);
    player.play_media(clip().open());
    std::atomic<bool> ended{false};
    std::atomic<int> wrong{0};
    std::atomic<int> seen{0};
    std::thread reader([&] {
        double newest_s = 0.0;
        while (!ended) {
            const FrameWindow& window = player.haptics().front();
            const DepthBlend pair = window.at(window.clock.playback_s(Clock::now()));
            if (pair.from != nullptr) {
                ++seen;
                if (std::fabs(level_of(*pair.from) - 5.0F * static_cast<float>(pair.from->index)) >
                    0.5F)
                    ++wrong;
                if (pair.to->time_s < pair.from->time_s || pair.blend < 0.0 || pair.blend > 1.0)
                    ++wrong;
                if (pair.from->time_s < newest_s) ++wrong;
                newest_s = pair.from->time_s;
            }
            std::this_thread::sleep_for(std::chrono::microseconds(200));  // a quick loop
        }
    });
    for (int k = 0; k < 30; ++k) {
        const int before = seen;
        const double time_s = player.picture().front().frames[0].time_s;
        if (k % 3 == 0) player.seek(0.05 * k);
        if (k % 7 == 1) player.step(-1);
        if (k % 7 == 2) player.play();
        CHECK(eventually([&] {
            (void)player.status();
            return player.picture().front().frames[0].time_s > time_s && seen > before + 4;
        }));
    }
    ended = true;
    reader.join();
    CHECK(wrong.load() == 0);
    CHECK(seen.load() > 100);
}

TEST_CASE("a file that is cut while it plays is told, and what is left plays on", "[player]") {
    static const TemporaryFolder whole;  // too large to be read at once
    static const auto noise = [] {
        const auto file = whole / "noise.mkv";
        make_flat_clip(file, 60, 25, kLossless, "noise=alls=90:allf=t", 160, 120);
        return file;
    }();
    const TemporaryFolder folder;
    for (const char* const name : {"color.mkv", "depth.mkv"})
        std::filesystem::copy_file(noise, folder / name);
    const auto cut_file = folder / GENERATE("color.mkv", "depth.mkv");
    Player player;
    player.set_speed(4.0);
    player.play_media(open_media(folder / "color.mkv"));
    REQUIRE(eventually([&] { return player.status().frame > 1; }));
    CHECK(player.status().failure.empty());
    std::filesystem::resize_file(cut_file, std::filesystem::file_size(cut_file) / 2);
    REQUIRE(eventually([&] { return !player.status().failure.empty(); }));
    CHECK(player.status().failure.find(cut_file.filename().string()) != std::string::npos);
    CHECK(player.status().failure.find("breaks off at") != std::string::npos);
    CHECK(player.status().playing);
    const double now_s = player.picture().front().frames[0].time_s;
    CHECK(eventually([&] { return player.picture().front().frames[0].time_s > now_s + 1.0; }));
}

TEST_CASE("the loop goes round and raises the discontinuity once a lap", "[player]") {
    Player player;
    // A busy machine leaves out no steps of it, which would raise the discontinuity, too.
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.set_speed(4.0);
    player.play_media(clip().open());
    REQUIRE(eventually([&] { return player.haptics().front().count > 0; }));
    const auto before = player.haptics().front().discontinuity;
    const double lap_s = 1.6;
    // On a busy machine the clock waits, so a lap may last longer than the media.
    REQUIRE(eventually([&] { return player.haptics().front().discontinuity > before; }));
    REQUIRE(eventually([&] { return player.haptics().front().frames[0].time_s > 1.5 * lap_s; }));
    const FrameWindow& later = player.haptics().front();
    const auto laps = static_cast<std::uint64_t>(later.frames[0].time_s / lap_s + 0.05);
    CHECK(later.discontinuity <= before + laps + 1);
    CHECK(player.status().frames == 40);
}
