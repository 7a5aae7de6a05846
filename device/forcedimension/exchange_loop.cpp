// The exchange with one opened arm.
#include "device/forcedimension/exchange_loop.hpp"

#include <atomic>
#include <memory>
#include <thread>
#include <utility>

#include "device/forcedimension/models.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::forcedimension {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

// README.md, Safety numbers.
constexpr milliseconds kStatusPeriod{4};
constexpr milliseconds kIdleStatusPeriod{50};  // while the arm waits for a person
constexpr milliseconds kSettle{100};           // from switching the motors on to the first force
constexpr milliseconds kWatchdogPause{500};    // until a force that the watchdog took off is back
constexpr int kMostFailedStatuses = 3;         // in a row: 12 ms
constexpr int kMostFailedExchanges = 10;       // in a row: 5 ms
constexpr milliseconds kLoopIdleAfter{200};    // without a force from the haptic loop

// Pauses between two exchanges.
constexpr microseconds kPause{500};
constexpr microseconds kPauseWithoutLoop{5'000};

constexpr milliseconds kInitialisingPoll{10};
constexpr milliseconds kStopLimit{400};  // until a stopped initialisation has to return

constexpr const char* kInitialiseWarning =
    "The arm will move by itself to all of its stops. Take the grip out of your hand, and keep "
    "hands, cables and objects out of its reach until it stands still.";
constexpr const char* kResetWarning =
    "Hold the end-effector still at its rest position, then go on: the arm takes this position as "
    "its origin. With another position the image is in the wrong place.";
constexpr const char* kByHand =
    "the Force Dimension arm does not know its position: hold its end-effector at its rest "
    "position, then choose Take this position as the rest on the Device panel";
constexpr const char* kForceWarning =
    "Hold the grip: the force comes back, and rises from zero in half a second.";

}  // namespace

ExchangeLoop::ExchangeLoop(const Arm& arm, ArmBuffers& buffers, Board& board,
                           DriverState& driver_state, Offers& offers)
    : arm_(arm),
      library_(arm.library()),
      buffers_(buffers),
      board_(board),
      driver_state_(driver_state),
      offers_(offers),
      last_loop_update_(Clock::now()) {
    driver_state_.exchanges.begin(last_loop_update_);
    driver_state_.trust.begin();
    driver_state_.trust.add_gap();
    buffers_.limits.publish(limits_of(model_of(board_.draft().type)));
}

ExchangeLoop::~ExchangeLoop() {
    buffers_.poses.publish(TimedPose{});  // so that no tick uses an old pose
    driver_state_.buttons.release();
    board_.draft().offer.reset();
}

void ExchangeLoop::run(const std::stop_token& stop) {
    const std::stop_callback wake_to_leave(stop, [this] { buffers_.wake.signal(); });
    while (!stop.stop_requested()) {
        const Time now = Clock::now();
        if (now >= status_due_) follow_status(now, stop);
        if (exchanges()) exchange_once();
        report(Clock::now());
        pause();
    }
    if (exchanges()) library_.set_force(arm_.id(), Vec3{0.0});
}

bool ExchangeLoop::exchanges() const noexcept {
    const Stage stage = board_.draft().stage;
    return prepared_ &&
           (stage == Stage::ready || stage == Stage::slow || stage == Stage::force_off);
}

void ExchangeLoop::follow_status(Time now, const std::stop_token& stop) {
    status_due_ = now + kStatusPeriod;
    const auto status = library_.status(arm_.id());
    if (!status) {
        fail(failed_statuses_, kMostFailedStatuses);
        return;
    }
    failed_statuses_ = 0;
    Stage stage = stage_of(*status, now);
    const bool usable = stage == Stage::ready || stage == Stage::slow || stage == Stage::force_off;
    if (usable && !prepared_) {
        arm_.prepare(board_.draft());
        // The user switches a force on again that a button or the speed has switched off.
        const bool was_cut = !status->force && (status->cause == ForceOff::button ||
                                                status->cause == ForceOff::velocity);
        if (!was_cut) {
            switch_force_on(now);
            stage = Stage::ready;
        }
    }
    if (prepared_ && !usable) leave_exchanges();
    prepared_ = usable;
    enter(stage, status->cause);
    if (usable) buttons_ = driver_state_.buttons.add(library_.buttons(arm_.id()), now);
    follow_offers(now, stop);
    if (!usable) status_due_ = now + kIdleStatusPeriod;
}

