// The exchange with one opened arm: its stages, poses and forces.
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "device/arm_buffers.hpp"
#include "device/arm_exchanges.hpp"
#include "device/forcedimension/arm.hpp"
#include "device/forcedimension/offers.hpp"
#include "device/forcedimension/status.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/pose_trust.hpp"

namespace dibhr::forcedimension {

/// The arm answers no more; a sentence for the user.
class ArmLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// State of the driver that is kept from one arm to the next.
struct DriverState {
    PoseTrust trust{};
    ButtonDebounce buttons{};
    ExchangeCount exchanges{};
    std::uint64_t failed_calls{0};
};

/// Runs on the device's thread. A force is sent only while the arm is ready, and only for a pose of
/// this epoch; after 20 ms zero replaces it. The library is called at least every 5 ms, because it
/// holds the arm up only with the forces that it is given.
class ExchangeLoop {
  public:
    ExchangeLoop(const Arm& arm, ArmBuffers& buffers, Board& board, DriverState& driver_state,
                 Offers& offers);
    ~ExchangeLoop();
    ExchangeLoop(const ExchangeLoop&) = delete;
    ExchangeLoop& operator=(const ExchangeLoop&) = delete;

    /// Returns after a stop request. Throws ArmLost.
    void run(const std::stop_token& stop);

  private:
    using Time = std::chrono::steady_clock::time_point;

    void follow_status(Time now, const std::stop_token& stop);
    [[nodiscard]] Stage stage_of(const ArmStatus& status, Time now) const noexcept;
    void enter(Stage stage, ForceOff cause);
    void switch_force_on(Time now);
    void follow_offers(Time now, const std::stop_token& stop);
    void initialise(const std::stop_token& stop);
    void leave_exchanges();
    void exchange_once();
    [[nodiscard]] Vec3 current_force(Time now);
    [[nodiscard]] bool exchanges() const noexcept;
    [[nodiscard]] Epoch epoch() const noexcept;
    void publish_pose(const std::optional<Vec3>& position_m, Time at);
    void fail(int& in_a_row, int most);
    void report(Time now);
    void pause();

    const Arm& arm_;
    Library& library_;
    ArmBuffers& buffers_;
    Board& board_;
    DriverState& driver_state_;
    Offers& offers_;

    bool prepared_{false};
    bool stage_entered_{false};
    std::string refusal_{};    // why the arm could not be initialised; empty: not tried, or it was
    int failed_statuses_{0};   // in a row
    int failed_exchanges_{0};  // in a row
    std::uint8_t buttons_{0};
    Time status_due_{};
    Time settled_at_{};  // the motors are on from then on
    Time force_off_since_{};
    Time exchanged_at_{};
    Time last_loop_update_{};
};

}  // namespace dibhr::forcedimension
