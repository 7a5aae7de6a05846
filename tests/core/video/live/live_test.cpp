// What comes as it happens: named, opened, joined, met again.
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/video/live/live_feed.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/live/live_bench.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

void play(Player& player, const std::string& url) {
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(url, {}, as_sent()), 1);
    REQUIRE(eventually([&] { return player.haptics().front().count > 1; }));
}

PictureSender::Asked blinking() {
    return flat([](int k) { return k % 2 == 0 ? 40000 : 10000; });
}

}  // namespace

TEST_CASE("cameras, streams and pipes are told from files by their names", "[live]") {
    for (const char* const name :
         {"v4l2:/dev/video2", "udp://127.0.0.1:5000", "rtsp://camera/depth", "srt://host:9000",
          "tcp://host:1", "http://host/stream", "https://host/stream", "rtp://127.0.0.1:5004",
          "lavfi:testsrc", "pipe:depth", "-"}) {
        CAPTURE(name);
        CHECK(is_live(name));
        CHECK_NOTHROW(live_name(name));
    }
    for (const char* const name : {"udp.mp4", "v4l2", "clip_depth.mkv", "file:///etc/passwd",
                                   "concat:a|b", "/dev/null", "ftp://host/a.mp4"}) {
        CAPTURE(name);
        CHECK_FALSE(is_live(name));
    }
}

TEST_CASE("no stream leads to a file of this machine", "[live]") {
    for (const char* const name : {"udp://127.0.0.1:5000", "rtsp://camera/depth", "tcp://host:1",
                                   "http://host/list.m3u8", "https://host/list.m3u8", "-"}) {
        CAPTURE(name);
        const std::string allowed = live_name(name).allowed;
        REQUIRE_FALSE(allowed.empty());
        for (const char* const local : {"file", "concat", "subfile", "data", "unix"})
            CHECK(allowed.find(local) == std::string::npos);
    }
}

TEST_CASE("a password in a name is shown to nobody", "[live]") {
    CHECK(public_name("rtsp://me:secret@camera:554/depth?a@b") == "rtsp://camera:554/depth?a@b");
    CHECK(public_name("udp://@239.0.0.1:5000") == "udp://@239.0.0.1:5000");
    CHECK(public_name("udp://127.0.0.1:5000") == "udp://127.0.0.1:5000");
    CHECK(public_name("/home/me@work/depth.mkv") == "/home/me@work/depth.mkv");
}

TEST_CASE("what a camera is asked for stands behind its name", "[live]") {
    const LiveName name = live_name("v4l2:/dev/video2?size=640x480&rate=30");
    CHECK(name.url == "/dev/video2");
    CHECK(name.options.at("video_size") == "640x480");
    CHECK(name.options.at("framerate") == "30");
    CHECK_THROWS_AS(live_name("v4l2:/dev/video2?colour=red"), InputError);
}

TEST_CASE("a stream that nobody sends is refused in a line that says so", "[live]") {
    const std::string url = PictureSender::url(free_port());
    const std::string why = refusal([&] { static_cast<void>(open_media(url)); });
    CHECK(why.find(url) != std::string::npos);
    CHECK(why.find("start the sender") != std::string::npos);
    CHECK(why.find('\n') == std::string::npos);
}

TEST_CASE("a name that lacks something is refused without asking the network", "[live]") {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"udp://", "lacks a port"},
        {"udp://127.0.0.1?pkt_size=1316", "lacks a port"},
        {"rtp://127.0.0.1:99999", "1 to 65535"},
        {"rtsp://camera:0/depth", "1 to 65535"},
        {"tcp://[::1]", "lacks a port"}};
    for (const auto& [name, words] : wrong) {
        CAPTURE(name);
        const std::string why = refusal([&one = name] { static_cast<void>(live_name(one)); });
        CHECK(contains(why, words));
        CHECK(contains(why, name));
        CHECK(refusal([&one = name] { static_cast<void>(open_media(one)); }) == why);
    }
    for (const char* const name : {"udp://@239.0.0.1:5000", "tcp://[::1]:5000?listen",
                                   "rtsp://me:secret@camera/depth", "udp://127.0.0.1:5000?a=b/c"})
        CHECK_NOTHROW(live_name(name));
}

