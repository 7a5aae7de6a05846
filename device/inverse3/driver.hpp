// The network thread: finds the service, reads its version, exchanges messages with it until it is
// lost, and searches again.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "device/hand/guardian.hpp"
#include "device/inverse3/conversation.hpp"
#include "device/inverse3/exchange.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Has a guardian process from construction on.
class Driver {
  public:
    /// `exchange` must outlive it.
    Driver(ConnectionOptions options, Exchange& exchange);
    ~Driver();  ///< sends a zero force, then closes the connection
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const { return board_.read(); }

  private:
    void live(const std::stop_token& stop);
    void look(const std::stop_token& stop);
    void talk(ServiceLink& link, bool newer, const std::stop_token& stop);
    void lose(const LinkError& error, const Conversation& conversation);
    void miss(const LinkError& error);
    void tell(Stage stage, const std::string& sentence, bool trouble);

    const ConnectionOptions options_;
    Exchange& exchange_;
    Board board_{};
    Guardian guardian_{"Inverse3"};
    Memory memory_{};
    bool lost_{false};                   // the service was connected before, in this run
    std::chrono::milliseconds pause_{};  // before the next search

    std::mutex mutex_{};
    std::condition_variable_any news_{};

    std::jthread thread_{};  // last: it uses all the others
};

}  // namespace dibhr::inverse3
