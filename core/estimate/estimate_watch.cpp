// Texts of the progress, and the end of an estimator.
#include "core/estimate/estimate_watch.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace dibhr {

namespace {

/// "0:12", "1:02:03"
std::string duration_text(double seconds) {
    const auto all = static_cast<long>(std::lround(std::max(seconds, 0.0)));
    char text[32];
    if (all >= 3600)
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", all / 3600, all / 60 % 60, all % 60);
    else
        std::snprintf(text, sizeof text, "%ld:%02ld", all / 60, all % 60);
    return text;
}

}  // namespace

std::string in_words(const EstimateProgress& now) {
    constexpr std::array kDoing{"looking at the video", "reading its frames", "estimating",
                                "checking the depth"};
    std::string words = kDoing.at(static_cast<std::size_t>(now.step));
    if (now.step != EstimateStep::estimating) return words;
    if (now.counted && now.done < now.of)
        words += " frame " + std::to_string(now.done + 1) + " of " + std::to_string(now.of);
    if (now.left_s) return words + ", " + duration_text(*now.left_s) + " left";
    return words + ", " + duration_text(now.elapsed_s);
}

void EstimateWatch::stop_at_once() noexcept {
    stop_ = true;
    const std::scoped_lock lock(mutex_);
    at_once_ = true;
    if (keeper_ > 0) ::kill(keeper_, SIGUSR1);
}

void EstimateWatch::report(const EstimateProgress& progress) {
    const std::scoped_lock lock(mutex_);
    progress_ = progress;
}

EstimateProgress EstimateWatch::progress() const {
    const std::scoped_lock lock(mutex_);
    return progress_;
}

void EstimateWatch::set_keeper(pid_t keeper) {
    const std::scoped_lock lock(mutex_);
    keeper_ = keeper;
    if (keeper_ > 0 && at_once_) ::kill(keeper_, SIGUSR1);
}

}  // namespace dibhr
