// Real-time priorities that the system's limits refuse a thread, and that a service grants it
// later.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace dibhr {

/// Granted, or the reason why not, as text for the Loop panel.
struct Grant {
    bool granted{false};
    std::string answer{};  ///< "SCHED_FIFO 80", "refused: needs rtprio in /etc/security/..."
};

/// A grant whose refusal may be replaced later. For any thread, but not in a tick.
class SharedGrant {
  public:
    void set(Grant grant);
    [[nodiscard]] Grant get() const;

    /// Another answer will come: get() gives the present one until then.
    void expect();
    /// Waits for the answer that is expected, if any.
    [[nodiscard]] Grant wait() const;

  private:
    mutable std::mutex mutex_{};
    mutable std::condition_variable answered_{};
    Grant grant_{};
    bool is_expected_{false};
};

/// Asks the service on a thread of its own, which begins with the first request. The program has at
/// most one, which serves all of its threads.
class PriorityBroker {
  public:
    /// Requests a real-time priority for a thread of this process. May take seconds, but ends soon
    /// after a stop is requested.
    using Service = std::function<Grant(pid_t thread, const std::stop_token& stop)>;

    explicit PriorityBroker(Service service);
    ~PriorityBroker();
    PriorityBroker(const PriorityBroker&) = delete;
    PriorityBroker& operator=(const PriorityBroker&) = delete;

    /// Returns at once; `grant` gets the service's answer. Without a broker nothing happens.
    static void request(pid_t thread, const std::shared_ptr<SharedGrant>& grant);

  private:
    struct Request {
        pid_t thread{0};
        std::shared_ptr<SharedGrant> grant{};
    };

    void add(Request request);
    void serve(const std::stop_token& stop);

    Service service_;
    std::mutex mutex_{};
    std::condition_variable_any changed_{};
    std::vector<Request> requests_{};
    std::jthread thread_{};  // last: it uses all the others
};

}  // namespace dibhr
