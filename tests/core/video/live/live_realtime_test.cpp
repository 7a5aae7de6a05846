// What a person is promised of live depth, by the machine's clock, from the sender to the hand: run
// alone. The same by a time that the test makes: live_playback_test.cpp.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/live/live_bench.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Clock = std::chrono::steady_clock;

namespace {

constexpr std::size_t kFlashes = 7;

double seconds_since(LiveTime time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
}

/// Pictures that flash, and when each flash was sent.
class Flashes {
  public:
    [[nodiscard]] PictureSender::Asked asked() {
        PictureSender::Asked asked = flashing();
        asked.sent = [this](int k, Clock::time_point when) {
            if (k % 20 != 10) return;
            const std::lock_guard lock(mutex_);
            last_ = when;
            ++count_;
        };
        return asked;
    }
    /// How long after its sending each is felt to nine tenths (`high_level`), the shortest first.
    [[nodiscard]] std::vector<double> delays_s(Player& player, double high_level) {
        std::vector<double> delays;
        int felt = count();
        const int first = felt + 2;  // the surface has its pace
        bool was_high = true;
        CHECK(eventually([&] {
            for (int looks = 0; looks < 10; ++looks) {
                const auto now = Clock::now();
                const auto level = felt_level(player.haptics().front(), now);
                const bool high = level && *level >= high_level;
                if (high && !was_high && count() > felt) {
                    felt = count();
                    if (felt >= first) delays.push_back(seconds_since(last()));
                }
                was_high = high;
                std::this_thread::sleep_for(std::chrono::microseconds(200));
            }
            return delays.size() >= kFlashes;
        }));
        std::sort(delays.begin(), delays.end());
        return delays;
    }

  private:
    [[nodiscard]] int count() {
        const std::lock_guard lock(mutex_);
        return count_;
    }
    [[nodiscard]] LiveTime last() {
        const std::lock_guard lock(mutex_);
        return last_;
    }

    std::mutex mutex_{};
    LiveTime last_{};
    int count_{0};
};

}  // namespace

TEST_CASE("a step in the depth is felt two frames and 10 ms after it is sent, by the clock, too",
          "[live][realtime]") {
    Flashes flashes;
    const int port = free_port();
    PictureSender::Asked asked = flashes.asked();
    asked.late = [](int k) { return std::chrono::milliseconds(k * 7 % 12); };
    const PictureSender sender(port, asked);
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(PictureSender::url(port), {}, as_sent()), 1);
    const auto delays = flashes.delays_s(player, 37000.0);
    REQUIRE(delays.size() == kFlashes);
    const double said_s = player.status().live->behind_s;
    INFO("felt after " << 1000.0 * delays.front() << " to " << 1000.0 * delays.back()
                       << " ms, the median after " << 1000.0 * delays[kFlashes / 2]
                       << "; said: " << 1000.0 * said_s << " ms");
    CHECK(delays[kFlashes / 2] <= 2.0 * kLiveInterval_s + 0.010);
    CHECK_THAT(said_s, WithinAbs(delays[kFlashes / 2], 0.020));
}

TEST_CASE("through ffmpeg, H.264 and MPEG-TS over UDP a step is felt as soon", "[live][realtime]") {
    Flashes flashes;
    const int raw = free_port();
    const int coded = free_port();
    const PictureSender camera(raw, flashes.asked());
    const Ffmpeg sender(
        "-fflags nobuffer -flags low_delay -probesize 32 -analyzeduration 0 -i " +
        PictureSender::url(raw) +
        " -fps_mode passthrough -c:v libx264 -preset ultrafast -tune zerolatency "
        "-g 15 -pix_fmt yuvj420p -omit_video_pes_length 0 -muxdelay 0 -muxpreload 0 "
        "-flush_packets 1 -f mpegts 'udp://127.0.0.1:" +
        std::to_string(coded) + "?pkt_size=1316'");
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    const std::string url = "udp://127.0.0.1:" + std::to_string(coded);
    player.play_media(open_media(url, {}, as_sent(255.0)), 1);
    const auto delays = flashes.delays_s(player, 37000.0 / 257.0);
    REQUIRE(delays.size() == kFlashes);
    INFO("felt after " << 1000.0 * delays.front() << " to " << 1000.0 * delays.back()
                       << " ms, the median after " << 1000.0 * delays[kFlashes / 2]);
    CHECK(delays[kFlashes / 2] <= 2.0 * kLiveInterval_s + 0.010);
}

TEST_CASE("a signal that is lost is noticed in 210 ms, by the clock, too", "[live][realtime]") {
    const int port = free_port();
    std::atomic<LiveTime> last_sent{Clock::now()};
    PictureSender::Asked asked = flat([](int k) { return 20000 + 800 * (k % 20); });
    asked.sent = [&](int, Clock::time_point when) { last_sent = when; };
    PictureSender sender(port, asked);
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(PictureSender::url(port), {}, as_sent()), 1);
    REQUIRE(eventually([&] { return player.haptics().front().count > 2; }));
    sender.stop();
    while (!player.haptics().front().silent && seconds_since(last_sent) < 60.0)
        std::this_thread::yield();
    CHECK(seconds_since(last_sent) < 0.210);  // and 40 ms later the loop sends none
}

