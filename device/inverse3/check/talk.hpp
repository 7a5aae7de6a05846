// One message and its answer at a time with the device that is checked.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/json.hpp"
#include "device/hand/guardian.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/order.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

class CheckTalk {
  public:
    using Clock = std::chrono::steady_clock;

    /// Finds the device, connects, and sets the preset as the viewer does. Throws DeviceError.
    /// `options` outlive it.
    explicit CheckTalk(const ConnectionOptions& options);
    /// Zero forces, then goodbye.
    ~CheckTalk();
    CheckTalk(const CheckTalk&) = delete;
    CheckTalk& operator=(const CheckTalk&) = delete;

    struct Heard {
        Arm arm{};
        std::chrono::nanoseconds round_trip{0};
    };

    /// Sends it, and waits for what comes: at most a second. `force`: nothing asks for the pose
    /// alone. Throws DeviceError when nothing comes, or the device is not in it.
    Heard exchange(const std::optional<Vec3>& force_newton, ForceDialect dialect);
    /// The same without a force, of a device that may be there or not; the message is message().
    [[nodiscard]] std::optional<Arm> look(ForceDialect dialect);
    /// Three zero forces in both dialects, that of the last force first; over a new connection
    /// where there is none. No error is told.
    void let_go() noexcept;
    /// Without a word to the service, which the guardian knows of; no longer than 40 ms at a time.
    void keep_silent(Clock::time_point until);
    /// Ends the connection as a program's death would, but for the guardian's last word: no zero,
    /// no goodbye. The next message makes a new one.
    void break_off() noexcept;

    struct Found {
        Arm arm{};
        bool unasked{false};  ///< told before anything was said
    };
    /// What a new connection is told first of the device. Throws DeviceError.
    [[nodiscard]] Found connect_again();

    /// Why no guardian watches while a force acts, in a line; empty when one does.
    [[nodiscard]] std::string unguarded() const { return guardian_.fault(); }

    [[nodiscard]] const std::string& id() const noexcept { return id_; }
    /// As /version told it; null: it did not.
    [[nodiscard]] const Json& version_answer() const noexcept { return version_answer_; }
    /// It is dibhr's own.
    [[nodiscard]] bool is_simulated() const;
    /// When the last message was sent.
    [[nodiscard]] Clock::time_point sent_at() const noexcept { return sent_at_; }
    [[nodiscard]] const ServiceMessage& message() const noexcept { return message_; }
    [[nodiscard]] bool newer() const noexcept { return newer_; }

    // Whole states, in the service's own words. Text that is no JSON is kept as text.

    /// The first one, before anything was set.
    [[nodiscard]] const Json& inventory() const noexcept { return inventory_; }
    /// The service sent it by itself, else it was asked for it.
    [[nodiscard]] bool inventory_unasked() const noexcept { return inventory_unasked_; }
    /// The one after the session was introduced and the preset set.
    [[nodiscard]] const Json& introduced() const noexcept { return introduced_; }
    /// What the service complained of when it was; empty: of nothing.
    [[nodiscard]] const std::string& complaint() const noexcept { return complaint_; }

  private:
    std::chrono::nanoseconds ask(const Order& order);
    /// The first whole state, which is in text_ and message_; whether it came unasked.
    bool connect();
    void introduce();
    void begin_again();
    [[nodiscard]] bool hears(Clock::time_point until);
    void guard(ForceDialect dialect);

    const ConnectionOptions& options_;
    Guardian guardian_{"Inverse3"};  // first: forked before there is a connection
    std::optional<ForceDialect> guarded_in_{};
    Json version_answer_{};
    bool newer_{false};
    std::string id_{};
    Json inventory_{};
    bool inventory_unasked_{false};
    Json introduced_{};
    std::string complaint_{};
    std::optional<ForceDialect> pushed_in_{};  // how the last force was spelled
    std::optional<ServiceLink> link_{};        // nothing: broken off
    Clock::time_point sent_at_{};
    MessageReader reader_{};
    OrderWriter writer_{};
    ServiceMessage message_{};
    std::string_view text_{};  // of the last message; until the next one
};

/// What a whole state tells of the configuration of a device; an empty object: nothing.
[[nodiscard]] Json config_in(const Json& whole_state, const std::string& id);

}  // namespace dibhr::inverse3
