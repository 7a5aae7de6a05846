// One connection to the service: whole messages over a WebSocket, and questions over HTTP.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "device/hand/guardian.hpp"
#include "device/hand/wake.hpp"

namespace dibhr::inverse3 {

/// Why there is no connection, or none any more. Its text says so in plain words.
class LinkError : public DeviceError {
  public:
    enum class Why {
        refused,          ///< nobody listens there
        not_the_service,  ///< somebody does who speaks something else
        lost,             ///< closed, broken off, or silent in the middle of a message
        too_long,         ///< a message that no device's state fills
        unguarded,        ///< the guardian has died
        stood_still       ///< this program did, and its guardian has spoken to the service
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

    /// Connects and shakes hands until `deadline`.
    ServiceLink(std::uint16_t port, Time deadline);
    ~ServiceLink();
    ServiceLink(const ServiceLink&) = delete;
    ServiceLink& operator=(const ServiceLink&) = delete;

    void send(std::string_view text, Time deadline);
    /// The next whole message, valid until the next call: to be called when one begins to come.
    /// Pings on the way are answered.
    [[nodiscard]] std::string_view read(Time deadline);
    /// Until a message begins to come or the link has gone (true), `wake` is signalled, or `until`.
    /// What was not asked for is seen, too: nothing is read ahead.
    [[nodiscard]] bool wait(const Wake* wake, Time until) const noexcept;
    /// The socket, for the guardian.
    [[nodiscard]] int descriptor() const noexcept;
    /// A message that the service is sent before the link ends, whoever ends it and however; empty:
    /// none. As a whole frame it is also given back, for the guardian.
    Farewell set_last_words(std::string_view text);
    /// Says goodbye and waits for the answer; false: there was none.
    bool close(Time deadline) noexcept;

  private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

/// What GET `target` of a port of this machine answers with status 200. Throws LinkError.
[[nodiscard]] std::string http_get(std::uint16_t port, std::string_view target,
                                   ServiceLink::Time deadline);

}  // namespace dibhr::inverse3
