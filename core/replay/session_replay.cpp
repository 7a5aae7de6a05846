// A recorded session run again, tick by tick, and compared with the recording.
#include "core/replay/session_replay.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iomanip>
#include <sstream>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostKept = std::size_t{1} << 16;  // half a megabyte, of over a minute
constexpr double kWarmUp_s = 1.0;
constexpr double kLongestWarmUp_s = 10.0;  // a person waits for it
constexpr int kNameWidth = 14;
constexpr int kCellWidth = 10;

std::string cell(double value) {
    std::ostringstream text;
    const bool small = value != 0.0 && std::abs(value) < 1e-3;
    text << ' ' << std::right << std::setw(kCellWidth - 1) << (small ? std::scientific : std::fixed)
         << std::setprecision(small ? 1 : 3) << value;
    return text.str();
}

}  // namespace

double warm_up_s(const Session& session, double from_s) {
    const std::int64_t latest = session.tick_at(from_s - kWarmUp_s);
    const std::int64_t earliest = session.tick_at(from_s - kLongestWarmUp_s);
    auto query = session.reader().rows("SELECT t FROM tick WHERE NOT contact AND tick BETWEEN " +
                                       std::to_string(earliest) + " AND " + std::to_string(latest) +
                                       " ORDER BY tick DESC LIMIT 1");
    return query.next() ? query.real(0) : from_s - kLongestWarmUp_s;
}

SessionReplay::SessionReplay(const Session& session, RecordedSurfaces& frames,
                             std::vector<ParameterChange> changes, double from_s)
    : session_(session), frames_(frames), ticks_(session, from_s), runs_(changes.size()) {
    for (std::size_t k = 0; k < changes.size(); ++k) runs_[k].change = std::move(changes[k]);
}

bool SessionReplay::next() {
    if (!ticks_.next(tick_)) return false;
    if (tick_.surface) {
        take_parameters();
        take_frames();
    }
    for (Run& run : runs_) run_tick(run);
    return true;
}

void SessionReplay::take_parameters() {
    if (parameters_ != nullptr && parameters_->version == tick_.settings) return;
    parameters_ = session_.parameters_of(tick_.settings);
    if (parameters_ == nullptr)
        refuse_tick("does not say with which parameters tick ",
                    " was felt; it can be exported, but not replayed");
    bump_ = frames_.bump(*parameters_);
    for (Run& run : runs_) {
        run.parameters = parameters_->touch;
        if (run.change) run.change(run.parameters);
    }
}

void SessionReplay::take_frames() {
    const FramePair& wanted = tick_.frames;
    if (touched_ && pair_ == wanted && pair_number_ == tick_.pair) return;
    if (session_.source_of(wanted.source) == nullptr)
        refuse_tick("does not say which video tick ",
                    " touched; it can be exported, but not replayed");
    const bool carries = std::any_of(runs_.begin(), runs_.end(),
                                     [](const Run& run) { return run.parameters.carry; });
    auto touched = std::make_shared<const TouchedFrames>(frames_.touched(
        tick_, {wanted.source.motion || carries, wanted.source.in_betweens}, touched_.get()));
    if (!DepthBlend{&touched->from, &touched->to}.makes_surface())
        refuse_tick("the frames at tick ", " make no surface; put the original video back");
    touched_ = std::move(touched);
    pair_ = wanted;
    pair_number_ = tick_.pair;
}

TouchedFrames RecordedFrames::touched(const TickRecord& tick, const MotionRequest& wanted,
                                      const TouchedFrames* before) {
    const FramePair& pair = tick.frames;
    // Mostly, the frame that was blended into is the next one to start from.
    const bool goes_on =
        before != nullptr && last_.source == pair.source && last_.to_s == pair.from_s;
    TouchedFrames touched;
    touched.from = goes_on ? before->to : frame(pair.source, pair.from_s);
    touched.to = pair.to_s == pair.from_s ? touched.from : frame(pair.source, pair.to_s);
    connect(touched.from, touched.to, wanted);
    last_ = pair;
    return touched;
}

void SessionReplay::refuse_tick(const std::string& before, const std::string& after) const {
    throw InputError(session_.file().string() + ": " + before +
                     std::to_string(session_.count_of(tick_.tick)) + after);
}

void SessionReplay::run_tick(Run& run) {
    if (!tick_.surface) {
        run.run.pause();
        run.left_known = false;
        return;
    }
    run.run.run(tick_, {&touched_->from, &touched_->to, tick_.blend}, bump_.get(), run.parameters,
                *parameters_);
    run.left_known = !frames_.holds(run.run.read(), tick_.blend);
}

