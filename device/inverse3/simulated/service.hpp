// The simulated Inverse Service: a real TCP server on this machine with WebSocket and HTTP.
#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "device/inverse3/simulated/scene.hpp"

namespace dibhr::inverse3::simulated {

/// One received message of a client.
struct ReceivedMessage {
    Clock::time_point at{};
    bool drives{false};
    Vec3 force_newton{0.0};
    std::string arm{};
    bool requests_preset{false};
};

/// How the connection of a client ends.
enum class Loss { closed, reset };

/// Serves from construction to destruction, any number of clients, each on a thread of its own.
class Service {
  public:
    /// Port 0: any free one. Throws DeviceError when a port is taken.
    explicit Service(Scene scene = {}, std::uint16_t port = 0, std::uint16_t older_port = 0);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    /// Where older versions have HTTP.
    [[nodiscard]] std::uint16_t older_port() const noexcept { return older_port_; }

    /// Time since construction [s]; the argument of Scene::hand_m.
    [[nodiscard]] double seconds() const noexcept {
        return std::chrono::duration<double>(Clock::now() - began_).count();
    }

    /// Runs `work` on the scene, while no message is being answered.
    template <typename Work>
    auto with(Work&& work) {
        const std::lock_guard lock(mutex_);
        return std::forward<Work>(work)(scene_);
    }
    /// Ends all connections now; goes on listening.
    void drop_clients(Loss how);
    /// Refuses new connections until listen(); open ones stay.
    void refuse();
    void listen();

    // What the service has received.
    [[nodiscard]] std::vector<ReceivedMessage> received() const;
    void clear_received();
    [[nodiscard]] std::uint64_t exchanges() const noexcept { return exchanges_; }
    /// Messages that came while an earlier one had no answer yet.
    [[nodiscard]] std::uint64_t too_many_in_flight() const noexcept { return too_many_; }
    [[nodiscard]] std::uint64_t not_understood() const noexcept { return not_understood_; }
    [[nodiscard]] std::uint64_t connections() const noexcept { return connections_; }

  private:
    struct Client {
        int descriptor{-1};
        std::atomic<bool> done{false};
        std::string came{};
        std::thread thread{};
    };

    void accept_clients();
    void listen_again();
    void take_client(int descriptor, bool older);
    void serve(Client& client, bool older);
    [[nodiscard]] bool shake_hands(Client& client, bool older);
    void exchange_messages(Client& client);
    [[nodiscard]] bool answer(Client& client, const std::string& message);
    void wait_before_answer();
    [[nodiscard]] std::string answer_bytes(bool whole);
    void count_waiting_message(Client& client);
    void reap(bool all);

    std::uint16_t port_{0};
    std::uint16_t older_port_{0};
    std::atomic<int> listener_{-1};
    int older_listener_{-1};
    std::atomic<bool> listening_{true};
    std::atomic<bool> ending_{false};
    const Clock::time_point began_{Clock::now()};

    mutable std::mutex mutex_{};
    Scene scene_;                              // guarded by mutex_
    std::vector<ReceivedMessage> received_{};  // guarded by mutex_
    std::atomic<std::uint64_t> exchanges_{0};
    std::atomic<std::uint64_t> too_many_{0};
    std::atomic<std::uint64_t> not_understood_{0};
    std::atomic<std::uint64_t> connections_{0};

    std::mutex clients_mutex_{};
    std::list<std::unique_ptr<Client>> clients_{};  // guarded by clients_mutex_
    std::thread accepting_{};                       // last: it uses all the others
};

}  // namespace dibhr::inverse3::simulated
