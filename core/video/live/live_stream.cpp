// The thread that reads, and tries again when a connection fails.
#include "core/video/live/live_stream.hpp"

#include <pthread.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr std::chrono::milliseconds kFirstRetry{100};  ///< before the next try; then longer
constexpr std::chrono::milliseconds kLongestRetry{1000};

}  // namespace

LiveStream::LiveStream(LiveName name, std::string shown, Take take,
                       std::function<void()> permanent_error)
    : name_(std::move(name)),
      shown_(std::move(shown)),
      take_(std::move(take)),
      on_permanent_error_(std::move(permanent_error)) {
    thread_ = std::thread([this] { run(); });
}

LiveStream::~LiveStream() {
    {
        const std::lock_guard lock(mutex_);
        control_.stopping = true;
    }
    stop_requested_.notify_one();
    thread_.join();
}

void LiveStream::set_outputs(bool colour, bool levels) {
    control_.colour = colour;
    control_.levels = levels;
}

std::string LiveStream::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void LiveStream::run() {
    pthread_setname_np(pthread_self(), "dibhr-live");
    std::chrono::milliseconds pause = kFirstRetry;
    while (connect()) {
        pause = std::exchange(picture_received_, false) ? kFirstRetry
                                                        : std::min(2 * pause, kLongestRetry);
        if (!wait_to_retry(pause)) return;
    }
}

void LiveStream::set_trouble(std::string trouble) {
    const std::lock_guard lock(mutex_);
    trouble_ = std::move(trouble);
}

/// Runs one connection. False: the thread must end, as at the end of standard input.
bool LiveStream::connect() {
    const bool once = name_.kind == LiveKind::pipe && name_.url.empty();
    try {
        LiveInput input(name_, shown_, control_, last_packet_);
        set_trouble({});
        for (LivePicture picture; input.read(picture);) {
            picture_received_ = true;
            if (!take_(std::move(picture))) return false;
        }
        if (once && !control_.stopping)
            throw LivePermanentError(
                shown_ + (picture_received_
                              ? " has ended: start dibhr again to see more of it"
                              : " ended without a picture: let the program that writes into it "
                                "send a video"));
    } catch (const LivePermanentError& refusal) {
        set_trouble(refusal.what());
        on_permanent_error_();
        if (once) return false;
    } catch (const std::exception& error) {
        set_trouble(error.what());
    }
    return !control_.stopping;
}

bool LiveStream::wait_to_retry(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !stop_requested_.wait_for(lock, time, [this] { return control_.stopping.load(); });
}

}  // namespace dibhr
