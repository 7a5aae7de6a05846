// The Inverse3 under check: one message and its answer at a time.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/json.hpp"
#include "device/hand/guardian.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/service_request.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

class CheckedInverse3 {
  public:
    using Clock = std::chrono::steady_clock;

    /// Finds the device, connects, and sets the preset as the viewer does. Throws DeviceError.
    /// `options` must outlive this object.
    explicit CheckedInverse3(const ConnectionOptions& options);
    /// Sends zero forces, then closes the connection.
    ~CheckedInverse3();
    CheckedInverse3(const CheckedInverse3&) = delete;
    CheckedInverse3& operator=(const CheckedInverse3&) = delete;

    struct Received {
        Arm arm{};
        std::chrono::nanoseconds round_trip{0};
    };

    /// Sends one message and waits for the answer, at most a second. Without a force it only
    /// requests the pose. Throws DeviceError without an answer, or when the device is not in it.
    Received exchange(const std::optional<Vec3>& force_newton, ForceDialect dialect);
    /// The same without a force; nothing: the device is not in the answer, which is in message().
    [[nodiscard]] std::optional<Arm> poll(ForceDialect dialect);
    /// Sends three zero forces in both dialects, first in that of the last force; opens a
    /// connection where there is none. Ignores errors.
    void release_force() noexcept;
    /// Sends nothing to the service, but beats for the guardian; at most 40 ms at a time.
    void pause_sending(Clock::time_point until);
    /// Closes the connection as a crash would, without a zero force, a close frame or the
    /// guardian's packets. The next message opens a new connection.
    void drop_connection() noexcept;

    struct Found {
        Arm arm{};
        bool unrequested{false};  ///< the service sent it before any message of ours
    };
    /// Opens a new connection and returns the first state of the device. Throws DeviceError.
    [[nodiscard]] Found reconnect();

    /// Why no guardian watches while a force acts, in a line; empty when one does.
    [[nodiscard]] std::string unguarded() const { return guardian_.fault(); }

    [[nodiscard]] const std::string& id() const noexcept { return id_; }
    /// The answer of /version; null: there was none.
    [[nodiscard]] const Json& version_answer() const noexcept { return version_answer_; }
    /// The service is dibhr's own simulation.
    [[nodiscard]] bool is_simulated() const;
    /// When the last message was sent.
    [[nodiscard]] Clock::time_point sent_at() const noexcept { return sent_at_; }
    [[nodiscard]] const ServiceMessage& message() const noexcept { return message_; }
    [[nodiscard]] bool newer() const noexcept { return newer_; }

    // Whole states as the service sent them. Text that is no JSON is kept as text.

    /// The first one, before any setting.
    [[nodiscard]] const Json& inventory() const noexcept { return inventory_; }
    /// The service sent the inventory unrequested.
    [[nodiscard]] bool inventory_unrequested() const noexcept { return inventory_unrequested_; }
    /// The one after the session was named and the preset set.
    [[nodiscard]] const Json& configured_state() const noexcept { return configured_state_; }
    /// The error that the service reported to those settings; empty: none.
    [[nodiscard]] const std::string& error_text() const noexcept { return error_text_; }

  private:
    std::chrono::nanoseconds ask(const ServiceRequest& request);
    /// Reads the first whole state into text_ and message_; true: it came unrequested.
    bool connect();
    void name_session();
    void reopen();
    [[nodiscard]] bool wait_for_answer(Clock::time_point until);
    void guard(ForceDialect dialect);

    const ConnectionOptions& options_;
    Guardian guardian_{"Inverse3"};  // first: forked before there is a connection
    std::optional<ForceDialect> guarded_dialect_{};
    Json version_answer_{};
    bool newer_{false};
    std::string id_{};
    Json inventory_{};
    bool inventory_unrequested_{false};
    Json configured_state_{};
    std::string error_text_{};
    std::optional<ForceDialect> last_force_dialect_{};  // dialect of the last force
    std::optional<ServiceLink> link_{};                 // nothing: not connected
    Clock::time_point sent_at_{};
    MessageReader reader_{};
    RequestWriter writer_{};
    ServiceMessage message_{};
    std::string_view text_{};  // of the last message; until the next one
};

/// The configuration of a device in a whole state; an empty object: not in it.
[[nodiscard]] Json config_in(const Json& whole_state, const std::string& id);

}  // namespace dibhr::inverse3
