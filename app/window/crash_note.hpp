// The crash note: one line on stderr when the program cannot end in order.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace dibhr {

/// Records what the program does now, so that a signal handler or the shutdown thread can print it.
class CrashNote {
  public:
    CrashNote() = default;
    CrashNote(const CrashNote&) = delete;
    CrashNote& operator=(const CrashNote&) = delete;

    // Called by the window's thread.

    /// The program's activity from now on: a literal such as "drawing".
    void set_activity(const char* what) noexcept {
        activity_.store(what, std::memory_order_release);
    }
    /// The session file that is written from now on; empty: none.
    void set_recording(const std::filesystem::path& file);
    /// The clip that is being made: `part` is its playable temporary file, `file` its final name;
    /// both empty: no clip. `replaces`: whether it may overwrite an existing `file`.
    void set_clip(const std::filesystem::path& part, const std::filesystem::path& file,
                  bool replaces);

    // Called by any thread, also in a signal handler.

    [[nodiscard]] const char* activity() const noexcept {
        return activity_.load(std::memory_order_acquire);
    }
    /// Renames the clip's part to its final name, when the program ends before the clip does.
    void keep_clip() noexcept;
    /// Prints one line: "dibhr: ", the parts, and where recording and kept clip are, if any.
    /// Neither allocates nor waits: if stderr is not writable now, nothing is printed.
    void print(std::initializer_list<const char*> parts) const noexcept;

  private:
    struct Clip {
        std::string part{}, file{};
        bool replaces{false};
    };

    std::atomic<const char*> activity_{"starting"};
    std::deque<std::string> files_{};  // of all recordings: a handler may still read an old name
    std::atomic<const std::string*> recording_{nullptr};
    std::deque<Clip> clips_{};  // of all clips, for the same reason
    std::atomic<const Clip*> clip_{nullptr};
    std::atomic<const Clip*> kept_{nullptr};
};

}  // namespace dibhr
