// Speaks texts through the desktop's speech-dispatcher, on a thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace dibhr {

/// The library of speech-dispatcher's clients, for the system's loader.
inline constexpr const char* kSpeechLibrary = "libspeechd.so.2";

/// The library is loaded, and the daemon connected, with the first text. Neither call waits for
/// them.
class Speaker {
  public:
    explicit Speaker(std::string library = kSpeechLibrary);
    /// What is being spoken is broken off. Waits at most half a second: a thread that hangs in the
    /// daemon is detached.
    ~Speaker();
    Speaker(const Speaker&) = delete;
    Speaker& operator=(const Speaker&) = delete;

    /// Speaks the text in place of all before, also the one that is being spoken. Empty: silence.
    void say(const std::string& text);
    /// Speaks the text after the one that is being spoken.
    void say_next(const std::string& text);

    /// Why nothing can be spoken, once, as one line with the next step.
    [[nodiscard]] std::optional<std::string> take_trouble();

  private:
    class Work;

    std::shared_ptr<Work> work_;  // shared with the thread, which may outlive this object
    std::uint64_t said_{0};
    std::thread thread_;
};

}  // namespace dibhr
