// Step 3: how many replies a second, and how long one takes, with and without the event character
// (../README.md, Reply rate).
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "device/falcon/check/desk.hpp"

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

Rate measure(CheckDesk& desk, const Setting& setting, Json& measured) {
    FtdiPort& port = desk.falcon.port();
    port.request(setting.latency);
    std::array<std::uint8_t, 1> latency_ms{};
    port.ask(kReadLatencyTimer, latency_ms);
    desk.falcon.use_event_character(setting.event_character);

    std::vector<double> round_trips_ms;
    int missing = 0;
    const auto begin = CheckedFalcon::Clock::now();
    const auto end = begin + desk.options.times.rate;
    while (CheckedFalcon::Clock::now() < end) {
        desk.quit_if_interrupted();
        const auto heard = desk.falcon.exchange(no_force(Led::red));
        missing += heard ? 0 : 1;
        if (!heard) continue;
        round_trips_ms.push_back(
            std::chrono::duration<double, std::milli>(heard->round_trip).count());
    }
    const std::chrono::duration<double> took = CheckedFalcon::Clock::now() - begin;
    const LinkCounts counts = desk.falcon.counts();
    const Rate rate{static_cast<double>(round_trips_ms.size()) / took.count(),
                    quantile(round_trips_ms, 0.5), quantile(round_trips_ms, 0.99)};
    measured[setting.name] = {{"seconds", took.count()},
                              {"latency_timer_ms_read_back", latency_ms[0]},
                              {"event_character", setting.event_character},
                              {"replies", round_trips_ms.size()},
                              {"replies_per_s", rate.replies_per_s},
                              {"round_trip_ms_p50", rate.median_ms},
                              {"round_trip_ms_p99", rate.p99_ms},
                              {"round_trip_ms_max", quantile(round_trips_ms, 1.0)},
                              {"no_reply_within_20_ms", missing},
                              {"commands_resent", counts.resent},
                              {"line_errors", counts.line_errors},
                              {"bytes_discarded", counts.bytes_discarded}};
    return rate;
}

std::string in_words(const Rate& rate) {
    return number_text(rate.replies_per_s, 0) + " a second (half within " +
           number_text(rate.median_ms, 2) + " ms, 99 % within " + number_text(rate.p99_ms, 2) +
           " ms)";
}

}  // namespace

void check_rate(CheckDesk& desk, Json& measured) {
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
