// A small process beside the program that tells a device to let go when the program dies in any
// way, or falls silent (../falcon/README.md, The guardian).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace dibhr {

/// A command without force, ready to be sent.
struct Farewell {
    enum class Over : std::uint8_t {
        usb,    ///< a bulk transfer over an open file of usbfs
        stream  ///< a connected socket
    };
    static constexpr std::size_t kMostBytes = 512;

    Over over{Over::stream};
    std::uint8_t endpoint{0};  ///< of USB
    std::uint16_t size{0};
    std::array<std::uint8_t, kMostBytes> bytes{};

    /// What does not fit is no farewell: it is left empty then, and nothing is ever sent.
    void say(std::span<const std::uint8_t> message) noexcept;
};

struct SharedPage;  // what both processes see

/// Forked at construction. It guards one opened device at a time, and ends with the program. Where
/// the system allows no process everything here does nothing, and fault() says so. All but alarm()
/// and alarmed() is one thread's.
class Guardian {
  public:
    /// As `ps` shows it: without the program's name, so that `pkill dibhr` leaves it.
    static constexpr const char* kProcessName = "force-guardian";

    /// `device`, for people: "Falcon".
    explicit Guardian(std::string device);
    ~Guardian();  ///< dismissed
    Guardian(const Guardian&) = delete;
    Guardian& operator=(const Guardian&) = delete;

    /// Why nobody sends the last packet when the program dies, in one plain line; empty: it is
    /// there.
    [[nodiscard]] std::string fault() const;

    /// From now on it sends `farewell` over this open file or socket, of which it gets a descriptor
    /// of its own:
    /// - every 5 ms while beat() has not been called for 50 ms, until it is called again;
    /// - every 5 ms after alarm();
    /// - five times when the program has ended, however it did.
    /// Over a stream nothing gets lost, and answers would pile up: five each time, and it has
    /// spoken() from then on. Not while firmware is loaded, which a packet would be taken for a
    /// part of.
    void watch(int descriptor, const Farewell& farewell) noexcept;
    /// It has sent something since it was dismissed last: what the program hears over a stream may
    /// be the answer to that.
    [[nodiscard]] bool spoken() const noexcept;
    /// Somebody has ended it: the force is to go to zero. The next watch() begins another one.
    [[nodiscard]] bool died() const noexcept;
    /// Of a connection that may still be heard at its other end: the guardian takes this for the
    /// program's end, and the next watch() begins another one.
    void part() noexcept;
    /// It has closed its descriptor when this returns, or it hangs: then after 0.1 s.
    void dismiss() noexcept;
    /// The program lives. At least every 20 ms while it is watched.
    void beat() noexcept;

    /// Every guardian of this program sends at once and goes on, for good. For the signal handler
    /// of a program that crashes: async-signal-safe, on any thread.
    static void alarm() noexcept;
    /// alarm() has been called: the program is to send no force either.
    [[nodiscard]] static bool alarmed() noexcept;

  private:
    void begin() noexcept;
    [[nodiscard]] bool say(char word, int descriptor = -1, const Farewell& farewell = {}) noexcept;
    void give_up(const char* step) noexcept;

    const std::string device_;
    SharedPage* page_{nullptr};
    std::uint32_t sent_before_{0};  // of page_->sent
    int socket_{-1};                // the program's end
    const char* failed_{nullptr};
    int error_{0};
};

/// Watched while it lives.
class Guarded {
  public:
    Guarded(Guardian& guardian, int descriptor, const Farewell& farewell) noexcept
        : guardian_(guardian) {
        guardian_.watch(descriptor, farewell);
    }
    ~Guarded() { guardian_.dismiss(); }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;

  private:
    Guardian& guardian_;
};

}  // namespace dibhr