namespace {

/// Standard input is that pipe while it lives.
class PipedInput {
  public:
    explicit PipedInput(const std::string& fifo) {
        const int pipe = ::open(fifo.c_str(), O_RDONLY | O_CLOEXEC);
        ::dup2(pipe, STDIN_FILENO);
        ::close(pipe);
    }
    ~PipedInput() {
        ::dup2(kept_, STDIN_FILENO);
        ::close(kept_);
    }
    PipedInput(const PipedInput&) = delete;
    PipedInput& operator=(const PipedInput&) = delete;

  private:
    int kept_{::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)};
};

/// The pictures are held while their sender pauses, that is told, and they go on by themselves.
void require_back_after_pause(Ffmpeg& sender, const std::string& from, double pause_s) {
    Player player;
    player.set_cleaning({.preset = CleaningPreset::raw});
    player.play_media(open_media(from, {}, as_sent(255.0)), 1);
    REQUIRE(eventually([&] { return player.haptics().front().count > 1; }));
    sender.stop();
    REQUIRE(eventually([&] { return player.status().live->silent_s > pause_s; }));
    CHECK(player.haptics().front().count > 0);
    CHECK(contains(in_words(*player.status().live), "No signal"));
    sender.go_on();
    CHECK(eventually([&] { return player.status().live->signal; }));
}

}  // namespace

TEST_CASE("a sender that pauses is held, told and seen again by itself, whatever the transport",
          "[live][realtime]") {
    const std::string port = std::to_string(free_port());
    const TemporaryFolder folder;
    const std::string fifo = (folder / "depth").string();
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    struct Way {
        std::string to, from;
    };
    // A sender that listens, or writes into a pipe, ends when nobody reads any more.
    const std::vector<Way> ways{
        {"-f nut 'tcp://127.0.0.1:" + port + "?listen'", "tcp://127.0.0.1:" + port},
        {"-f mpegts -listen 1 http://127.0.0.1:" + port, "http://127.0.0.1:" + port},
        {"-f mpegts 'udp://127.0.0.1:" + port + "?pkt_size=1316'", "udp://127.0.0.1:" + port},
        {"-f rtp_mpegts rtp://127.0.0.1:" + port, "rtp://127.0.0.1:" + port},
        {"-f mpegts 'srt://127.0.0.1:" + port + "?mode=listener'", "srt://127.0.0.1:" + port},
        {"-f matroska '" + fifo + "'", "pipe:" + fifo},
        {"-f nut '" + fifo + "'", "-"}};
    const Way& way = ways[GENERATE(range<std::size_t>(0, 7))];
    CAPTURE(way.from);
    Ffmpeg sender(
        "-re -f lavfi -i testsrc2=s=96x64:r=30,format=gray,boxblur=4 -c:v libx264 -preset "
        "ultrafast -tune zerolatency -g 30 -pix_fmt yuvj420p " +
        way.to);
    if (contains(way.to, "listen")) REQUIRE(comes_to_listen(std::stoi(port)));
    std::optional<PipedInput> input;
    if (way.from == "-") input.emplace(fifo);
    require_back_after_pause(sender, way.from, 2.5);
}

TEST_CASE("a stream that is met behind its key frame is waited for, and then asked for another",
          "[live][realtime]") {
    const int from = free_port();
    const int to = free_port();
    const std::string url = "udp://127.0.0.1:" + std::to_string(to);
    std::atomic<int> datagrams{0};
    const Relay relay(from, to, [&](int) { return ++datagrams > 50 ? 0 : -1; });
    const Ffmpeg sender(
        "-re -f lavfi -i testsrc2=s=96x64:r=30 -c:v libx264 -preset ultrafast -tune zerolatency "
        "-g 9999 -f mpegts udp://127.0.0.1:" +
        std::to_string(from));
    REQUIRE(eventually([&] { return datagrams > 50; }));  // the key frame has passed
    const auto begin = Clock::now();
    const std::string why = refusal([&] { static_cast<void>(open_media(url, {}, as_sent())); });
    CHECK(contains(why, "no whole key frame has come yet"));
    CHECK(contains(why, "-g 30"));
    CHECK(seconds_since(begin) > 10.0);  // encoders send one in 8.3 s unless told else
}

TEST_CASE("two streams that are really sent are joined by their times, whatever their clocks say",
          "[live][realtime]") {
    const bool own_clock = GENERATE(true, false);
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
    const auto media = open_media(url(colour), url(depth), as_sent(255.0));
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