/// Just after the motors were switched on, the arm may still report its force as off.
Stage ExchangeLoop::stage_of(const ArmStatus& status, Time now) const noexcept {
    if (!status.power) return Stage::no_power;
    if (status.error) return Stage::fault;
    if (!status.initialised) return Stage::not_initialised;
    if (!status.force && now >= settled_at_) return Stage::force_off;
    return driver_state_.exchanges.delay.within_ms() > kLongestExchange_ms ? Stage::slow
                                                                           : Stage::ready;
}

/// Makes the sentence and the offer of a new stage; for the same stage neither is made again.
void ExchangeLoop::enter(Stage stage, ForceOff cause) {
    Status& status = board_.draft();
    const bool same = status.stage == stage && (stage != Stage::force_off || status.cause == cause);
    if (same && stage_entered_) return;
    stage_entered_ = true;
    status.cause = cause;
    status.offer.reset();
    if (stage != Stage::ready) driver_state_.trust.add_gap();
    if (stage == Stage::not_initialised) {
        status.offer = library_.can_initialise(arm_.id())
                           ? offers_.make("Initialise the arm", kInitialiseWarning)
                           : offers_.make("Take this position as the rest", kResetWarning);
    } else if (stage == Stage::force_off) {
        force_off_since_ = Clock::now();
        if (cause != ForceOff::watchdog)
            status.offer = offers_.make("Switch the force on", kForceWarning);
    }
    const bool trouble = stage == Stage::fault || stage == Stage::slow || stage == Stage::force_off;
    const bool refused = stage == Stage::not_initialised && !refusal_.empty();
    const bool by_hand = stage == Stage::not_initialised && !library_.can_initialise(arm_.id());
    std::string sentence = by_hand ? kByHand : sentence_for(stage, status);
    if (refused) sentence = refusal_;
    board_.enter(stage, sentence, trouble || refused);
}

/// The arm cannot be used any more, though it still answers.
void ExchangeLoop::leave_exchanges() {
    library_.stop(arm_.id());
    publish_pose(std::nullopt, Clock::now());
}

void ExchangeLoop::switch_force_on(Time now) {
    if (!arm_.switch_force_on()) fail(failed_statuses_, kMostFailedStatuses);
    driver_state_.trust.add_gap();
    settled_at_ = now + kSettle;
}

void ExchangeLoop::follow_offers(Time now, const std::stop_token& stop) {
    const Status& status = board_.draft();
    const bool agreed = offers_.taken(status.offer);
    if (status.stage == Stage::force_off) {
        const bool comes_back =
            status.cause == ForceOff::watchdog && now >= force_off_since_ + kWatchdogPause;
        if (agreed || comes_back) {
            switch_force_on(now);
            stage_entered_ = false;  // a refusal makes a new offer
        }
    } else if (status.stage == Stage::not_initialised && agreed) {
        initialise(stop);
        stage_entered_ = false;
    }
}

