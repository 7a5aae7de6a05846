// A queue of requests, and the thread that takes them to the service.
#include "core/realtime/priority_broker.hpp"

#include <pthread.h>

#include <exception>
#include <utility>

namespace dibhr {

namespace {

/// The program's broker, null while there is none.
struct TheBroker {
    std::mutex mutex{};
    PriorityBroker* broker{nullptr};
};

TheBroker& the_broker() {
    static TheBroker one;
    return one;
}

}  // namespace

void SharedGrant::set(Grant grant) {
    {
        const std::lock_guard lock(mutex_);
        grant_ = std::move(grant);
        is_expected_ = false;
    }
    answered_.notify_all();
}

Grant SharedGrant::get() const {
    const std::lock_guard lock(mutex_);
    return grant_;
}

void SharedGrant::expect() {
    const std::lock_guard lock(mutex_);
    is_expected_ = true;
}

Grant SharedGrant::wait() const {
    std::unique_lock lock(mutex_);
    answered_.wait(lock, [this] { return !is_expected_; });
    return grant_;
}

PriorityBroker::PriorityBroker(Service service) : service_(std::move(service)) {
    const std::lock_guard lock(the_broker().mutex);
    the_broker().broker = this;
}

PriorityBroker::~PriorityBroker() {
    {
        const std::lock_guard lock(the_broker().mutex);
        the_broker().broker = nullptr;
    }
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
    }
    for (const Request& request : requests_) request.grant->set(request.grant->get());
}

void PriorityBroker::request(pid_t thread, const std::shared_ptr<SharedGrant>& grant) {
    const std::lock_guard lock(the_broker().mutex);
    if (the_broker().broker != nullptr) the_broker().broker->add({thread, grant});
}

void PriorityBroker::add(Request request) {
    request.grant->expect();
    {
        const std::lock_guard lock(mutex_);
        requests_.push_back(std::move(request));
    }
    changed_.notify_one();
    if (!thread_.joinable())
        thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

void PriorityBroker::serve(const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "dibhr-priority");
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return !requests_.empty(); })) {
        if (stop.stop_requested()) return;
        const Request request = std::move(requests_.front());
        requests_.erase(requests_.begin());
        lock.unlock();
        Grant grant;
        try {
            grant = service_(request.thread, stop);
        } catch (const std::exception& error) {
            grant.answer = std::string("refused: ") + error.what();
        }
        request.grant->set(std::move(grant));
        lock.lock();
    }
}

}  // namespace dibhr
