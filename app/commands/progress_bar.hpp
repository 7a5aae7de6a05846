// A bar on stderr for work that takes longer than a second.
#pragma once

#include <chrono>
#include <string>

namespace dibhr {

/// Draws only on a terminal, and only once a second has passed; gone when it ends.
class ProgressBar {
  public:
    explicit ProgressBar(std::string title);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `share` of the work that is done, 0 to 1.
    void show(double share);

  private:
    std::string title_;
    std::chrono::steady_clock::time_point begin_;
    int shown_percent_{-1};
    bool on_terminal_{false};
};

}  // namespace dibhr
