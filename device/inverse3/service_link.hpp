// One connection to the service: whole messages over a WebSocket, and HTTP requests.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/realtime/wake.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::inverse3 {

/// A failed or lost connection, with a sentence for the user.
class LinkError : public DeviceError {
  public:
    enum class Why {
        refused,          ///< no server listens on the port
        not_the_service,  ///< another server listens on the port
        lost,             ///< closed, reset, or timed out in the middle of a message
        too_long,         ///< a message longer than any device's state
        unguarded,        ///< the guardian has died
        program_stalled   ///< this program stalled, and its guardian has sent zero forces
    };

    LinkError(Why why, const std::string& text) : DeviceError(text), why_(why) {}
    [[nodiscard]] Why why() const noexcept { return why_; }

  private:
    Why why_;
};

/// A WebSocket to a port of this machine. Neither send() nor read() allocates once a message of
/// that length has passed. All calls throw LinkError.
class ServiceLink {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr std::size_t kLongestMessage_bytes = std::size_t{256} * 1024;

    /// Connects, with the WebSocket handshake, until `deadline`.
    ServiceLink(std::uint16_t port, Time deadline);
    ~ServiceLink();
    ServiceLink(const ServiceLink&) = delete;
    ServiceLink& operator=(const ServiceLink&) = delete;

    void send(std::string_view text, Time deadline);
    /// The next whole message, valid until the next call: to be called after wait() was true. Pings
    /// are answered.
    [[nodiscard]] std::string_view read(Time deadline);
    /// Waits until a message begins or the link is lost (true), `wake` is signalled, or `until`.
    /// Sees unrequested messages, too, because nothing is read ahead.
    [[nodiscard]] bool wait(const Wake* wake, Time until) const noexcept;
    /// The socket, for the guardian.
    [[nodiscard]] int descriptor() const noexcept;
    /// Sets the message that is sent before the link ends, however it ends; empty: none. Returns
    /// it as a whole frame, for the guardian.
    StopPacket set_stop_packet(std::string_view text);
    /// Closes the WebSocket and waits for the answer; false: there was none.
    bool close(Time deadline) noexcept;

  private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

/// The answer to GET `target` on a port of this machine, with status 200. Throws LinkError.
[[nodiscard]] std::string http_get(std::uint16_t port, std::string_view target,
                                   ServiceLink::Time deadline);

}  // namespace dibhr::inverse3
