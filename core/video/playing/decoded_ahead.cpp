// A queue of decoded frames, bounded in number and bytes.
#include "core/video/playing/decoded_ahead.hpp"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/realtime/time_slice.hpp"
#include "core/video/playing/frame_plan.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kConsecutiveReads = 2;  ///< reads in a row: more will follow
constexpr std::size_t kMostAhead = 4;
constexpr double kMostSkipped_s = 0.5;  ///< in one call: the heartbeat goes on, stop works
constexpr std::size_t kMostBytes = std::size_t{24} << 20;  ///< one frame always fits

std::size_t bytes_of(const RawFrame& frame) {
    const std::size_t colour = frame.video ? frame.video->bytes : frame.colour.rgb.size();
    return frame.depth.levels.size() * sizeof(float) + colour +
           frame.held.size() * sizeof(HeldLevel);
}

}  // namespace

DecodedAhead::DecodedAhead(std::unique_ptr<Media> media, ReaderHeartbeats heartbeats, Now now)
    : media_(std::move(media)),
      heartbeats_(heartbeats),
      now_(std::move(now)),
      description_(media_->description()) {
    thread_ = std::thread([this] { run(); });
}

DecodedAhead::~DecodedAhead() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_decoder_.notify_one();
    thread_.join();
}

std::optional<RawFrame> DecodedAhead::next_from(double earliest_s, double spacing_s) {
    std::optional<RawFrame> passed;
    do {
        Decoded taken;
        {
            std::unique_lock lock(mutex_);
            ++consecutive_reads_;
            from_s_ = spacing_s > 0.0 ? std::max(from_s_, earliest_s) : earliest_s;
            spacing_s_ = spacing_s;
            if (!can_be_read()) wait(lock);
            if (passed && is_at_end()) return passed;
            taken = take(earliest_s);
        }
        description_ = std::move(taken.description);
        conversion_s_ = taken.conversion_s;
        if (taken.error) std::rethrow_exception(taken.error);
        passed = std::move(taken.frame);
    } while (passed && passed->media_s < earliest_s);
    return passed;
}

bool DecodedAhead::is_at_end() const {
    return !decoded_.front().frame && !decoded_.front().error;
}

DecodedAhead::Decoded DecodedAhead::take(double earliest_s) {
    Decoded taken = std::move(decoded_.front());
    decoded_.pop_front();
    bytes_ -= taken.bytes;
    const bool given_out = taken.frame && !(taken.frame->media_s < earliest_s);
    if (given_out) apply_spacing(*taken.frame);
    wake_decoder_.notify_one();
    return taken;
}

void DecodedAhead::apply_spacing(const RawFrame& frame) {
    if (spacing_s_ > 0.0) from_s_ = std::max(from_s_, next_shown_s(frame.media_s, spacing_s_));
}

void DecodedAhead::wait(std::unique_lock<std::mutex>& lock) {
    if (heartbeats_.reading != nullptr) heartbeats_.reading->set_idle();
    reader_waits_ = true;
    wake_decoder_.notify_one();
    wake_reader_.wait(lock, [this] { return can_be_read(); });
    reader_waits_ = false;
    if (heartbeats_.reading != nullptr) heartbeats_.reading->beat();
}

void DecodedAhead::seek(double media_s) {
    jump({media_s, Jump::exact}, Begins::when_read);
}

void DecodedAhead::decode_from(double media_s) {
    jump({media_s, Jump::exact}, Begins::at_once);
}

void DecodedAhead::seek_near(double media_s) {
    jump({media_s, Jump::near}, Begins::when_read);
}

void DecodedAhead::seek_depth(double media_s) {
    jump({media_s, Jump::depth}, Begins::when_read);
}

void DecodedAhead::leave_out_depth(const FrameTimes& times) {
    const std::lock_guard lock(mutex_);
    leave_out_ = times;
}

void DecodedAhead::jump(Target target, Begins begins) {
    {
        const std::lock_guard lock(mutex_);
        target_ = target;
        decoded_.clear();
        bytes_ = 0;
        from_s_ = spacing_s_ = 0.0;
        consecutive_reads_ = begins == Begins::at_once ? kConsecutiveReads : 0;
        ended_ = false;
    }
    if (begins == Begins::at_once) wake_decoder_.notify_one();
}

void DecodedAhead::prepare_with(Preparation preparation) {
    auto shared =
        preparation ? std::make_shared<const Preparation>(std::move(preparation)) : nullptr;
    {
        const std::lock_guard lock(mutex_);
        preparation_ = std::move(shared);
    }
    wake_decoder_.notify_one();
}

