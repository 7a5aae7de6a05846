// Step 3: how many replies a second, and how long one takes, with and without the event character
// (../README.md, Reply rate).
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "device/falcon/check/steps.hpp"
#include "device/falcon/check/vendor_reads.hpp"

namespace dibhr::falcon {

namespace {

struct Setting {
    const char* name;
    FtdiRequest latency;
    bool event_character;
};

// With a latency of 16 ms only the event character can bring a reply sooner.
constexpr Setting kPlain{"latency_1_ms", kLatencyRunTime, false};
constexpr Setting kEvent{"latency_1_ms_event_character", kLatencyRunTime, true};
constexpr Setting kEventAlone{"latency_16_ms_event_character", kLatencyUploading, true};

// A reply takes two frames of 1 ms at most where the chip sends it at once, else up to 16 ms.
constexpr double kAtOnce_ms = 4.0;
constexpr double kNoticeable_ms = 0.2;

struct Rate {
    double replies_per_s{0.0};
    double median_ms{0.0};
    double p99_ms{0.0};
};

double quantile(std::vector<double>& values, double part) {
    if (values.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

Rate measure(CheckDesk& desk, const Setting& setting, Measured& measured) {
    FtdiPort& port = desk.falcon.port();
    port.request(setting.latency);
    const int latency_ms = read_latency_timer(port);
    desk.falcon.use_event_character(setting.event_character);
    CheckTalk& talk = desk.falcon.talk();

    const Command nothing{.motor = {}, .led = Led::red, .homing = true};
    std::vector<double> round_trips_ms;
    int missing = 0;
    const auto begin = CheckTalk::Clock::now();
    const auto end = begin + desk.options.times.rate;
    while (CheckTalk::Clock::now() < end) {
        desk.quit_if_interrupted();
        const auto heard = talk.exchange(nothing);
        missing += heard ? 0 : 1;
        if (!heard) continue;
        round_trips_ms.push_back(
            std::chrono::duration<double, std::milli>(heard->round_trip).count());
    }
    const std::chrono::duration<double> took = CheckTalk::Clock::now() - begin;
    const LinkCounts counts = talk.counts();
    const Rate rate{static_cast<double>(round_trips_ms.size()) / took.count(),
                    quantile(round_trips_ms, 0.5), quantile(round_trips_ms, 0.99)};
    Measured part;
    part.add("seconds", took.count())
        .add("latency_timer_ms_read_back", latency_ms)
        .add("event_character", setting.event_character)
        .add("replies", static_cast<std::uint64_t>(round_trips_ms.size()))
        .add("replies_per_s", rate.replies_per_s)
        .add("round_trip_ms_p50", rate.median_ms)
        .add("round_trip_ms_p99", rate.p99_ms)
        .add("round_trip_ms_max", quantile(round_trips_ms, 1.0))
        .add("no_reply_within_20_ms", missing)
        .add("commands_resent", counts.resent)
        .add("line_errors", counts.line_errors)
        .add("bytes_discarded", counts.bytes_discarded);
    measured.add(setting.name, part);
    return rate;
}

std::string in_words(const Rate& rate) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(0) << rate.replies_per_s << " a second (half within "
         << std::setprecision(2) << rate.median_ms << " ms, 99 % within " << rate.p99_ms << " ms)";
    return text.str();
}

}  // namespace

void check_rate(CheckDesk& desk, Measured& measured) {
    const Rate plain = measure(desk, kPlain, measured);
    desk.guide.say("without the event character: " + in_words(plain));
    const Rate event = measure(desk, kEvent, measured);
    desk.guide.say("with the event character: " + in_words(event));
    const Rate alone = measure(desk, kEventAlone, measured);
    desk.falcon.port().request(kLatencyRunTime);

    const bool works = alone.replies_per_s > 0.0 && alone.median_ms < kAtOnce_ms;
    const bool helps = works && event.median_ms < plain.median_ms + kNoticeable_ms;
    desk.findings.settle(OpenQuestion::reply_rate,
                         in_words(plain) + "; with the event character " + in_words(event));
    desk.findings.settle(
        OpenQuestion::event_character,
        std::string(works ? "the chip sends at once" : "the chip still waits for its timer") +
            ": with a latency of 16 ms " + in_words(alone));
    desk.findings.set("event-character", helps ? "true" : "false");
    desk.falcon.use_event_character(helps);
}

}  // namespace dibhr::falcon