/// By hand: the user holds the arm at its rest. Else the call returns only when the arm stands
/// still. A thread of its own waits for it, so that the user, and the end of the program, can stop
/// the arm.
void ExchangeLoop::initialise(const std::stop_token& stop) {
    Status& status = board_.draft();
    const std::string refusal = name_of(status) +
                                " could not be initialised: free its way, then "
                                "try again";
    if (!library_.can_initialise(arm_.id())) {
        refusal_ = library_.reset(arm_.id()) ? std::string{} : refusal;
        return;
    }
    status.offer = offers_.make("Stop the arm", {});
    board_.enter(Stage::initialising, sentence_for(Stage::initialising, status));
    enum class Call { moves, succeeded, failed };
    const auto call = std::make_shared<std::atomic<Call>>(Call::moves);
    std::thread moving([call, library = arm_.shared_library(), id = arm_.id()] {
        *call = library->initialise(id) ? Call::succeeded : Call::failed;
    });
    std::optional<Time> stopped_at;
    while (*call == Call::moves) {
        const Time now = Clock::now();
        const bool ends = stop.stop_requested() || Guardian::alarmed();
        if (!stopped_at && (ends || offers_.taken(status.offer))) stopped_at = now;
        if (stopped_at) {  // again and again: the arm may not have begun to move before
            library_.stop_initialising(arm_.id());
            library_.stop(arm_.id());
        }
        if (stopped_at && now >= *stopped_at + kStopLimit) {
            const std::string silent = name_of(status) +
                                       " does not answer while it initialises itself: switch it "
                                       "off and on";
            if (stop.stop_requested()) {
                moving.detach();
                throw ArmLost(silent);
            }
            // The arm is not closed, nor opened again, while a call may still move it.
            board_.enter(Stage::initialising, silent, true);
        }
        std::this_thread::sleep_for(kInitialisingPoll);
    }
    moving.join();
    refusal_ = *call == Call::succeeded || stopped_at ? std::string{} : refusal;
    // Brakes: the motors are switched on for forces only after this.
    library_.stop_initialising(arm_.id());
}

void ExchangeLoop::exchange_once() {
    const Time asked = Clock::now();
    const bool sent = library_.set_force(arm_.id(), current_force(asked));
    const auto position = library_.position_m(arm_.id());
    const Time answered = Clock::now();
    exchanged_at_ = asked;
    driver_state_.exchanges.delay.add(asked, answered);
    // An arm whose force is off may refuse every force: the status tells whether it is.
    if (!sent) status_due_ = asked;
    const bool refused = !sent && board_.draft().stage != Stage::force_off && asked >= settled_at_;
    if (refused || !position) {
        publish_pose(std::nullopt, answered);
        fail(failed_exchanges_, kMostFailedExchanges);
        return;
    }
    failed_exchanges_ = 0;
    ++driver_state_.exchanges.count;
    const bool usable = board_.draft().stage == Stage::ready && answered >= settled_at_;
    driver_state_.trust.add(position, answered, usable);
    publish_pose(position, answered);
}

Vec3 ExchangeLoop::current_force(Time now) {
    if (buffers_.forces.fresh()) last_loop_update_ = now;
    return buffers_.force_for(epoch(), now);
}

Epoch ExchangeLoop::epoch() const noexcept {
    return board_.draft().stage == Stage::ready ? driver_state_.trust.epoch() : kNoEpoch;
}

void ExchangeLoop::publish_pose(const std::optional<Vec3>& position_m, Time at) {
    if (!position_m) driver_state_.trust.add_gap();
    TimedPose& pose = buffers_.poses.back();
    pose.epoch = epoch();
    pose.exchange_ms = driver_state_.exchanges.delay.within_ms();
    pose.position_m = position_m.value_or(Vec3{0.0});
    pose.buttons = buttons_;
    pose.at = at;
    pose.number = driver_state_.exchanges.count;
    buffers_.poses.publish();
}

/// One call without an answer takes the force off; several in a row end the connection.
void ExchangeLoop::fail(int& in_a_row, int most) {
    ++driver_state_.failed_calls;
    driver_state_.trust.add_gap();
    if (++in_a_row < most) return;
    const int error = library_.last_error();
    throw ArmLost(name_of(board_.draft()) + " does not answer (error " + std::to_string(error) +
                  "): check its USB cable and its power");
}

void ExchangeLoop::report(Time now) {
    Status& status = board_.draft();
    status.presses = driver_state_.buttons.presses();
    status.pressed_at = driver_state_.buttons.pressed_at();
    status.failed_calls = driver_state_.failed_calls;
    driver_state_.exchanges.report(status, now);
    board_.publish_if_due(now);
}

/// Waits until the haptic loop has a new force, or the next exchange is due.
void ExchangeLoop::pause() {
    if (!exchanges()) {
        buffers_.wake.wait_until(status_due_);
        return;
    }
    const bool idle = Clock::now() - last_loop_update_ > kLoopIdleAfter;
    const Time until = exchanged_at_ + (idle ? kPauseWithoutLoop : kPause);
    while (!buffers_.forces.fresh() && Clock::now() < until) buffers_.wake.wait_until(until);
}

}  // namespace dibhr::forcedimension