bool DecodedAhead::can_be_read() const {
    return !decoded_.empty() && decoded_.front().prepared != Prepared::now;
}

/// The oldest frame to prepare; null: there is none, or the reader waits and takes it unprepared.
DecodedAhead::Decoded* DecodedAhead::unprepared() {
    if (!preparation_ || reader_waits_) return nullptr;
    const auto found = std::find_if(decoded_.begin(), decoded_.end(), [](const Decoded& decoded) {
        return decoded.frame && decoded.prepared == Prepared::no;
    });
    return found == decoded_.end() ? nullptr : &*found;
}

bool DecodedAhead::has_room() const {
    if (decoded_.empty() && reader_waits_) return true;
    if (ended_ || consecutive_reads_ < kConsecutiveReads) return false;
    return decoded_.empty() ||
           (decoded_.size() < kMostAhead && bytes_ + decoded_.back().bytes <= kMostBytes);
}

DecodedAhead::Decoded DecodedAhead::decode(const std::optional<Target>& target,
                                           const std::optional<FrameTimes>& leave_out,
                                           double from_s) {
    Decoded decoded;
    const auto begin = now_();
    try {
        if (leave_out) media_->leave_out_depth(*leave_out);
        if (target && target->jump == Jump::exact) media_->seek(target->media_s);
        if (target && target->jump == Jump::near) media_->seek_near(target->media_s);
        if (target && target->jump == Jump::depth) media_->seek_depth(target->media_s);
        if (target) last_s_ = target->media_s;
        from_s = std::min(from_s, last_s_ + kMostSkipped_s);
        decoded.frame = from_s > last_s_ ? media_->next_from(from_s) : media_->next();
    } catch (...) {
        decoded.error = std::current_exception();
    }
    const std::chrono::duration<double> taken = now_() - begin;
    decoded.description = media_->description();
    if (!decoded.frame) return decoded;
    const RawFrame& frame = *decoded.frame;
    decoded.bytes = bytes_of(frame);
    const auto frames = static_cast<double>(frame.index - last_index_);
    if (!target && frame.skipping_s > 0.0)
        decoded.conversion_s = std::max(taken.count() - frames * frame.skipping_s, 0.0);
    last_s_ = frame.media_s;
    last_index_ = frame.index;
    return decoded;
}

void DecodedAhead::decode_one(std::unique_lock<std::mutex>& lock) {
    const std::optional<Target> target = std::exchange(target_, std::nullopt);
    const auto leave_out = target ? std::exchange(leave_out_, std::nullopt) : std::nullopt;
    const double from_s = from_s_;
    lock.unlock();
    Decoded decoded = decode(target, leave_out, from_s);
    lock.lock();
    if (target_) return;  // a jump was requested meanwhile
    ended_ = !decoded.frame;
    bytes_ += decoded.bytes;
    const bool wanted = decoded.frame && !(decoded.frame->media_s < from_s_);
    if (wanted) apply_spacing(*decoded.frame);
    decoded_.push_back(std::move(decoded));
    wake_reader_.notify_one();
}

/// The frame keeps its place in the queue; a reader that reaches it waits.
void DecodedAhead::prepare(Decoded& waiting, std::unique_lock<std::mutex>& lock) {
    waiting.prepared = Prepared::now;
    RawFrame frame = std::move(*waiting.frame);
    const std::shared_ptr<const Preparation> preparation = preparation_;
    lock.unlock();
    std::exception_ptr error;
    try {
        (*preparation)(frame);
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    if (target_) return;  // a jump dropped the frame meanwhile
    waiting.frame = std::move(frame);
    waiting.error = error;
    waiting.prepared = Prepared::yes;
    wake_reader_.notify_one();
}

void DecodedAhead::run() {
    pthread_setname_np(pthread_self(), "dibhr-decode");
    (void)set_time_slice(kPatientSlice);
    if (heartbeats_.decoding != nullptr) heartbeats_.decoding->count_computing_as_beat();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_decoder_.wait(lock,
                           [this] { return stopping_ || has_room() || unprepared() != nullptr; });
        if (stopping_) return;
        if (heartbeats_.decoding != nullptr) heartbeats_.decoding->beat();
        if (has_room())
            decode_one(lock);
        else
            prepare(*unprepared(), lock);
        if (heartbeats_.decoding != nullptr) heartbeats_.decoding->set_idle();
    }
}

}  // namespace dibhr