TEST_CASE("what no waiting would mend is refused at once, in words that say what is wrong",
          "[live]") {
    const TemporaryFolder folder;
    const std::string fifo = (folder / "noise").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    std::jthread writer([&] {
        std::ofstream out(fifo, std::ios::binary);
        for (unsigned k = 1; k < 200'000; ++k) out.put(static_cast<char>(k * 2654435761U >> 11U));
    });
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"lavfi:nosuch", "libav can make"},
        {"tcp://nosuchhost.invalid:5000", "host is not found"},
        {"pipe:" + fifo, "holds no video"}};
    for (const auto& [name, words] : wrong) {
        CAPTURE(name);
        LiveFeed feed("", name);
        // Whose patience is endless, and has no end for anything else.
        CHECK(feed.after(0, LiveFeed::Clock::now() + std::chrono::hours(1)) == nullptr);
        CHECK(feed.signal().permanent_error);
        CHECK(contains(feed.signal().trouble, words));
        CHECK(contains(feed.signal().trouble, name));
    }
    const std::string made = refusal([] { static_cast<void>(open_media("lavfi:nosuch")); });
    CHECK(contains(made, "libav can make"));  // which whoever opens it is told
}

TEST_CASE("a stream is seen from its first key frame on, however seldom one comes", "[live]") {
    const int number = free_port();
    const std::string port = std::to_string(number);
    const TemporaryFolder folder;
    const std::string fifo = (folder / "depth").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const std::vector<std::pair<std::string, std::string>> ways{
        {"-t 2 -f nut '" + fifo + "'", "pipe:" + fifo},
        {"-f mpegts 'tcp://127.0.0.1:" + port + "?listen'", "tcp://127.0.0.1:" + port}};
    const auto& [to, from] = ways[GENERATE(some_of<std::size_t>({0, 1}, 2))];
    CAPTURE(from);
    auto sender = std::make_unique<Ffmpeg>(
        "-re -f lavfi -i testsrc2=s=96x64:r=30,format=gray,boxblur=4 -c:v libx264 -preset "
        "ultrafast -tune zerolatency -g 9999 -pix_fmt yuvj420p " +
        to);
    if (contains(to, "listen")) REQUIRE(comes_to_listen(number));
    const auto media = open_media(from, {}, as_sent());  // there is no other key frame
    sender.reset();
    CHECK(media->next());  // the picture that the opening inspected last
}

TEST_CASE("streams open by whatever protocol they come, and from a pipe", "[live]") {
    const int number = free_port();
    const std::string port = std::to_string(number);
    const TemporaryFolder folder;
    const std::string fifo = (folder / "depth").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const std::vector<std::pair<std::string, std::string>> ways{
        {"-f mpegts 'srt://127.0.0.1:" + port + "?mode=listener'", "srt://127.0.0.1:" + port},
        {"-f mpegts -listen 1 http://127.0.0.1:" + port, "http://127.0.0.1:" + port},
        {"-f rtp_mpegts rtp://127.0.0.1:" + port, "rtp://127.0.0.1:" + port},
        {"-f nut 'tcp://127.0.0.1:" + port + "?listen'", "tcp://127.0.0.1:" + port},
        {"-f matroska '" + fifo + "'", "pipe:" + fifo}};
    const auto& [to, from] = ways[GENERATE(some_of<std::size_t>({3, 0, 1, 2, 4}, 1))];
    CAPTURE(from);
    const Ffmpeg sender(
        "-re -f lavfi -i testsrc2=s=96x64:r=30,format=gray,boxblur=4 -c:v libx264 -preset "
        "ultrafast -tune zerolatency -g 10 -pix_fmt yuvj420p " +
        to);
    if (contains(to, "listen")) REQUIRE(comes_to_listen(number));
    const auto media = open_media(from, {}, as_sent());
    CHECK(media->description().depth_columns == 96);
    const auto first = media->next();
    const auto second = media->next();
    REQUIRE(first);
    REQUIRE(second);
    CHECK(second->media_s > first->media_s);
}

