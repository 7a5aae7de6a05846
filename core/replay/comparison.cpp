// How a replayed run differs from the recording.
#include "core/replay/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <glm/geometric.hpp>

#include "core/metrics/force_variation.hpp"
#include "core/replay/session_replay.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostKept = std::size_t{1} << 20;
constexpr int kNameWidth = 14;
constexpr int kCellWidth = 10;

std::string cell(double value) {
    std::ostringstream text;
    const bool small = value != 0.0 && std::abs(value) < 1e-3;
    text << ' ' << std::right << std::setw(kCellWidth - 1) << (small ? std::scientific : std::fixed)
         << std::setprecision(small ? 1 : 3) << value;
    return text.str();
}

}  // namespace

void Samples::add(double value) {
    if (count_++ % stride_ == 0) kept_.push_back(value);
    if (kept_.size() == kMostKept) {
        for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = kept_[2 * k];
        kept_.resize(kMostKept / 2);
        stride_ *= 2;
    }
    const double off = value - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (value - mean_);
    highest_ = std::max(highest_, value);
}

SampleStatistics Samples::statistics() const {
    SampleStatistics statistics = statistics_of(kept_);
    statistics.count = count_;
    statistics.mean = mean_;
    statistics.highest = highest_;
    return statistics;
}

double Samples::sd() const {
    return count_ == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_));
}

void RunComparison::add(const TickRecord& recorded, const Touch& touch, double update_us) {
    if (!same_bits(touch, recorded)) {
        ++differing_;
        if (!first_difference_) {
            first_difference_ = {recorded.tick,           recorded.t_s,
                                 touch.proxy.position,    recorded.proxy,
                                 touch.sent_force_newton, recorded.sent_newton};
        }
    }
    ++ticks_;
    if (!recorded.surface) return;
    time_us_.add(update_us);
    off_px_.add(glm::length(touch.proxy.position - recorded.proxy));
    const Vec3 lag = touch.proxy.position - touch.goal;
    const bool contact = touch.proxy.contact;
    if (contact) ++in_contact_;
    if (contact && recorded.contact) {
        const Vec3 recorded_lag = recorded.proxy - recorded.goal;
        astray_deg_.add(kDegPerRad * angle_between_rad(lag, recorded_lag));
    }
    if (contact && last_lag_) turn_deg_.add(kDegPerRad * angle_between_rad(*last_lag_, lag));
    last_lag_.reset();
    if (contact) last_lag_ = lag;
}

std::string RunComparison::table_row(const std::string& name) const {
    const SampleStatistics time = time_us_.statistics();
    const SampleStatistics off = off_px_.statistics();
    const SampleStatistics astray = astray_deg_.statistics();
    const double ticks = static_cast<double>(std::max<std::int64_t>(ticks_, 1));
    std::ostringstream text;
    text << "  " << std::left << std::setw(kNameWidth) << name;
    for (const double value : {time.mean, time.median, time.p99, turn_deg_.statistics().mean,
                               turn_deg_.sd(), off.mean, off.highest, astray.mean, astray.highest,
                               100.0 * static_cast<double>(in_contact_) / ticks}) {
        text << cell(value);
    }
    return text.str() + "\n";
}

std::string comparison_heading() {
    std::ostringstream text;
    const auto line = [&text](std::initializer_list<const char*> heads, int width) {
        text << "  " << std::left << std::setw(kNameWidth) << "";
        for (const char* head : heads) text << ' ' << std::right << std::setw(width - 1) << head;
        text << '\n';
    };
    line({"update", "update", "update", "force", "force", "proxy off", "proxy off", "force off",
          "force off", "in"},
         kCellWidth);
    line({"mean us", "median us", "p99 us", "turn deg", "sd deg", "mean px", "max px", "mean deg",
          "max deg", "contact %"},
         kCellWidth);
    return text.str();
}

}  // namespace dibhr
