// What is live in the real window: touched, lost and found again, recorded and replayed.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

#include "core/files/content_hash.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/media.hpp"
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

/// Whether a session knows what that video holds.
bool knows(const SessionMedia& video) {
    return video.bytes == fs::file_size(video.file) && video.head_bytes > 0 &&
           video.head_bytes < 4096 && video.sha256 == sha256_of_file(video.file, video.head_bytes);
}

}  // namespace

TEST_CASE("a live session keeps its video and replays to the same bits, a lost signal included",
          "[live]") {
    const TemporaryFolder folder;
    write_goals(folder / "goals.csv");
    const int port = free_port();
    PictureSender sender(port, camera());
    const Desk desk;
    Process viewer =
        desk.start_viewer(folder, {PictureSender::url(port), "--record",
                                   (folder / "a.dibhr").string(), "--seconds", "8", "--cleaning",
                                   "sensor", "--device", "goals:" + (folder / "goals.csv").string(),
                                   "--log-file", (folder / "told.txt").string()});
    REQUIRE(eventually([&] { return fs::exists(folder / "a.dibhr"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    sender.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(900));
    sender.go_on();
    REQUIRE(viewer.wait() == 0);
    CHECK(fs::exists(folder / "a.depth.mkv"));
    CHECK_FALSE(fs::exists(folder / "a.color.mkv"));  // it has none
    const Session session(folder / "a.dibhr");
    REQUIRE(session.sources().size() >= 1);
    CHECK(session.sources().front().depth.file == folder / "a.depth.mkv");
    CHECK(knows(session.sources().front().depth));
    const std::string told = read_text(folder / "told.txt");
    const auto there = told.find("live: Signal from 'tcp://");
    const auto lost = told.find("live: No signal from 'tcp://", there);
    CHECK(lost != std::string::npos);
    CHECK(told.find("live: Signal from 'tcp://", lost) != std::string::npos);
    require_same_bits(folder, folder / "a.dibhr");
    // While nothing came there was no force, from 300 ms after the last picture on.
    const std::vector<Row> rows = read_session(folder / "a.dibhr");
    int silent = 0;
    int in_contact = 0;
    for (const Row& row : rows) {
        if (row.contact) ++in_contact;
        if (row.cut != static_cast<int>(SafetyCut::standstill)) continue;
        ++silent;
    }
    CHECK(in_contact > 1000);
    CHECK(silent > 400);
    CHECK(silent < 1100);
    const auto first = std::find_if(rows.begin(), rows.end(), [](const Row& row) {
        return row.cut == static_cast<int>(SafetyCut::standstill);
    });
    for (auto row = first; row != rows.end() && row->t_s < first->t_s + 0.5; ++row)
        if (row->t_s > first->t_s + 0.05) CHECK(glm::length(row->sent_newton) == 0.0);
}

TEST_CASE("a live recording that Ctrl+C or another size of the pictures ends is whole at once",
          "[live]") {
    const TemporaryFolder folder;
    const bool changes = GENERATE(false, true);
    CAPTURE(changes);
    const int port = free_port();
    PictureSender::Asked asked = camera();
    asked.columns = 320;
    asked.rows = 240;
    auto sender = std::make_unique<PictureSender>(port, asked);
    const Desk desk;
    Process viewer = desk.start_viewer(
        folder, {PictureSender::url(port), "--record", (folder / "a.dibhr").string(), "--seconds",
                 "30", "--log-file", (folder / "told.txt").string()});
    REQUIRE(eventually([&] { return fs::exists(folder / "a.dibhr"); }));
    std::this_thread::sleep_for(std::chrono::seconds(2));
    if (changes) {
        sender.reset();
        sender = std::make_unique<PictureSender>(port, camera());
        REQUIRE(eventually(
            [&] { return contains(read_text(folder / "told.txt"), "told: Recorded "); }));
        CHECK(contains(read_text(folder / "told.txt"),
                       "Finishing the recording, as what is live changed its form"));
    }
    viewer.interrupt();
    CHECK(viewer.wait() == 0);
    const Session session(folder / "a.dibhr");
    CHECK(session.fact("complete") == "1");
    REQUIRE_FALSE(session.sources().empty());
    CHECK(knows(session.sources().front().depth));
    require_same_bits(folder, folder / "a.dibhr");
}

TEST_CASE("Ctrl+C ends what waits for a live source at once, and without a word", "[live]") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const std::string from = GENERATE(as<std::string>{}, "udp", "pipe");
    const std::string name = from == "udp" ? "udp://127.0.0.1:" + std::to_string(free_port())
                                           : "pipe:" + (folder / "pipe").string();
    CAPTURE(name);
    Process viewer({DIBHR_PROGRAM, "view", name},
                   {"XDG_CONFIG_HOME=" + folder.path().string(), "DISPLAY="},
                   folder / "errors.txt");
    std::this_thread::sleep_for(std::chrono::seconds(1));
    viewer.interrupt();
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("a packed stream is recorded by key with its colour, and seen again without it",
          "[live]") {
    const TemporaryFolder folder;
    const Desk desk;
    Process viewer = desk.start_viewer(
        folder, {"lavfi:testsrc2=size=160x120:rate=30,format=yuv444p,split[a][b];[b]format=gray,"
                 "boxblur=8,format=yuv444p[c];[a][c]hstack",
                 "--packing", "left-right", "--seconds", "12"});
    desk.act(
        "search --sync --onlyvisible --name dibhr sleep 1 mousemove 400 380 sleep 0.2 "
        "mousedown 1 sleep 0.3 key ctrl+r sleep 2 mousemove_relative 60 10 sleep 1 key ctrl+r "
        "sleep 0.3 mouseup 1");
    REQUIRE(viewer.wait() == 0);
    fs::path session;
    for (const std::string& name : names_in(folder.path()))
        if (name.ends_with(".dibhr")) session = folder / name;
    REQUIRE_FALSE(session.empty());
    const MediaDescription kept = open_media(fs::path(session).replace_extension(".color.mkv"),
                                             fs::path(session).replace_extension(".depth.mkv"))
                                      ->description();
    CHECK(kept.colour_columns == 160);
    CHECK(kept.depth_columns == 160);
    CHECK(kept.duration_s > 2.0);
    require_same_bits(folder, session);
}

TEST_CASE("a live session over what moves carries the hand, and replays to the same bits",
          "[live]") {
    const TemporaryFolder folder;
    // A hill, on which a texture goes 3 px to the right from frame to frame; a finger that rests on
    // it for most of the time.
    std::ofstream goals(folder / "goals.csv");
    goals << "t,x,y,z\n";
    for (int k = 0; k < 2000; ++k)
        goals << 0.001 * k << ",80,60,"
              << std::max(10.0, 80.0 * std::cos(0.001 * std::numbers::pi * k)) << '\n';
    goals.close();
    const Desk desk;
    Process viewer = desk.start_viewer(
        folder,
        {"lavfi:nullsrc=size=160x120:rate=30,format=gray,geq='128+50*sin(0.31*(X-3*N))*cos(0.23*Y)"
         "+40*sin(0.13*Y+0.17*(X-3*N))',format=yuv444p[a];nullsrc=size=160x120:rate=30,format=gray,"
         "geq='100+50*sin(0.02*X)',format=yuv444p[b];[a][b]hstack",
         "--packing", "left-right", "--depth-range", "255:0", "--carry", "on", "--friction", "0.8",
         "--record", (folder / "a.dibhr").string(), "--seconds", "5", "--device",
         "goals:" + (folder / "goals.csv").string()});
    REQUIRE(viewer.wait() == 0);
    const Session session(folder / "a.dibhr");
    int carried = 0;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);)
        if (tick.contact && tick.frames.source.motion && !tick.motion_unknown) ++carried;
    CHECK(carried > 500);
    require_same_bits(folder, folder / "a.dibhr");
}
