// The exchange over one connection to the service: forces out, poses in, one message in flight.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "device/arm_buffers.hpp"
#include "device/arm_exchanges.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/guardian.hpp"
#include "device/inverse3/arm_watch.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/service_request.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// State of the driver that is kept from one connection to the next.
struct DriverState {
    MessageReader reader{};
    RequestWriter writer{};
    ArmWatch watch{};  // its epochs continue
    ButtonDebounce buttons{};
    std::optional<ForceDialect> dialect{};  ///< found by trial; nothing: the version decides
    bool dialect_confirmed{false};
    int dialects_refused{0};  ///< 2: the service refused both
    ExchangeCount exchanges{};
    std::uint64_t unrequested{0};
    std::uint64_t not_understood{0};
};

class ExchangeLoop {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// All must outlive this object. `newer`: the version is 3.5 or later; a message that names its
    /// session shows this, too.
    ExchangeLoop(ServiceLink& link, const ConnectionOptions& options, bool newer,
                 ArmBuffers& buffers, Board& board, DriverState& driver_state, Guardian& guardian);
    /// Withdraws the pose. Without an answered close frame, leaves the connection to the guardian,
    /// which sends zero forces over it and closes it.
    ~ExchangeLoop();
    ExchangeLoop(const ExchangeLoop&) = delete;
    ExchangeLoop& operator=(const ExchangeLoop&) = delete;

    /// Runs until a stop request; then sends a zero force and closes the connection. Throws
    /// LinkError.
    void run(const std::stop_token& stop);

    /// After run() has thrown: the service closed the connection in answer to the first force.
    [[nodiscard]] bool closed_on_force() const noexcept;

  private:
    void take_inventory(const std::stop_token& stop);
    void exchange_once(const std::stop_token& stop);
    void pause();
    void close_link() noexcept;

    // Sending.
    void send_request(const ServiceRequest& request);
    void guard(const ServiceRequest& request);
    void check_guardian();
    void unguard() noexcept;
    [[nodiscard]] ServiceRequest next_request();
    [[nodiscard]] Vec3 current_force(Time now);

    // Receiving.
    [[nodiscard]] bool wait(Time until);
    [[nodiscard]] bool wait_for_message(Time until, const std::stop_token* stop);
    void take();
    void take_message(const ServiceMessage& message, Time at);
    void take_invalid(Stage why, const std::string& sentence);
    void take_arm(const Arm& arm, Time at);
    void take_grip(const ServiceMessage& message, Time at);
    void choose(const ServiceMessage& message);
    void ignore_others(const ServiceMessage& message);
    void forget_arm();
    void handle_no_arm(const ServiceMessage& message);
    void lose_arm(const ServiceMessage& message);
    void check_preset(const ArmConfig& config);
    [[nodiscard]] Stage stage() const noexcept;
    [[nodiscard]] Epoch epoch() const noexcept;
    void learn_dialect(const Arm& arm, Time at);
    void try_other_dialect();
    [[nodiscard]] ForceDialect dialect() const noexcept;
    [[nodiscard]] bool force_refused() const noexcept {
        return driver_state_.dialects_refused >= 2;
    }
    void publish_pose(const Arm& arm, Time at);
    void report(Time now);
    void publish_stage(Stage stage);
    void publish_status(Stage stage, const std::string& sentence, bool trouble);

    ServiceLink& link_;
    const ConnectionOptions& options_;
    bool newer_;
    ArmBuffers& buffers_;
    Board& board_;
    DriverState& driver_state_;
    Guardian& guardian_;

    ServiceMessage message_{};
    DeviceId arm_{};  // empty: none is chosen
    /// Arms that were attached when ours was lost: another user may hold them.
    std::array<DeviceId, ServiceMessage::kMost> ignored_arms_{};
    int preset_requests_{0};
    ForceEchoWatch echo_watch_{};
    bool session_named_{false};
    bool close_answered_{false};  // the service has answered the close frame
    std::optional<ForceDialect>
        guarded_dialect_{};  // dialect of the guardian's zero force; nothing: not guarded
    bool force_answered_{false};
    bool in_flight_{false};
    bool stage_published_{false};  // a stage of this arm was published
    bool arm_lost_{false};         // the arm is lost; zero forces may still be pending
    int zeros_pending_{0};
    Vec3 sent_newton_{0.0};  // with the message in flight
    bool sent_drives_{false};
    bool sent_whole_{false};
    Time sent_at_{};
    Time whole_state_due_{};
    Time last_loop_update_{};
    std::uint8_t buttons_{0};
};

}  // namespace dibhr::inverse3
