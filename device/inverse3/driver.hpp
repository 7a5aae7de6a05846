// The network thread: finds the service, reads its version, exchanges messages with it until it is
// lost, and searches again.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "device/arm_buffers.hpp"
#include "device/hand/guardian.hpp"
#include "device/inverse3/exchange_loop.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Has a guardian process from construction on.
class Driver {
  public:
    /// `buffers` must outlive it.
    Driver(ConnectionOptions options, ArmBuffers& buffers);
    ~Driver();  ///< sends a zero force, then closes the connection
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const { return board_.read(); }

  private:
    void run(const std::stop_token& stop);
    void find_device(const std::stop_token& stop);
    void run_exchanges(ServiceLink& link, bool newer, const std::stop_token& stop);
    void handle_loss(const LinkError& error, const ExchangeLoop& exchange_loop);
    void handle_no_service(const LinkError& error);

    const ConnectionOptions options_;
    ArmBuffers& buffers_;
    Board board_{};
    Guardian guardian_{"Inverse3"};
    DriverState driver_state_{};
    bool lost_{false};                   // the service was connected before, in this run
    std::chrono::milliseconds pause_{};  // before the next search

    std::mutex mutex_{};
    std::condition_variable_any changed_{};

    std::jthread thread_{};  // last: it uses all the others
};

}  // namespace dibhr::inverse3
