// Grants that come later than their refusal.
#include "core/realtime/priority_broker.hpp"

#include <memory>
#include <stdexcept>
#include <stop_token>
#include <vector>

#include "tests/support/catch.hpp"

using dibhr::Grant;
using dibhr::PriorityBroker;
using dibhr::SharedGrant;

namespace {

std::shared_ptr<SharedGrant> refused() {
    auto grant = std::make_shared<SharedGrant>();
    grant->set({false, "refused: by the limits"});
    return grant;
}

}  // namespace

TEST_CASE("each thread's refusal is replaced by the service's answer about that thread",
          "[threads]") {
    const PriorityBroker broker([](pid_t thread, const std::stop_token&) -> Grant {
        if (thread == 3) throw std::runtime_error("no memory");
        return {thread == 1, thread == 1 ? "SCHED_RR 20" : "refused: by the service"};
    });
    std::vector<std::shared_ptr<SharedGrant>> grants;
    for (const pid_t thread : {1, 2, 3}) {
        grants.push_back(refused());
        PriorityBroker::request(thread, grants.back());
    }
    CHECK(grants[0]->wait().granted);
    CHECK(grants[0]->get().answer == "SCHED_RR 20");
    CHECK(grants[1]->wait().answer == "refused: by the service");
    CHECK(grants[2]->wait().answer == "refused: no memory");
}

TEST_CASE("without a broker, and where it ends before its service answers, the refusal stays",
          "[threads]") {
    const auto unasked = refused();
    PriorityBroker::request(1, unasked);
    CHECK(unasked->wait().answer == "refused: by the limits");
    const auto asked = refused();
    const auto waiting = refused();
    {
        const PriorityBroker broker([](pid_t, const std::stop_token& stop) -> Grant {
            while (!stop.stop_requested()) std::this_thread::yield();
            return {false, "refused: stopped"};
        });
        PriorityBroker::request(1, asked);
        PriorityBroker::request(2, waiting);
    }
    CHECK_FALSE(asked->wait().granted);
    CHECK(waiting->wait().answer == "refused: by the limits");
}
