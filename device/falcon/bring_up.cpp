// From an open port to a Falcon that answers (README.md: Probe, and the numbered steps of Upload).
#include "device/falcon/bring_up.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/firmware_image.hpp"

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;
using Bytes = std::span<const std::uint8_t>;

constexpr int kQuestions = 10;
constexpr milliseconds kAnswerLimit{30};
constexpr int kLastPackets = 5;         // README.md, Safety numbers
constexpr milliseconds kLastLimit{10};  // for each; a Falcon that runs answers within 2 ms

constexpr std::array<std::uint8_t, 3> kHello{0x0a, 0x43, 0x0d};
constexpr std::array<std::uint8_t, 4> kHelloAnswer{0x0a, 0x44, 0x2c, 0x0d};
constexpr std::array<std::uint8_t, 1> kAutobaud{'A'};

// README.md, Upload: where the numbers come from.
constexpr int kTries = 10;                   // try 2 to 10 has worked for people
constexpr int kMostSilent = 2;               // loaded and no reply: once more
constexpr int kHellos = 64;                  // libnifalcon up to 100, others 64
constexpr milliseconds kHelloLimit{100};     // for each try
constexpr milliseconds kAutobaudLimit{200};  // one byte at 7 us a bit, and the latency timer
constexpr milliseconds kEchoLimit{250};      // without a single byte of echo
constexpr milliseconds kListen{50};          // one read: the longest delay of a stop request

milliseconds left_until(Clock::time_point end) {
    return std::chrono::ceil<milliseconds>(end - Clock::now());
}

template <typename Action>
void ignore_errors(const Action& act) noexcept {
    try {
        act();
    } catch (const std::exception& failure) {
        // The caller knows of the loss already, or is ending.
        return;
    }
}

/// Six tries at the chosen speed, two at the other speed that is reported to work, and the last two
/// at speeds that nobody has tried.
FtdiRequest baud_of_try(int number, bool slower) {
    if (number <= 6) return slower ? kBaud140351 : kBaud142857;
    if (number <= 8) return slower ? kBaud142857 : kBaud140351;
    return number == 9 ? kBaud115200 : kBaud57600;
}

/// How one try ended.
enum class End { answers, stopped, no_hello, no_autobaud, echo, silent };

class Try {
  public:
    Try(FtdiPort& port, Bytes image, const UploadOptions& options, int number,
        const std::stop_token& stop)
        : port_(port),
          image_(image),
          options_(options),
          number_(number),
          baud_(baud_of_try(number, options.slower)),
          stop_(stop) {}

    End run() {
        prepare();
        if (!ended("hello", receives_hello())) return stopped() ? End::stopped : End::no_hello;
        if (!ended("autobaud", locked_on())) return stopped() ? End::stopped : End::no_autobaud;
        received_.clear();
        if (!ended("echo", all_echoed())) return stopped() ? End::stopped : End::echo;
        if (ended("answer", answers(port_, stop_))) return End::answers;  // step 6
        return stopped() ? End::stopped : End::silent;
    }

    [[nodiscard]] const std::string& echo_fault() const { return echo_fault_; }

  private:
    [[nodiscard]] bool stopped() const { return stop_.stop_requested(); }

    bool ended(const char* step, bool done) const {
        options_.on_step({number_, step, done, baud_, received_});
        return done;
    }

    /// Step 1. The rising edge of DTR starts the supervisor of the DSP.
    void prepare() {
        port_.purge();
        for (const FtdiRequest& request :
             {kNoEventCharacter, kLatencyUploading, kBaud9600, kEightBitsNoParity, kNoFlowControl,
              kRtsLow, kDtrLow, kDtrHigh}) {
            port_.request(request);
        }
    }

    /// Waits until `wanted` was received. Other bytes may come first: some hosts see a 00 before
    /// the hello, a 13 before the A.
    bool receives(Bytes wanted, milliseconds limit) {
        const auto end = Clock::now() + limit;
        while (!stopped()) {
            const auto found =
                std::search(received_.begin(), received_.end(), wanted.begin(), wanted.end());
            if (found != received_.end()) return true;
            const auto left = left_until(end);
            if (left <= milliseconds(0)) return false;
            const Bytes came = port_.read(std::min(left, kListen)).bytes;
            received_.insert(received_.end(), came.begin(), came.end());
        }
        return false;
    }

    /// Step 2.
    bool receives_hello() {
        for (int k = 0; k < kHellos && !stopped(); ++k) {
            port_.write(kHello);
            if (receives(kHelloAnswer, kHelloLimit)) return true;
        }
        return false;
    }

    /// Steps 3 and 4.
    bool locked_on() {
        port_.request(kDtrLow);
        port_.request(baud_);
        received_.clear();
        port_.write(kAutobaud);
        return receives(kAutobaud, kAutobaudLimit);
    }

    bool all_echoed() {
        for (std::size_t at = 0; at < image_.size(); at += kMostDataBytes) {
            if (!echoed(at)) return false;
            options_.on_progress(static_cast<double>(std::min(at + kMostDataBytes, image_.size())) /
                                     static_cast<double>(image_.size()),
                                 number_);
        }
        return true;
    }

