// The one line the program leaves on stderr when it cannot end in order.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace dibhr {

/// Knows what goes on, so that whoever ends the program can say it: a signal's handler, too.
class LastWords {
  public:
    LastWords() = default;
    LastWords(const LastWords&) = delete;
    LastWords& operator=(const LastWords&) = delete;

    // The window thread's.

    /// What it does from here on: a literal such as "drawing".
    void doing(const char* what) noexcept { doing_.store(what, std::memory_order_release); }
    /// Where it records from here on; empty: nowhere.
    void recording(const std::filesystem::path& file);

    // Any thread's, and a signal handler's.

    [[nodiscard]] const char* what_is_done() const noexcept {
        return doing_.load(std::memory_order_acquire);
    }
    /// "dibhr: " and the parts, and where the recording is, if there is one; one line. Neither
    /// allocates nor waits: where stderr takes nothing now, it is not said.
    void tell(std::initializer_list<const char*> parts) const noexcept;

  private:
    std::atomic<const char*> doing_{"starting"};
    std::deque<std::string> files_{};  // of all recordings: a name that is being read stays
    std::atomic<const std::string*> recording_{nullptr};
};

}  // namespace dibhr
