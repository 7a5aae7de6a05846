// A session bus of its own, without a service of the machine's, and a portal on it that answers as
// a test wants.
#pragma once

#include <systemd/sd-bus.h>

#include <array>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/program/desk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

class SessionBus {
  public:
    SessionBus();

    /// "unix:path=..."
    [[nodiscard]] const std::string& address() const { return address_; }
    /// A new connection; the test fails when there is none.
    [[nodiscard]] sd_bus* connect() const;
    /// It stands still, or goes on.
    void stop() const { daemon_.send(SIGSTOP); }
    void resume() const { daemon_.send(SIGCONT); }

  private:
    std::array<int, 2> told_;  // a pipe: the daemon writes its address
    TemporaryFolder folder_{};
    Process daemon_;
    std::string address_{};
};

/// What a portal does when it is asked to open files.
struct PortalManner {
    bool replies{true};         ///< to the call at all
    bool refuses{false};        ///< with an error: it has no file chooser
    bool old{false};            ///< its request has another path than the one that is expected
    bool answers{true};         ///< as a person would
    std::uint32_t response{0};  ///< 0: chosen, 1: cancelled, 2: ended in another way
    std::vector<std::string> addresses{};  ///< "file:///..."
    bool vanishes{false};                  ///< after its reply, in place of an answer
};

/// What it was asked.
struct PortalAsked {
    int times{0};
    bool closed{false};  ///< the last request, by who asked
    std::string parent{}, title{}, folder{};
    std::vector<std::string> filters{};  ///< their names
    std::vector<std::string> patterns{};
    bool multiple{false};
    bool modal{true};
};

/// Serves on a thread of its own until it is destroyed.
class Portal {
  public:
    Portal(const SessionBus& bus, PortalManner manner);
    ~Portal();
    Portal(const Portal&) = delete;
    Portal& operator=(const Portal&) = delete;

    [[nodiscard]] PortalAsked asked() const;

  private:
    static int on_message(sd_bus_message* message, void* self, sd_bus_error* error);
    int take_question(sd_bus_message* call);
    void read_options(sd_bus_message* call);
    void read_filters(sd_bus_message* call);
    void answer();
    void serve();

    PortalManner manner_;
    std::unique_ptr<sd_bus, sd_bus* (*)(sd_bus*)> bus_;
    std::string request_{}, who_{}, token_{};  // of the question that waits
    std::chrono::steady_clock::time_point due_{std::chrono::steady_clock::time_point::max()};
    mutable std::mutex guard_{};
    PortalAsked asked_{};
    std::jthread thread_{};
};

}  // namespace dibhr::test
