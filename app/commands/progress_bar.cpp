// Draws the bar over itself.
#include "app/commands/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <utility>

namespace dibhr {

namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr int kWidth = 40;

}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      begin_(std::chrono::steady_clock::now()),
      on_terminal_(::isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
    if (shown_percent_ >= 0) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressBar::show(double share) {
    if (!on_terminal_ || std::chrono::steady_clock::now() - begin_ < kPatience) return;
    const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
    if (percent == shown_percent_) return;
    shown_percent_ = percent;
    const auto full = static_cast<std::size_t>(percent * kWidth / 100);
    std::cerr << '\r' << title_ << " [" << std::string(full, '#') << std::string(kWidth - full, '.')
              << "] " << percent << " %" << std::flush;
}

}  // namespace dibhr