bool same_bits(const Touch& touch, const TickRecord& recorded) noexcept {
    return same_bits(touch.goal, recorded.goal) &&
           same_bits(touch.proxy.position, recorded.proxy) &&
           same_bits(touch.spring_force_newton, recorded.spring_newton) &&
           same_bits(touch.sent_force_newton, recorded.sent_newton) &&
           touch.proxy.contact == recorded.contact &&
           static_cast<std::uint8_t>(touch.proxy.active.kind) == recorded.primitive &&
           touch.proxy.active.i == recorded.i && touch.proxy.active.j == recorded.j &&
           touch.proxy.moves == recorded.moves &&
           static_cast<std::uint8_t>(touch.cut) == recorded.cut;
}

void Samples::add(double value) {
    if (spread_.count() % stride_ == 0) kept_.push_back(value);
    if (kept_.size() == kMostKept) {
        for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = kept_[2 * k];
        kept_.resize(kMostKept / 2);
        stride_ *= 2;
    }
    spread_.add(value);
    highest_ = std::max(highest_, value);
}

SampleStatistics Samples::statistics() const {
    SampleStatistics statistics = statistics_of(kept_);
    statistics.count = spread_.count();
    statistics.mean = spread_.mean();
    statistics.highest = highest_;
    return statistics;
}

void RunComparison::add(const TickRecord& recorded, const Touch& touch, double update_us,
                        bool left_known) {
    if (!same_bits(touch, recorded)) {
        ++differing_;
        if (!first_difference_) first_difference_ = {recorded, touch};
    }
    ++ticks_;
    if (!recorded.surface) return;
    ++updates_;
    if (touch.proxy.bound_met) ++bounds_met_;
    if (left_known) ++left_known_;
    time_us_.add(update_us);
    off_px_.add(glm::length(touch.proxy.position - recorded.proxy));
    const Vec3 lag = touch.proxy.position - touch.goal;
    const bool contact = touch.proxy.contact;
    if (contact) ++in_contact_;
    if (contact && recorded.contact) {
        const Vec3 recorded_lag = recorded.proxy - recorded.goal;
        astray_deg_.add(kDegPerRad * angle_between_rad(lag, recorded_lag));
    }
    if (contact && last_lag_) turn_deg_.add(kDegPerRad * angle_between_rad(*last_lag_, lag));
    last_lag_ = contact ? std::optional(lag) : std::nullopt;
}

double RunComparison::contact_share() const noexcept {
    return static_cast<double>(in_contact_) /
           static_cast<double>(std::max<std::int64_t>(ticks_, 1));
}

std::vector<std::pair<std::string, double>> RunComparison::numbers() const {
    const SampleStatistics off = off_px_.statistics();
    const SampleStatistics astray = astray_deg_.statistics();
    return {{"force_turn_deg", turn_deg_.statistics().mean},
            {"force_turn_sd_deg", turn_deg_.sd()},
            {"proxy_off_mean_px", off.mean},
            {"proxy_off_max_px", off.highest},
            {"force_off_mean_deg", astray.mean},
            {"force_off_max_deg", astray.highest},
            {"contact_share", contact_share()}};
}

std::string RunComparison::table_row(const std::string& name) const {
    const SampleStatistics time = time_us_.statistics();
    const SampleStatistics off = off_px_.statistics();
    const SampleStatistics astray = astray_deg_.statistics();
    std::ostringstream text;
    text << "  " << std::left << std::setw(kNameWidth) << name;
    for (const double value :
         {time.mean, time.median, time.p99, turn_deg_.statistics().mean, turn_deg_.sd(), off.mean,
          off.highest, astray.mean, astray.highest, 100.0 * contact_share()}) {
        text << cell(value);
    }
    return text.str() + "\n";
}

std::string comparison_heading() {
    std::ostringstream text;
    const auto line = [&text](std::initializer_list<const char*> heads) {
        text << "  " << std::left << std::setw(kNameWidth) << "";
        for (const char* head : heads)
            text << ' ' << std::right << std::setw(kCellWidth - 1) << head;
        text << '\n';
    };
    line({"update", "update", "update", "force", "force", "proxy off", "proxy off", "force off",
          "force off", "in"});
    line({"mean us", "median us", "p99 us", "turn deg", "sd deg", "mean px", "max px", "mean deg",
          "max deg", "contact %"});
    return text.str();
}

}  // namespace dibhr
