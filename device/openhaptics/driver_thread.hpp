// The thread that opens the device through 3D Systems' library, follows it until it is lost, and
// searches again.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/arm_buffers.hpp"
#include "device/library_thread.hpp"
#include "device/openhaptics/arm_watch.hpp"
#include "device/openhaptics/library.hpp"
#include "device/openhaptics/servo.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

class DriverThread {
  public:
    DriverThread(const ConnectionOptions& options, std::shared_ptr<ArmBuffers> buffers);

    void run();
    ThreadEnd end{};

    [[nodiscard]] Status status() const { return board_.read(); }

  private:
    using Time = std::chrono::steady_clock::time_point;

    void search();
    [[nodiscard]] HdHandle open(Fault& fault);
    [[nodiscard]] HdHandle init_device(const char* name);
    [[nodiscard]] Servo::Arm read_facts(HdHandle handle);
    void follow(HdHandle handle);
    [[nodiscard]] bool reset_encoders(HdHandle handle);
    [[nodiscard]] Fault start(Servo& servo, HdSchedule& schedule);
    [[nodiscard]] std::string watch_servo(Servo& servo);
    void calibrate(const ServoReport& report, Time now);
    void switch_force(Servo& servo, bool on);
    bool stop_servo(Servo& servo, HdSchedule schedule);
    void report(const ServoReport& servo, bool silent, Time now);

    const ConnectionOptions options_;
    const std::shared_ptr<ArmBuffers> buffers_;
    Board board_{};

    // Used by the thread only, but for the watch and the buttons, which the servo thread uses.
    LoadedLibrary library_{};
    ArmWatch watch_{};
    ButtonDebounce buttons_{};
    std::vector<std::unique_ptr<Servo>> servos_{};  // the running one, and those that were cut off
    bool force_on_{false};
    std::string printed_{};  // by the library, when it opened a device last
    std::string trouble_{};  // why the last link ended, until a device is open again
    Time calibrated_at_{};   // when a calibration was last requested
    std::uint64_t seen_{0};  // ticks of the servo, and when they last changed
    Time seen_at_{};
    std::uint64_t counted_{0};  // ticks of the servo, for the rate
    Time counted_at_{};
    unsigned int last_code_{kHdSuccess};
};

/// Has no guardian process: the library owns the device, and no other process can speak to it.
class Driver {
  public:
    Driver(const ConnectionOptions& options, std::shared_ptr<ArmBuffers> buffers)
        : work_(std::make_shared<DriverThread>(options, std::move(buffers))), thread_(work_) {}
    /// Zero force, force output off, and the device is closed. Where a call of the library does not
    /// return, its thread is left to itself.
    ~Driver() { (void)thread_.end_within(std::chrono::milliseconds(500)); }
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const { return work_->status(); }

  private:
    std::shared_ptr<DriverThread> work_;
    LibraryThread thread_;
};

}  // namespace dibhr::openhaptics