    /// Step 5, one chunk. Its echo fills one IN packet, so the chip sends it at once.
    bool echoed(std::size_t at) {
        const Bytes chunk = image_.subspan(at, std::min(kMostDataBytes, image_.size() - at));
        port_.write(chunk);
        std::size_t checked = 0;
        auto last_came = Clock::now();
        while (checked < chunk.size() && !stopped()) {
            const Bytes came = port_.read(kListen).bytes;
            const Bytes expected = chunk.subspan(checked);
            const auto [differs, end] =
                std::mismatch(came.begin(), came.end(), expected.begin(), expected.end());
            checked += static_cast<std::size_t>(differs - came.begin());
            if (differs != came.end()) return fault("differs", at + checked);
            const auto now = Clock::now();
            if (!came.empty()) last_came = now;
            if (now - last_came > kEchoLimit) return fault("stopped", at + checked);
        }
        return checked == chunk.size();
    }

    bool fault(const char* what, std::size_t at) {
        echo_fault_ = std::string("echo ") + what + " at byte " + std::to_string(at);
        return false;
    }

    FtdiPort& port_;
    Bytes image_;
    const UploadOptions& options_;
    int number_;
    FtdiRequest baud_;
    const std::stop_token& stop_;
    std::vector<std::uint8_t> received_{};
    std::string echo_fault_{};
};

std::string sentence_of(End end, const std::string& echo_fault) {
    switch (end) {
        case End::no_hello:
            return "no hello (is the 30 V adapter plugged in?); plug the adapter into the Falcon, "
                   "or unplug it and the USB cable for ten seconds";
        case End::no_autobaud:
            return "autobaud (the boot loader does not answer); unplug the Falcon's power adapter "
                   "for ten seconds, then try another USB socket, with or without a hub";
        case End::silent:
            return "loaded, but does not answer; unplug the Falcon's power adapter for ten "
                   "seconds, or try another firmware file";
        default:
            return echo_fault +
                   "; unplug the Falcon's power adapter for ten seconds, then try "
                   "another USB socket, with or without a hub";
    }
}

}  // namespace

std::optional<Reply> request_reply(FtdiPort& port, const Command& command, milliseconds limit) {
    port.write(encode(command));
    ReplyStream stream;
    const auto end = Clock::now() + limit;
    for (auto left = limit; left > milliseconds(0); left = left_until(end)) {
        auto bytes = port.read(left).bytes;
        if (const auto reply = stream.add(bytes)) return reply;
    }
    return std::nullopt;
}

bool answers(FtdiPort& port, const std::stop_token& stop) {
    port.purge();
    port.request(kLatencyRunTime);
    port.request(kBaudRunTime);
    port.purge();
    for (int k = 0; k < kQuestions && !stop.stop_requested(); ++k) {
        if (request_reply(port, Command{}, kAnswerLimit)) return true;
    }
    return false;
}

void send_stop_packets(FtdiPort& port) noexcept {
    for (int k = 0; k < kLastPackets; ++k) {
        ignore_errors([&] {
            port.write(encode(no_force(Led::off)), kLastLimit);
            (void)port.read(kLastLimit);
        });
    }
    ignore_errors([&] { port.request(kNoEventCharacter); });
}

StopPacket stop_packet() noexcept {
    StopPacket last{.channel = StopPacket::Channel::usb, .endpoint = kOutEndpoint};
    last.set_message(encode(no_force(Led::off)));
    return last;
}

bool upload(FtdiPort& port, Bytes image, const UploadOptions& options,
            const std::stop_token& stop) {
    if (const std::string fault = fault_of_firmware(image); !fault.empty()) {
        throw UploadError("no firmware was sent to " + full_name_of(port.falcon()) +
                          ", because the file is not firmware: " + fault + "; " +
                          where_firmware_comes_from());
    }
    int silent = 0;
    for (int number = 1;; ++number) {
        options.on_progress(0.0, number);
        Try load(port, image, options, number, stop);
        const End end = load.run();
        if (end == End::answers) return true;
        if (end == End::stopped) return false;
        silent += end == End::silent ? 1 : 0;
        // Without a hello there is no second try: one try has sent 64 of them.
        if (end != End::no_hello && silent < kMostSilent && number < kTries) continue;
        throw UploadError("the firmware did not get into " + full_name_of(port.falcon()) + " (" +
                          (number == 1 ? "first try" : std::to_string(number) + " tries") +
                          "): " + sentence_of(end, load.echo_fault()));
    }
}

BroughtUp bring_up(FtdiPort& port, const FirmwareImage& firmware, const UploadOptions& options,
                   const std::stop_token& stop) {
    if (answers(port, stop)) return BroughtUp::answers;
    if (stop.stop_requested()) return BroughtUp::stopped;
    if (firmware.empty()) return BroughtUp::no_firmware;
    return upload(port, firmware.bytes, options, stop) ? BroughtUp::answers : BroughtUp::stopped;
}

std::string missing_firmware_advice(const AttachedFalcon& falcon) {
    return full_name_of(falcon) +
           " does not answer: check its power adapter; if that is in, it has no firmware: " +
           where_firmware_comes_from();
}

}  // namespace dibhr::falcon
