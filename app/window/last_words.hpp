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
    /// The clip that is being made, which is written as `part` until then and plays; both empty:
    /// none is. Where it `replaces` no file of its name, one that is there stays.
    void clip(const std::filesystem::path& part, const std::filesystem::path& file, bool replaces);

    // Any thread's, and a signal handler's.

    [[nodiscard]] const char* what_is_done() const noexcept {
        return doing_.load(std::memory_order_acquire);
    }
    /// Gives the clip its name, for a program that ends before the clip is finished.
    void keep_clip() noexcept;
    /// "dibhr: " and the parts, and where the clip that was kept is, and where the recording is, if
    /// there is one; one line. Neither allocates nor waits: where stderr takes nothing now, it is
    /// not said.
    void tell(std::initializer_list<const char*> parts) const noexcept;

  private:
    struct Clip {
        std::string part{}, file{};
        bool replaces{false};
    };

    std::atomic<const char*> doing_{"starting"};
    std::deque<std::string> files_{};  // of all recordings: a name that is being read stays
    std::atomic<const std::string*> recording_{nullptr};
    std::deque<Clip> clips_{};  // likewise
    std::atomic<const Clip*> clip_{nullptr};
    std::atomic<const Clip*> kept_{nullptr};
};

}  // namespace dibhr
