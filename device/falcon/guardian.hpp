// A small process beside the program that sends packets without force when the program dies in any
// way, or falls silent (README.md, The guardian).
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "device/falcon/packet.hpp"

namespace dibhr::falcon {

/// Forked at construction. It guards one opened Falcon at a time, and ends with the program. Where
/// the system allows no process everything here does nothing, and fault() says so. All but alarm()
/// and alarmed() is one thread's.
class Guardian {
  public:
    Guardian();
    ~Guardian();  ///< dismissed
    Guardian(const Guardian&) = delete;
    Guardian& operator=(const Guardian&) = delete;

    /// Why nobody sends the last packet when the program dies, in one plain line; empty: it is
    /// there.
    [[nodiscard]] std::string fault() const;

    /// From now on it sends `farewell`, a command without force, over this open file of usbfs, of
    /// which it gets a descriptor of its own:
    /// - every 5 ms while beat() has not been called for 50 ms, until it is called again;
    /// - every 5 ms after alarm();
    /// - five times when the program has ended, however it did.
    /// Not while firmware is loaded: a packet would be taken for a part of it.
    void watch(int descriptor, const Packet& farewell) noexcept;
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
    using Beats = std::atomic<std::uint32_t>;

    void begin() noexcept;
    [[nodiscard]] bool say(char word, int descriptor = -1, const Packet& farewell = {}) noexcept;
    void give_up(const char* step) noexcept;

    Beats* beats_{nullptr};  // in one page of both processes
    int socket_{-1};         // the program's end
    const char* failed_{nullptr};
    int error_{0};
};

/// Watched while it lives.
class Guarded {
  public:
    Guarded(Guardian& guardian, int descriptor) noexcept : guardian_(guardian) {
        guardian_.watch(descriptor, encode(no_force(Led::off)));
    }
    ~Guarded() { guardian_.dismiss(); }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;

  private:
    Guardian& guardian_;
};

}  // namespace dibhr::falcon
