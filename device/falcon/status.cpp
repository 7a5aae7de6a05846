// Where the USB thread writes the status and the window reads it.
#include "device/falcon/status.hpp"

#include <utility>

namespace dibhr::falcon {

namespace {

constexpr std::chrono::milliseconds kPeriod{20};  // more often than any screen shows

}  // namespace

Status StatusBoard::read() const {
    const std::lock_guard lock(mutex_);
    return published_;
}

void StatusBoard::publish() {
    const std::lock_guard lock(mutex_);
    published_ = draft_;
}

void StatusBoard::publish_if_due(Time now) {
    if (now - published_at_ < kPeriod) return;
    // The window is reading: it must not hold up a reply. The next one will do.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    published_at_ = now;
    published_ = draft_;
}

void StatusBoard::enter(Stage stage, std::string sentence, bool trouble) {
    draft_.stage = stage;
    draft_.sentence = std::move(sentence);
    draft_.trouble = trouble;
    publish();
}

}  // namespace dibhr::falcon
