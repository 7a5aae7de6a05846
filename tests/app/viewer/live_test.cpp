// Live sources in the real window: touched, lost and found again, recorded and replayed.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/files/content_hash.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// Millimetres: a wall, and a ball before it that moves to and fro, seen with noise, and with holes
/// that come and go.
std::uint16_t sensed(int k, int i, int j) {
    const double x = 80.0 + 25.0 * std::sin(0.13 * k);
    const double away2 = (i - x) * (i - x) + (j - 60.0) * (j - 60.0);
    const auto shaken = static_cast<unsigned>(k * 7919 + i * 104729 + j * 1299709) * 2654435761U;
    if ((shaken >> 20U) % 37U == 0U && i % 9 < 4) return 0;
    const double ball_mm = away2 < 900.0 ? std::sqrt(900.0 - away2) * 10.0 : 0.0;
    return static_cast<std::uint16_t>(1400.0 - ball_mm + (shaken >> 28U));
}

PictureSender::Asked camera() {
    PictureSender::Asked asked;
    asked.level = sensed;
    return asked;
}

constexpr std::uint64_t kInAndOut = 1400;  // ticks, in which the goals come into the surface
/// In and out of the surface, and over it.
void write_goals(const fs::path& file) {
    std::ofstream out(file);
    out << "t,x,y,z\n";
    for (int k = 0; k < 3000; ++k) {
        const double t = 0.001 * k;
        out << t << ',' << 80.0 + 20.0 * std::sin(3.0 * t) << ',' << 60.0 + 12.0 * std::cos(2.0 * t)
            << ',' << 18.0 + 14.0 * std::sin(5.0 * t) << '\n';
    }
}

/// Whether the session has the size and hash of that video.
bool knows(const SessionMedia& video) {
    return video.bytes == fs::file_size(video.file) && video.head_bytes > 0 &&
           video.head_bytes < 4096 && video.sha256 == sha256_of_file(video.file, video.head_bytes);
}

void check_whole(const TemporaryFolder& folder, const fs::path& file) {
    CAPTURE(file);
    const Session session(file);
    CHECK(session.fact("complete") == "1");
    REQUIRE_FALSE(session.sources().empty());
    CHECK(knows(session.sources().front().depth));
    require_same_bits(folder, file);
}

/// The session recorded by key; empty: none.
fs::path recorded_by_key(const TemporaryFolder& folder) {
    for (const std::string& name : names_in(folder.path()))
        if (name.starts_with("dibhr-") && name.ends_with(".dibhr")) return folder / name;
    return {};
}

void wait_for_rows(const WindowProgram& viewer, std::uint64_t more) {
    const std::uint64_t rows = viewer.seen().recorded_rows;
    viewer.wait_until([wanted = rows + more](const Seen& now) {
        return now.records && now.recorded_rows >= wanted;
    });
}

/// Waits until `words` are so often in a log.
void wait_for_words(const fs::path& log, const std::string& words, int times = 1) {
    INFO(words);
    REQUIRE(eventually([&] {
        const std::string told = read_text(log);
        int found = 0;
        for (auto at = told.find(words); at != std::string::npos; at = told.find(words, at + 1))
            ++found;
        return found >= times;
    }));
}

int carried_ticks(const fs::path& file) {
    const Session session(file);
    int carried = 0;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);)
        if (tick.contact && tick.frames.source.motion && !tick.motion_unknown) ++carried;
    return carried;
}

/// Whether a receiver listens on that port.
bool is_listened_to(int port) {
    std::array<char, 8> wanted{};
    std::snprintf(wanted.data(), wanted.size(), ":%04X ", static_cast<unsigned>(port));
    return read_text("/proc/net/udp").find(wanted.data()) != std::string::npos;
}

}  // namespace

