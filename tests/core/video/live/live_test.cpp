// What comes as it happens: opened, joined, shown a frame behind, held when it stops.
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/live/motion_budget.hpp"
#include "core/video/media.hpp"
#include "core/video/player.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

namespace {

constexpr double kInterval_s = 1.0 / 30.0;

double seconds(Clock::duration time) {
    return std::chrono::duration<double>(time).count();
}

template <typename Condition>
bool soon(Condition condition, double within_s = 15.0) {
    const auto latest = Clock::now() + std::chrono::duration<double>(within_s);
    while (!condition()) {
        if (Clock::now() > latest) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

/// Levels as they are sent, of which 65535 is the highest.
DepthRequest as_sent() {
    DepthRequest request{.find_out = true};
    request.command_line.unit = DepthUnit::levels;
    request.command_line.near = NearLevels::bright;
    request.command_line.range = DepthRange{65535.0, 0.0};
    request.command_line.no_data = std::vector<double>{};
    request.command_line.packing = DepthPacking::separate;
    return request;
}

/// Something to be seen as depth, and one level all over that `flash` says.
PictureSender::Asked flashing(std::function<bool(int)> flash) {
    PictureSender::Asked asked;
    asked.level = [flash = std::move(flash)](int k, int, int) {
        return static_cast<std::uint16_t>(flash(k) ? 40000 : 10000);
    };
    return asked;
}

/// As the haptic loop reads it.
std::optional<double> felt_level(const FrameWindow& window, Clock::time_point now) {
    const DepthBlend blend = window.at(window.clock.playback_s(now));
    if (!blend.makes_surface()) return std::nullopt;
    const double from = static_cast<double>(blend.from->depth->at(80, 60));
    const double to = static_cast<double>(blend.to->depth->at(80, 60));
    return from + blend.blend * (to - from);
}

void play(Player& player, const std::string& url) {
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(url, {}, as_sent()), 1);
    REQUIRE(soon([&] { return player.haptics().front().count > 1; }));
}

/// How long after its sending a flash is felt to nine tenths (`high_level`), each.
std::vector<double> delays_s(Player& player, int flashes, double high_level,
                             const std::atomic<int>& number,
                             const std::function<Clock::time_point(int)>& sent) {
    std::vector<double> delays;
    int seen = number;
    bool was_high = true;
    const auto latest = Clock::now() + std::chrono::seconds(30);
    while (static_cast<int>(delays.size()) < flashes && Clock::now() < latest) {
        const auto now = Clock::now();
        const auto level = felt_level(player.haptics().front(), now);
        const bool high = level && *level >= high_level;
        if (high && !was_high && number > seen) {
            seen = number;
            delays.push_back(seconds(now - sent(seen)));
        }
        was_high = high;
        std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    std::sort(delays.begin(), delays.end());
    return delays;
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
    CHECK(why.find("start what sends") != std::string::npos);
    CHECK(why.find('\n') == std::string::npos);
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
        {"udp://", "lacks a port"},
        {"udp://127.0.0.1?pkt_size=1316", "lacks a port"},
        {"rtp://127.0.0.1:99999", "1 to 65535"},
        {"rtsp://camera:0/depth", "1 to 65535"},
        {"tcp://[::1]", "lacks a port"},
        {"lavfi:nosuch", "libav can make"},
        {"tcp://nosuchhost.invalid:5000", "host is not found"},
        {"pipe:" + fifo, "holds no video"}};
    for (const auto& [name, words] : wrong) {
        CAPTURE(name);
        const auto begin = Clock::now();
        const std::string why =
            refusal([&, &one = name] { static_cast<void>(open_media(one, {}, as_sent())); });
        CHECK(contains(why, words));
        CHECK(contains(why, name));
        CHECK(seconds(Clock::now() - begin) < 4.0);
    }
    for (const char* const name : {"udp://@239.0.0.1:5000", "tcp://[::1]:5000?listen",
                                   "rtsp://me:secret@camera/depth", "udp://127.0.0.1:5000?a=b/c"})
        CHECK_NOTHROW(live_name(name));
}

TEST_CASE("a stream is seen from its first key frame on, however seldom one comes", "[live]") {
    const std::string port = std::to_string(free_port());
    const TemporaryFolder folder;
    const std::string fifo = (folder / "depth").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const std::vector<std::pair<std::string, std::string>> ways{
        {"-t 2 -f nut '" + fifo + "'", "pipe:" + fifo},  // shorter than from key frame to key frame
        {"-f mpegts 'tcp://127.0.0.1:" + port + "?listen'", "tcp://127.0.0.1:" + port}};
    const auto& [to, from] = ways[GENERATE(some_of<std::size_t>({0, 1}, 2))];
    CAPTURE(from);
    const Ffmpeg sender(
        "-re -f lavfi -i testsrc2=s=96x64:r=30,format=gray,boxblur=4 -c:v libx264 -preset "
        "ultrafast -tune zerolatency -g 250 -pix_fmt yuvj420p " +
        to);
    const auto begin = Clock::now();
    const auto media = open_media(from, {}, as_sent());
    CHECK(media->next());
    CHECK(seconds(Clock::now() - begin) < 5.0);
}

TEST_CASE("a stream that is met behind its key frame is waited for, and then asked for another",
          "[live]") {
    const std::string url = "udp://127.0.0.1:" + std::to_string(free_port());
    const Ffmpeg sender(
        "-re -f lavfi -i testsrc2=s=96x64:r=30 -c:v libx264 -preset ultrafast -tune zerolatency "
        "-g 9999 -f mpegts " +
        url);
    std::this_thread::sleep_for(milliseconds(1500));
    const auto begin = Clock::now();
    const std::string why = refusal([&] { static_cast<void>(open_media(url, {}, as_sent())); });
    CHECK(contains(why, "no whole key frame has come yet"));
    CHECK(contains(why, "-g 30"));
    CHECK(seconds(Clock::now() - begin) > 10.0);  // encoders send one in 8.3 s unless told else
}

TEST_CASE("streams open by whatever protocol they come, and from a pipe", "[live]") {
    const std::string port = std::to_string(free_port());
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

TEST_CASE("a step in the depth is felt two frames and 10 ms after it is sent, at most", "[live]") {
    const int uneven_ms = GENERATE(some_of<int>({12, 0}, 1));
    CAPTURE(uneven_ms);
    const int port = free_port();
    std::mutex mutex;
    std::vector<Clock::time_point> sent;
    std::atomic<int> number{0};
    PictureSender::Asked asked = flashing([](int k) { return k % 20 >= 10; });
    asked.late = [uneven_ms](int k) { return milliseconds(uneven_ms > 0 ? k * 7 % uneven_ms : 0); };
    asked.sent = [&](int k, Clock::time_point when) {
        if (k % 20 != 10) return;
        const std::lock_guard lock(mutex);
        sent.push_back(when);
        number = static_cast<int>(sent.size());
    };
    const PictureSender sender(port, asked);
    Player player;
    play(player, PictureSender::url(port));
    std::this_thread::sleep_for(milliseconds(1500));
    const auto delays = delays_s(player, 7, 37000.0, number, [&](int n) {
        const std::lock_guard lock(mutex);
        return sent[static_cast<std::size_t>(n) - 1];
    });
    REQUIRE(delays.size() == 7);
    const double said_s = player.status().live->behind_s;
    INFO("uneven by up to " << uneven_ms << " ms: felt after " << 1000.0 * delays.front() << " to "
                            << 1000.0 * delays.back() << " ms, the median after "
                            << 1000.0 * delays[3] << "; said: " << 1000.0 * said_s << " ms");
    if (!DIBHR_SANITIZED) CHECK(delays[3] <= 2.0 * kInterval_s + 0.010);
    CHECK(delays[3] >= 0.5 * kInterval_s);
    CHECK_THAT(said_s, WithinAbs(delays[3], 0.020));
}

TEST_CASE(
    "through ffmpeg, H.264 and MPEG-TS over UDP a step is felt two frames and 10 ms later, too",
    "[live]") {
    const int raw = free_port();
    const int coded = free_port();
    std::mutex mutex;
    std::vector<Clock::time_point> sent;
    std::atomic<int> number{0};
    PictureSender::Asked asked = flashing([](int k) { return k % 20 >= 10; });
    asked.sent = [&](int k, Clock::time_point when) {
        if (k % 20 != 10) return;
        const std::lock_guard lock(mutex);
        sent.push_back(when);
        number = static_cast<int>(sent.size());
    };
    const PictureSender camera(raw, asked);
    const Ffmpeg sender(
        "-fflags nobuffer -flags low_delay -probesize 32 -analyzeduration 0 -i " +
        PictureSender::url(raw) +
        " -fps_mode passthrough -c:v libx264 -preset ultrafast -tune zerolatency "
        "-g 15 -pix_fmt yuvj420p -omit_video_pes_length 0 -muxdelay 0 -muxpreload 0 "
        "-flush_packets 1 -f mpegts 'udp://127.0.0.1:" +
        std::to_string(coded) + "?pkt_size=1316'");
    DepthRequest request = as_sent();
    request.command_line.range = DepthRange{255.0, 0.0};
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media("udp://127.0.0.1:" + std::to_string(coded), {}, request), 1);
    REQUIRE(soon([&] { return player.haptics().front().count > 1; }));
    std::this_thread::sleep_for(milliseconds(1500));
    const auto delays = delays_s(player, 7, 37000.0 / 257.0, number, [&](int n) {
        const std::lock_guard lock(mutex);
        return sent[static_cast<std::size_t>(n) - 1];
    });
    REQUIRE(delays.size() == 7);
    INFO("felt after " << 1000.0 * delays.front() << " to " << 1000.0 * delays.back()
                       << " ms, the median after " << 1000.0 * delays[3]);
    if (!DIBHR_SANITIZED) CHECK(delays[3] <= 2.0 * kInterval_s + 0.010);
}

TEST_CASE("frames that come unevenly are shown in even time, and time never goes back", "[live]") {
    const int port = free_port();
    PictureSender::Asked asked;
    asked.level = [](int k, int, int) { return static_cast<std::uint16_t>(100 * k); };
    asked.late = [](int k) { return milliseconds(k * 11 % 15); };
    asked.clock_rate = 1.002;  // two thousandths too quick
    const PictureSender sender(port, asked);
    Player player;
    play(player, PictureSender::url(port));
    std::this_thread::sleep_for(milliseconds(1500));
    std::vector<double> levels;
    const auto begin = Clock::now();
    while (Clock::now() < begin + std::chrono::seconds(4)) {
        levels.push_back(*felt_level(player.haptics().front(), Clock::now()));
        std::this_thread::sleep_for(milliseconds(1));
    }
    const double per_s = (levels.back() - levels.front()) / seconds(Clock::now() - begin);
    CHECK(std::is_sorted(levels.begin(), levels.end()));
    CHECK_THAT(per_s, WithinAbs(3000.0, 60.0));
    double most = 0.0;
    for (std::size_t k = 1; k < levels.size(); ++k)
        most = std::max(most, levels[k] - levels[k - 1]);
    CHECK(most < 100.0);  // less than a frame at once
    CHECK(player.status().live->dropped <= 3);
}

TEST_CASE("a signal that is lost while it moves takes the force off within 300 ms", "[live]") {
    const bool moves = GENERATE(true, false);
    CAPTURE(moves);
    const int port = free_port();
    PictureSender::Asked asked;
    std::atomic<Clock::time_point> last_sent{Clock::now()};
    asked.level = [moves](int k, int, int) {
        return static_cast<std::uint16_t>(moves ? 20000 + 800 * (k % 20) : 20000);
    };
    asked.sent = [&](int, Clock::time_point when) { last_sent = when; };
    PictureSender sender(port, asked);
    Player player;
    play(player, PictureSender::url(port));
    std::this_thread::sleep_for(milliseconds(300));
    const std::uint64_t before = player.haptics().front().discontinuity;
    CHECK_FALSE(player.haptics().front().silent);
    sender.stop();
    REQUIRE(soon([&] { return !player.status().live->signal; }));
    const double noticed_s = seconds(Clock::now() - last_sent.load());
    if (!DIBHR_SANITIZED)
        CHECK(noticed_s < 0.250);  // and 40 ms later the loop sends none: SafetyStage::kFade_s
    CHECK(player.haptics().front().silent == moves);
    CHECK(player.status().live->force_off == moves);
    const FrameWindow held = player.haptics().front();
    REQUIRE(held.count > 0);
    const auto level = felt_level(held, Clock::now());
    std::this_thread::sleep_for(milliseconds(400));
    CHECK(felt_level(player.haptics().front(), Clock::now()) == level);
    CHECK(in_words(*player.status().live).find("No signal from") == 0);
    sender.go_on();
    REQUIRE(soon([&] { return player.status().live->signal; }));
    CHECK_FALSE(player.haptics().front().silent);
    CHECK(player.haptics().front().discontinuity > before);  // by which the force ramps
}

TEST_CASE("a sender that is started again is met again by itself; of another size it is said",
          "[live]") {
    const int port = free_port();
    auto sender = std::make_unique<PictureSender>(port, flashing([](int k) { return k % 2 == 0; }));
    Player player;
    play(player, PictureSender::url(port));
    sender.reset();
    REQUIRE(soon([&] { return !player.status().live->signal; }));
    sender = std::make_unique<PictureSender>(port, flashing([](int k) { return k % 2 == 0; }));
    REQUIRE(soon([&] { return player.status().live->signal; }));
    CHECK_FALSE(player.status().live->other_form);
    sender.reset();
    PictureSender::Asked other = flashing([](int k) { return k % 2 == 0; });
    other.columns = 200;
    sender = std::make_unique<PictureSender>(port, other);
    REQUIRE(soon([&] { return player.status().live->other_form; }));
    CHECK(player.haptics().front().frames[0].depth->columns == 160);  // held
    Player again;
    play(again, PictureSender::url(port));
    CHECK(again.haptics().front().frames[0].depth->columns == 200);
}

TEST_CASE("what is live is held by a pause, and goes on with what comes then", "[live]") {
    const int port = free_port();
    PictureSender::Asked asked;
    asked.level = [](int k, int, int) { return static_cast<std::uint16_t>(100 * k); };
    const PictureSender sender(port, asked);
    Player player;
    play(player, PictureSender::url(port));
    player.pause();
    REQUIRE(soon([&] { return !(player.haptics().front().clock.speed > 0.0); }));
    const auto held = felt_level(player.haptics().front(), Clock::now());
    std::this_thread::sleep_for(milliseconds(400));
    CHECK(felt_level(player.haptics().front(), Clock::now()) == held);
    CHECK(player.status().live->signal);
    player.play();
    REQUIRE(soon([&] {
        return felt_level(player.haptics().front(), Clock::now()).value_or(0.0) > *held + 1000.0;
    }));
}

TEST_CASE("two streams are joined by their times, whatever their clocks say", "[live]") {
    const bool own_clock = GENERATE(some_of<int>({1, 0}, 1)) == 1;
    CAPTURE(own_clock);
    const int colour = free_port();
    const int depth = free_port();
    const auto url = [](int port) { return "udp://127.0.0.1:" + std::to_string(port); };
    const std::string coded =
        " -c:v libx264 -preset ultrafast -tune zerolatency -crf 1 -g 10 "
        "-pix_fmt yuvj420p ";
    const Ffmpeg sender(
        "-re -f lavfi -i color=black:s=96x64:r=30 "
        "-filter_complex \"format=gray,geq=lum='mod(8*N\\,200)+20',"
        "split[a][b]\" -map \"[a]\"" +
        coded + "-f mpegts '" + url(colour) + "?pkt_size=1316' " + "-map \"[b]\"" + coded +
        (own_clock ? "-output_ts_offset 500 " : "") + "-f mpegts '" + url(depth) +
        "?pkt_size=1316'");
    DepthRequest request = as_sent();
    request.command_line.range = DepthRange{255.0, 0.0};
    const auto media = open_media(url(colour), url(depth), request);
    int apart = 0;
    constexpr int kFrames = 40;
    for (int k = 0; k < kFrames; ++k) {
        const auto frame = media->next();
        REQUIRE(frame);
        const int level = static_cast<int>(std::lround(frame->depth.at(40, 30)));
        const int shade = frame->colour.rgb[3 * (30 * 96 + 40)];
        if (std::abs(level - shade) > 4) ++apart;  // a frame is 8 levels
    }
    CHECK(apart <= 2);
}

TEST_CASE("packets that are lost or late leave out frames, and never show damage", "[live]") {
    const int from = free_port();
    const int to = free_port();
    const Relay relay(from, to, [](int n) { return n % 400 == 200 ? -1 : n % 350 == 0 ? 30 : 2; });
    // Half of the picture is flat: any other level there is damage.
    const Ffmpeg sender(
        "-re -f lavfi -i "
        "\"testsrc2=s=320x240:r=30,format=gray,geq=lum='if(lt(X\\,160)\\,100\\,lum(X"
        "\\,Y))'\" -c:v libx264 -preset ultrafast -tune zerolatency -b:v 3M -g 10 -pix_fmt "
        "yuvj420p "
        "-f mpegts 'udp://127.0.0.1:" +
        std::to_string(from) + "?pkt_size=1316'");
    DepthRequest request = as_sent();
    request.command_line.range = DepthRange{255.0, 0.0};
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media("udp://127.0.0.1:" + std::to_string(to), {}, request), 1);
    REQUIRE(soon([&] { return player.haptics().front().count > 1; }));
    std::int64_t frames = 0;
    std::int64_t last = -1;
    float worst = 0.0F;
    const auto begin = Clock::now();
    while (Clock::now() < begin + std::chrono::seconds(5)) {
        const Frame& frame = player.haptics().front().frames[0];
        if (frame.depth && frame.index != last) {
            last = frame.index;
            ++frames;
            for (int j = 8; j < 232; j += 8)
                for (int i = 8; i < 150; i += 8)
                    worst = std::max(worst, std::fabs(frame.depth->at(i, j) - 100.0F));
        }
        std::this_thread::sleep_for(milliseconds(2));
    }
    CHECK(frames > 20);
    CHECK(worst < 25.0F);
}

TEST_CASE("how live frames move is known as they come, where it is wanted", "[live]") {
    // Beside its depth, a texture that goes 3 px to the right from frame to frame.
    const std::string scene =
        "lavfi:nullsrc=size=160x120:rate=30,format=gray,geq='128+50*sin(0.31*(X-3*N))*cos(0.23*Y)"
        "+40*sin(0.13*Y+0.17*(X-3*N))',format=yuv444p[a];color=gray:size=160x120:rate=30,"
        "format=yuv444p[b];[a][b]hstack";
    DepthRequest request = as_sent();
    request.command_line.range = DepthRange{255.0, 0.0};
    request.command_line.packing = DepthPacking::left_right;
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(scene, {}, request), 1);
    REQUIRE(soon([&] { return player.haptics().front().count > 1; }));
    CHECK(player.haptics().front().frames[0].motion == nullptr);  // nobody asked for it
    player.set_motion({.motion = true});
    REQUIRE(soon([&] {
        const FrameWindow& window = player.haptics().front();
        return window.count > 1 && window.frames[0].motion != nullptr;
    }));
    const Frame moving = player.haptics().front().frames[0];
    std::vector<float> rights;
    for (int j = 20; j < 100; j += 4)
        for (int i = 20; i < 140; i += 4) {
            rights.push_back(moving.motion->at(i, j).right);
        }
    std::sort(rights.begin(), rights.end());
    CHECK_THAT(static_cast<double>(rights[rights.size() / 2]), WithinAbs(3.0, 0.1));
    CHECK(moving.between == nullptr);
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.set_motion({.in_betweens = true});
    CHECK(soon([&] {
        const FrameWindow& window = player.haptics().front();
        return window.count > 1 && window.frames[0].between != nullptr;
    }));
    const auto live = player.status().live;
    REQUIRE(live);
    CHECK_FALSE(live->motion_rests);
}

