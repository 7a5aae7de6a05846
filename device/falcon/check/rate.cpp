// Step 3: replies per second, and the time of one, with and without the event character
// (../README.md, Reply rate).
#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "device/falcon/check/context.hpp"
#include "device/hand/check/numbers.hpp"

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
    Sample round_trips_ms{};

    [[nodiscard]] double median_ms() const { return round_trips_ms.quantile(0.5); }
    [[nodiscard]] std::string in_words() const {
        return rate_in_words(replies_per_s, round_trips_ms);
    }
};

Rate measure(CheckContext& context, const Setting& setting, Json& measured) {
    FtdiPort& port = context.falcon.port();
    port.request(setting.latency);
    std::array<std::uint8_t, 1> latency_ms{};
    port.ask(kReadLatencyTimer, latency_ms);
    context.falcon.use_event_character(setting.event_character);

    Rate rate;
    int missing = 0;
    const auto begin = CheckedFalcon::Clock::now();
    const auto end = begin + context.options.times.rate;
    while (CheckedFalcon::Clock::now() < end) {
        context.quit_if_interrupted();
        const auto received = context.falcon.exchange(no_force(Led::red));
        missing += received ? 0 : 1;
        if (!received) continue;
        rate.round_trips_ms.add(
            std::chrono::duration<double, std::milli>(received->round_trip).count());
    }
    const std::chrono::duration<double> took = CheckedFalcon::Clock::now() - begin;
    const LinkCounts counts = context.falcon.counts();
    const Sample& round_trips_ms = rate.round_trips_ms;
    rate.replies_per_s = static_cast<double>(round_trips_ms.count()) / took.count();
    measured[setting.name] = {{"seconds", took.count()},
                              {"latency_timer_ms_read_back", latency_ms[0]},
                              {"event_character", setting.event_character},
                              {"replies", round_trips_ms.count()},
                              {"replies_per_s", rate.replies_per_s},
                              {"round_trip_ms_p50", rate.median_ms()},
                              {"round_trip_ms_p99", round_trips_ms.quantile(0.99)},
                              {"round_trip_ms_max", round_trips_ms.most()},
                              {"no_reply_within_20_ms", missing},
                              {"commands_resent", counts.resent},
                              {"line_errors", counts.line_errors},
                              {"bytes_discarded", counts.bytes_discarded}};
    return rate;
}

}  // namespace

void check_rate(CheckContext& context, Json& measured) {
    const Rate plain = measure(context, kPlain, measured);
    context.console.print("without the event character: " + plain.in_words());
    const Rate event = measure(context, kEvent, measured);
    context.console.print("with the event character: " + event.in_words());
    const Rate alone = measure(context, kEventAlone, measured);
    context.falcon.port().request(kLatencyRunTime);

    const bool works = alone.replies_per_s > 0.0 && alone.median_ms() < kAtOnce_ms;
    const bool helps = works && event.median_ms() < plain.median_ms() + kNoticeable_ms;
    context.findings.record_answer(
        OpenQuestion::reply_rate,
        plain.in_words() + "; with the event character " + event.in_words());
    context.findings.record_answer(
        OpenQuestion::event_character,
        std::string(works ? "the chip sends at once" : "the chip still waits for its timer") +
            ": with a latency of 16 ms " + alone.in_words());
    context.findings.set("event-character", helps ? "true" : "false");
    context.falcon.use_event_character(helps);
}

}  // namespace dibhr::falcon