TEST_CASE("a live session keeps its video and replays to the same bits, a lost signal included",
          "[live]") {
    const TemporaryFolder folder;
    write_goals(folder / "goals.csv");
    const int port = free_port();
    PictureSender sender(port, camera());
    const Desk desk;
    WindowProgram viewer =
        desk.start_viewer(folder, {PictureSender::url(port), "--record",
                                   (folder / "a.dibhr").string(), "--size", "640x480", "--cleaning",
                                   "sensor", "--device", "goals:" + (folder / "goals.csv").string(),
                                   "--log-file", (folder / "told.txt").string()});
    wait_for_words(folder / "told.txt", "live: Signal from 'tcp://");
    wait_for_rows(viewer, 600);
    sender.stop();
    wait_for_words(folder / "told.txt", "live: No signal from 'tcp://");
    viewer.wait_until(
        [](const Seen& now) { return now.cut == static_cast<int>(SafetyCut::standstill); });
    wait_for_rows(viewer, 600);
    const std::uint64_t still_lost = viewer.seen().recorded_rows;
    sender.go_on();
    wait_for_words(folder / "told.txt", "live: Signal from 'tcp://", 2);
    viewer.wait_until([](const Seen& now) { return now.cut == 0; });
    wait_for_rows(viewer, kInAndOut);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(fs::exists(folder / "a.depth.mkv"));
    CHECK_FALSE(fs::exists(folder / "a.color.mkv"));  // it has none
    const Session session(folder / "a.dibhr");
    REQUIRE(session.sources().size() >= 1);
    CHECK(session.sources().front().depth.file == folder / "a.depth.mkv");
    CHECK(knows(session.sources().front().depth));
    require_same_bits(folder, folder / "a.dibhr");
    const std::vector<Row> rows = read_session(folder / "a.dibhr");
    const auto is_cut = [](const Row& row) {
        return row.cut == static_cast<int>(SafetyCut::standstill);
    };
    const auto has_force = [](const Row& row) { return glm::length(row.sent_newton) > 0.0; };
    const auto went_on = rows.begin() + static_cast<std::ptrdiff_t>(still_lost);
    const auto lost = std::find_if_not(std::make_reverse_iterator(went_on), rows.rend(), is_cut);
    // Without frames there was no force, except in the first ticks, in which it faded.
    constexpr std::ptrdiff_t kFading = 50;
    REQUIRE(went_on - lost.base() > 2 * kFading);
    CHECK(std::none_of(lost.base() + kFading, went_on, has_force));
    CHECK(std::count_if(rows.begin(), lost.base(), has_force) > 100);
    CHECK(std::any_of(went_on, rows.end(), has_force));
}

TEST_CASE("a live recording that another size of the pictures or Ctrl+C ends is whole at once",
          "[live]") {
    const TemporaryFolder folder;
    const int port = free_port();
    PictureSender::Asked asked = camera();
    asked.columns = 320;
    asked.rows = 240;
    auto sender = std::make_unique<PictureSender>(port, asked);
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(
        folder, {PictureSender::url(port), "--record", (folder / "a.dibhr").string(), "--size",
                 "640x480", "--device", "mouse", "--log-file", (folder / "told.txt").string()});
    wait_for_rows(viewer, 300);
    sender.reset();
    sender = std::make_unique<PictureSender>(port, camera());
    wait_for_words(folder / "told.txt",
                   "Finishing the recording, as the live source changed its form");
    wait_for_words(folder / "told.txt", "told: Recorded ");
    check_whole(folder, folder / "a.dibhr");
    CHECK(contains(read_text(folder / "errors.txt"),
                   "a.dibhr: the recording ends here, as the live source changed its form"));

    viewer.wait_until([](const Seen& now) { return now.surface && !now.records; });
    viewer.act("key ctrl+r");
    wait_for_rows(viewer, 300);
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    REQUIRE_FALSE(recorded_by_key(folder).empty());
    check_whole(folder, recorded_by_key(folder));
}