TEST_CASE("where there is no time for motion in-betweens rest first, then all of it, and longer",
          "[live]") {
    constexpr MotionWanted kAll{true, true};
    MotionBudget budget;
    const auto frames_until = [&](const MotionWanted& wanted, double busy_s, auto changed) {
        for (int k = 0; k < 10'000; ++k) {
            const MotionWanted done = budget.affordable(wanted);
            if (changed(done)) return k;
            budget.took(done, busy_s, kInterval_s);
        }
        return -1;
    };
    const auto less = [&](const MotionWanted& done) { return !(done == kAll); };
    const auto none = [](const MotionWanted& done) { return !done.any(); };
    const auto all = [&](const MotionWanted& done) { return done == kAll; };
    CHECK(frames_until(kAll, 0.5 * kInterval_s, less) == -1);  // there is time
    const int begin = frames_until(kAll, 2.0 * kInterval_s, less);
    CHECK(begin > 0);
    CHECK(begin < 10);
    CHECK(budget.rests().in_betweens());
    CHECK_FALSE(budget.rests().motion());  // it may fit alone
    CHECK(frames_until(kAll, 2.0 * kInterval_s, none) < 10);
    CHECK(budget.rests().motion());
    const int first = frames_until(kAll, 0.5 * kInterval_s, all);
    REQUIRE(first > 30);
    CHECK(frames_until(kAll, 2.0 * kInterval_s, none) < 20);
    CHECK(frames_until(kAll, 0.5 * kInterval_s, all) > first);
    CHECK(frames_until(kAll, 0.5 * kInterval_s, less) == -1);
}