TEST_CASE("a live stream is described by its first pictures, and has neither length nor end",
          "[live]") {
    const int port = free_port();
    PictureSender::Asked asked;
    asked.level = [](int, int i, int j) { return static_cast<std::uint16_t>(400 + 20 * i + j); };
    const PictureSender sender(port, asked);
    const MediaDescription media = describe_media(PictureSender::url(port));
    CHECK(media.live);
    CHECK_FALSE(media.still);
    CHECK(media.depth_columns == 160);
    CHECK(media.depth_rows == 120);
    CHECK(media.depth_bits == 16);
    CHECK_THAT(media.frames_per_s, WithinAbs(30.0, 0.1));
    CHECK(media.duration_s == 0.0);
}

TEST_CASE("a sender that is started again is met again by itself; of another size it is said",
          "[live]") {
    const int port = free_port();
    auto sender = std::make_unique<PictureSender>(port, blinking());
    Player player;
    play(player, PictureSender::url(port));
    sender.reset();
    REQUIRE(eventually([&] { return !player.status().live->signal; }));
    sender = std::make_unique<PictureSender>(port, blinking());
    REQUIRE(eventually([&] { return player.status().live->signal; }));
    CHECK_FALSE(player.status().live->format_changed);
    sender.reset();
    PictureSender::Asked other = blinking();
    other.columns = 200;
    sender = std::make_unique<PictureSender>(port, other);
    REQUIRE(eventually([&] { return player.status().live->format_changed; }));
    CHECK(player.haptics().front().frames[0].depth->columns == 160);  // held
    Player again;
    play(again, PictureSender::url(port));
    CHECK(again.haptics().front().frames[0].depth->columns == 200);
}

TEST_CASE("packets that are lost or late leave out frames, and never show damage", "[live]") {
    const int from = free_port();
    const int to = free_port();
    constexpr int kLost = 150;  // one datagram in so many
    std::atomic<int> lost{0};
    const Relay relay(from, to, [&](int n) {
        if (n % kLost == kLost / 2) ++lost;
        return n % kLost == kLost / 2 ? -1 : n % 130 == 0 ? 30 : 2;
    });
    // Half of the picture is flat: any other level there is damage.
    const Ffmpeg sender(
        "-re -f lavfi -i "
        "\"testsrc2=s=320x240:r=30,format=gray,geq=lum='if(lt(X\\,160)\\,100\\,lum(X"
        "\\,Y))'\" -c:v libx264 -preset ultrafast -tune zerolatency -b:v 3M -g 10 -pix_fmt "
        "yuvj420p "
        "-f mpegts 'udp://127.0.0.1:" +
        std::to_string(from) + "?pkt_size=1316'");
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    const std::string url = "udp://127.0.0.1:" + std::to_string(to);
    player.play_media(open_media(url, {}, as_sent(255.0)), 1);
    REQUIRE(eventually([&] { return player.haptics().front().count > 1; }));
    const int lost_before = lost;
    std::int64_t frames = 0;
    std::int64_t last = -1;
    float worst = 0.0F;
    // Until it has been damaged three times, and has gone on.
    CHECK(eventually([&] {
        const Frame& frame = player.haptics().front().frames[0];
        if (!frame.depth || frame.index == last) return false;
        last = frame.index;
        ++frames;
        for (int j = 8; j < 232; j += 8)
            for (int i = 8; i < 150; i += 8)
                worst = std::max(worst, std::fabs(frame.depth->at(i, j) - 100.0F));
        return frames > 20 && lost >= lost_before + 3;
    }));
    CHECK(worst < 25.0F);
}
