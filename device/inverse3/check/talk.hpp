// One message and its answer at a time with the device that is checked.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "device/hand/guardian.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/order.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

class CheckTalk {
  public:
    using Clock = std::chrono::steady_clock;

    /// Connects and finds the device. Throws DeviceError.
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
    /// Three zero forces in both dialects, that of the last force first. No error is told.
    void let_go() noexcept;
    /// Without a word to the service, which the guardian knows of; `goes_on` is asked every 5 ms.
    /// Whether it was silent for the whole time.
    [[nodiscard]] bool keep_silent(std::chrono::milliseconds span,
                                   const std::function<bool()>& goes_on);
    /// Why no guardian watches while a force acts, in a line; empty when one does.
    [[nodiscard]] std::string unguarded() const { return guardian_.fault(); }

    [[nodiscard]] const std::string& id() const noexcept { return id_; }
    [[nodiscard]] const std::string& version() const noexcept { return version_; }
    [[nodiscard]] const ServiceMessage& message() const noexcept { return message_; }
    [[nodiscard]] const std::string& inventory() const noexcept { return inventory_; }
    [[nodiscard]] bool newer() const noexcept { return newer_; }

  private:
    std::chrono::nanoseconds ask(const Order& order);
    [[nodiscard]] bool hears(Clock::time_point until);
    void guard(ForceDialect dialect) noexcept;

    Guardian guardian_{"Inverse3"};  // first: forked before there is a connection
    std::optional<ForceDialect> guarded_in_{};
    std::string version_{};
    bool newer_{false};
    std::string id_{};
    std::string inventory_{};
    bool pushed_{false};
    std::optional<ServiceLink> link_{};
    MessageReader reader_{};
    OrderWriter writer_{};
    ServiceMessage message_{};
};

}  // namespace dibhr::inverse3
