// The thread that reads, and tries again when a connection fails.
#include "core/video/live/live_stream.hpp"

#include <pthread.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr std::chrono::milliseconds kFirstRest{100};  ///< before the next try; then longer
constexpr std::chrono::milliseconds kLongestRest{1000};

}  // namespace

LiveStream::LiveStream(LiveName name, std::string shown, Take take, std::function<void()> refused)
    : name_(std::move(name)),
      shown_(std::move(shown)),
      take_(std::move(take)),
      refused_(std::move(refused)) {
    thread_ = std::thread([this] { run(); });
}

LiveStream::~LiveStream() {
    {
        const std::lock_guard lock(mutex_);
        wants_.leaving = true;
    }
    leave_.notify_one();
    thread_.join();
}

void LiveStream::want(bool colour, bool levels) {
    wants_.colour = colour;
    wants_.levels = levels;
}

std::string LiveStream::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void LiveStream::run() {
    pthread_setname_np(pthread_self(), "dibhr-live");
    std::chrono::milliseconds pause = kFirstRest;
    while (connect()) {
        pause = std::exchange(began_, false) ? kFirstRest : std::min(2 * pause, kLongestRest);
        if (!rest(pause)) return;
    }
}

void LiveStream::tell(std::string trouble) {
    const std::lock_guard lock(mutex_);
    trouble_ = std::move(trouble);
}

/// Runs one connection. False: the thread must end, as at the end of standard input.
bool LiveStream::connect() {
    const bool once = name_.kind == LiveKind::pipe && name_.url.empty();
    try {
        LiveInput input(name_, shown_, wants_, heard_);
        tell({});
        for (LivePicture picture; input.read(picture);) {
            began_ = true;
            if (!take_(std::move(picture))) return false;
        }
        if (once && !wants_.leaving)
            throw LiveRefusal(shown_ + (began_ ? " has ended" : " ended without a picture") +
                              ": let the program that writes into it go on");
    } catch (const LiveRefusal& refusal) {
        tell(refusal.what());
        refused_();
        if (once) return false;
    } catch (const std::exception& error) {
        tell(error.what());
    }
    return !wants_.leaving;
}

bool LiveStream::rest(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !leave_.wait_for(lock, time, [this] { return wants_.leaving.load(); });
}

}  // namespace dibhr
