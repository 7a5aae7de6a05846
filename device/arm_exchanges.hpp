// The exchanges of a pose and a force with an arm: their count, their rate, and their lines on the
// panel.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/force_device.hpp"
#include "device/hand/delay_watch.hpp"
#include "device/hand/pose_ages.hpp"

namespace dibhr {

inline constexpr int kPromptExchange_ms = 2;   ///< longer exchanges make springs noticeably softer
inline constexpr int kLongestExchange_ms = 5;  ///< longer exchanges allow no force

/// Of the status of a device.
struct ExchangeStatus {
    std::uint64_t exchanges{0};
    double exchanges_per_s{0.0};
    double exchange_ms{0.0};  ///< recent mean time of one
    bool softened{false};     ///< stiffness is limited more, because exchanges take so long
};

/// For the device's thread.
struct ExchangeCount {
    using Time = std::chrono::steady_clock::time_point;

    DelayWatch delay{};
    std::uint64_t count{0};

    /// The rate counts from now on.
    void begin(Time now) noexcept {
        counted_ = count;
        since_ = now;
    }
    /// A new rate comes every half second.
    void report(ExchangeStatus& status, Time now) noexcept {
        status.exchanges = count;
        status.exchange_ms = delay.mean_ms();
        status.softened = delay.within_ms() > kPromptExchange_ms;
        if (now - since_ < std::chrono::milliseconds(500)) return;
        const std::chrono::duration<double> passed = now - since_;
        status.exchanges_per_s = static_cast<double>(count - counted_) / passed.count();
        begin(now);
    }

  private:
    std::uint64_t counted_{0};
    Time since_{};
};

/// The histogram's last bin has no upper end.
[[nodiscard]] inline std::string age_text(double ms) {
    return ms > PoseAges::kLongest_ms ? "20 ms or more" : number_text(ms, 2) + " ms";
}

/// `what`: is exchanged; `who`: answers. `recent`: ages of about the last second.
[[nodiscard]] inline std::vector<DeviceLine> exchange_lines(const ExchangeStatus& status,
                                                            const PoseAges& recent,
                                                            const char* what, const char* who) {
    std::vector<DeviceLine> lines{{"Exchanges",
                                   number_text(status.exchanges_per_s, 0) + " per second, " +
                                       number_text(status.exchange_ms, 1) + " ms each",
                                   what}};
    if (status.softened)
        lines.push_back(
            {.text = std::string("The ") + who +
                     " answers slowly: springs are softer, so that they do not swing."});
    if (recent.count() > 0) {
        lines.push_back({"Age of the pose",
                         age_text(recent.quantile_ms(0.5)) + ", 99 % below " +
                             age_text(recent.quantile_ms(0.99)),
                         "Age of the position that a tick uses, in the last second. A position "
                         "older than 20 ms gives no force"});
    }
    return lines;
}

}  // namespace dibhr
