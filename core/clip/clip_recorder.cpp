// The thread that encodes a clip.
#include "core/clip/clip_recorder.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

/// Gives the calling thread a low priority: the haptic thread replaces it at once. Not SCHED_IDLE,
/// because the window's thread waits for the same mutex; and not the lowest, with which the last
/// pictures take many seconds on a busy machine.
void lower_thread_priority() {
    constexpr int kLow = 10;
    const sched_param none{};
    ::sched_setscheduler(0, SCHED_BATCH, &none);
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLow);
}

}  // namespace

ClipRecorder::ClipRecorder(const std::filesystem::path& file, ClipNameConflict name)
    : file_(file, name), result_(std::async(std::launch::async, [this] { return work(); })) {}

ClipRecorder::~ClipRecorder() {
    const std::scoped_lock lock(mutex_);
    given_up_ = !stopped_;
    stopped_ = true;
    wake_.notify_one();
}

bool ClipRecorder::wants_picture() const {
    const std::scoped_lock lock(mutex_);
    return !stopped_ && !done() && waiting_.size() < kMostWaiting;
}

void ClipRecorder::add(ColourImage picture, Clock::time_point shown) {
    {
        const std::scoped_lock lock(mutex_);
        if (stopped_ || waiting_.size() >= kMostWaiting) return;
        waiting_.push_back({std::move(picture), shown});
    }
    wake_.notify_one();
}

void ClipRecorder::stop(Clock::time_point end, ClipEnd how) {
    const std::scoped_lock lock(mutex_);
    how_ = how;
    if (std::exchange(stopped_, true)) return;
    end_ = end;
    wake_.notify_one();
}

bool ClipRecorder::done() const {
    return done_within(std::chrono::milliseconds(0));
}

bool ClipRecorder::done_within(std::chrono::milliseconds timeout) const {
    return !result_.valid() || result_.wait_for(timeout) == std::future_status::ready;
}

std::uint64_t ClipRecorder::encoded() const {
    const std::scoped_lock lock(mutex_);
    return encoded_;
}

bool ClipRecorder::plays() const {
    const std::scoped_lock lock(mutex_);
    return plays_;
}

std::filesystem::path ClipRecorder::work() {
    lower_thread_priority();
    std::optional<Clock::time_point> begin;
    const auto seconds = [&begin](Clock::time_point at) {
        return std::chrono::duration<double>(at - *begin).count();
    };
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
        if (given_up_) throw InputError("the clip was given up");
        if (waiting_.empty()) break;
        const Shown next = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        if (!begin) begin = next.at;
        file_.add(next.picture, seconds(next.at));
        lock.lock();
        ++encoded_;
        plays_ = file_.plays();
    }
    const Clock::time_point end = begin ? end_ : Clock::time_point{};
    const ClipEnd how = how_;
    lock.unlock();
    return file_.finish(begin ? seconds(end) : 0.0, how);
}

}  // namespace dibhr