// 600 ms after the signal the program would be ended at once, with a line.
TEST_CASE("Ctrl+C ends what waits for a live source, and without a word", "[live][realtime]") {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int port = free_port();
    const bool from_pipe = GENERATE(false, true);
    const std::string name =
        from_pipe ? "pipe:" + pipe.string() : "udp://127.0.0.1:" + std::to_string(port);
    CAPTURE(name);
    Process viewer({DIBHR_PROGRAM, "view", name},
                   {"XDG_CONFIG_HOME=" + folder.path().string(), "DISPLAY="},
                   folder / "errors.txt");
    int writer = -1;
    REQUIRE(eventually([&] {
        if (from_pipe) writer = ::open(pipe.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        return from_pipe ? writer >= 0 : is_listened_to(port);
    }));
    viewer.interrupt();
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
    if (writer >= 0) ::close(writer);
}

TEST_CASE("a packed stream is recorded by key with its colour, and seen again without it",
          "[live]") {
    const TemporaryFolder folder;
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(
        folder, {"lavfi:testsrc2=size=160x120:rate=30,format=yuv444p,split[a][b];[b]format=gray,"
                 "boxblur=8,format=yuv444p[c];[a][c]hstack",
                 "--packing", "left-right", "--device", "mouse", "--size", "640x480"});
    viewer.wait_for_surface();
    viewer.act("mousemove 150 240 mousedown 1 key ctrl+r");
    wait_for_rows(viewer, 100);
    const double begin_s = viewer.seen().drawn_s;
    viewer.act("mousemove_relative 30 10");
    viewer.wait_until([begin_s](const Seen& now) { return now.drawn_s > begin_s + 0.6; });
    viewer.act("key ctrl+r mouseup 1");
    viewer.wait_until([](const Seen& now) { return !now.records; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    const fs::path session = recorded_by_key(folder);
    REQUIRE_FALSE(session.empty());
    const MediaDescription kept = open_media(fs::path(session).replace_extension(".color.mkv"),
                                             fs::path(session).replace_extension(".depth.mkv"))
                                      ->description();
    CHECK(kept.colour_columns == 160);
    CHECK(kept.depth_columns == 160);
    CHECK(kept.duration_s > 0.5);
    require_same_bits(folder, session);
}

TEST_CASE("a recording asked for while the last one is finished is taken back by another press",
          "[live]") {
    const TemporaryFolder folder;
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(
        folder, {"lavfi:testsrc2=size=160x120:rate=30,format=yuv444p,split[a][b];[b]format=gray,"
                 "boxblur=8,format=yuv444p[c];[a][c]hstack",
                 "--packing", "left-right", "--device", "mouse", "--size", "640x480"});
    viewer.wait_for_surface();
    viewer.act("mousemove 150 240 mousedown 1 key ctrl+r");
    wait_for_rows(viewer, 100);
    // Ends it, asks for another one, takes it back.
    act_in_one_picture(desk, viewer, "key ctrl+r", 3);
    viewer.wait_until([](const Seen& now) { return contains(now.notice.str(), "Recorded "); });
    for (int k = 0; k < 10; ++k) viewer.wait_for_turn();
    CHECK_FALSE(viewer.seen().records);
    desk.press("mouseup 1 key q");
    REQUIRE(viewer.wait() == 0);
    const auto is_session = [](const std::string& name) { return name.ends_with(".dibhr"); };
    CHECK(std::ranges::count_if(names_in(folder.path()), is_session) == 1);
}

TEST_CASE("a live session over what moves carries the hand, and replays to the same bits",
          "[live]") {
    const TemporaryFolder folder;
    // Few frames a second: motion rests where there is no time for it, as on a busy machine. A
    // hill, on which a texture goes 3 px to the right from frame to frame; a finger that rests on
    // it for most of the time.
    std::ofstream goals(folder / "goals.csv");
    goals << "t,x,y,z\n";
    for (int k = 0; k < 2000; ++k)
        goals << 0.001 * k << ",80,60,"
              << std::max(10.0, 80.0 * std::cos(0.001 * std::numbers::pi * k)) << '\n';
    goals.close();
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(
        folder,
        {"lavfi:nullsrc=size=160x120:rate=8,format=gray,geq='128+50*sin(0.31*(X-3*N))*cos(0.23*Y)"
         "+40*sin(0.13*Y+0.17*(X-3*N))',format=yuv444p[a];nullsrc=size=160x120:rate=8,format=gray,"
         "geq='100+50*sin(0.02*X)',format=yuv444p[b];[a][b]hstack",
         "--packing", "left-right", "--depth-range", "255:0", "--carry", "on", "--friction", "0.8",
         "--record", (folder / "a.dibhr").string(), "--size", "640x480", "--device",
         "goals:" + (folder / "goals.csv").string()});
    REQUIRE(eventually([&] {
        wait_for_rows(viewer, 500);
        return carried_ticks(folder / "a.dibhr") > 300;
    }));
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(carried_ticks(folder / "a.dibhr") > 300);
    require_same_bits(folder, folder / "a.dibhr");
}
