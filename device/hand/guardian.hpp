// A small process beside the program. It sends a command without force to the device when the
// program dies or stops sending its heartbeat (../falcon/README.md, The guardian).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace dibhr {

/// A command without force, ready to be sent.
struct StopPacket {
    enum class Channel : std::uint8_t {
        usb,    ///< a bulk transfer over an open file of usbfs
        stream  ///< a connected socket
    };
    static constexpr std::size_t kMostBytes = 512;

    Channel channel{Channel::stream};
    std::uint8_t endpoint{0};  ///< of USB
    std::uint16_t size{0};
    std::array<std::uint8_t, kMostBytes> bytes{};

    /// Stays empty where the message is longer than kMostBytes: then nothing is ever sent.
    void set_message(std::span<const std::uint8_t> message) noexcept;
};

struct SharedPage;  // memory that both processes map

/// Forked at construction. The guardian process guards one opened device at a time, and ends with
/// the program. Where the system allows no process, all functions do nothing, and fault() returns
/// why. All functions but alarm() and alarmed() are for one thread.
class Guardian {
  public:
    /// As `ps` shows it: without the program's name, so that `pkill dibhr` does not end it.
    static constexpr const char* kProcessName = "force-guardian";

    /// `device`: its name in fault(): "Falcon".
    explicit Guardian(std::string device);
    ~Guardian();  ///< dismisses the process, which then ends
    Guardian(const Guardian&) = delete;
    Guardian& operator=(const Guardian&) = delete;

    /// Why no guardian process exists, in one line for the user; empty: it exists.
    [[nodiscard]] std::string fault() const;

    /// From now on the guardian sends `stop_packet` over this open file or socket, of which it gets
    /// a descriptor of its own:
    /// - every 5 ms while beat() has not been called for 50 ms, until it is called again;
    /// - every 5 ms after alarm();
    /// - five times when the program has ended, for whatever reason.
    /// Over a stream no packet gets lost, and unread answers would pile up: there it sends only
    /// five, and has_sent() is true from then on. Not to be called while firmware is loaded: the
    /// packet would become a part of the image.
    void watch(int descriptor, const StopPacket& stop_packet) noexcept;
    /// The guardian has sent something since the last dismiss(). What the program then receives
    /// over a stream may be the answer to the guardian's packet.
    [[nodiscard]] bool has_sent() const noexcept;
    /// Somebody ended the guardian process: set the force to zero. The next watch() forks another.
    [[nodiscard]] bool died() const noexcept;
    /// Leaves the connection to the guardian, which handles this like the program's end: it sends
    /// its five packets and closes. The next watch() forks another guardian.
    void detach() noexcept;
    /// Returns when the guardian has closed its descriptor; if it hangs, after 0.1 s.
    void dismiss() noexcept;
    /// Heartbeat: call it at least every 20 ms after watch().
    void beat() noexcept;

    /// Every guardian of this program starts to send at once, for good. For the signal handler of a
    /// crash: async-signal-safe, on any thread.
    static void alarm() noexcept;
    /// alarm() has been called: the program must send no force any more.
    [[nodiscard]] static bool alarmed() noexcept;

  private:
    void begin() noexcept;
    [[nodiscard]] bool send_message(char request, int descriptor = -1,
                                    const StopPacket& stop_packet = {}) noexcept;
    void note_failure(const char* step) noexcept;

    const std::string device_;
    SharedPage* page_{nullptr};
    std::uint32_t sent_before_{0};  // of page_->sent
    int socket_{-1};                // the program's end of the socket pair
    const char* failed_{nullptr};
    int error_{0};
};

/// The guardian watches this descriptor during the lifetime of the object.
class Guarded {
  public:
    Guarded(Guardian& guardian, int descriptor, const StopPacket& stop_packet) noexcept
        : guardian_(guardian) {
        guardian_.watch(descriptor, stop_packet);
    }
    ~Guarded() { guardian_.dismiss(); }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;

  private:
    Guardian& guardian_;
};

}  // namespace dibhr
