// The step in which the user unplugs the cable: what the service reports then.
#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/context.hpp"

namespace dibhr::inverse3 {

namespace {

using Seconds = std::chrono::duration<double>;
using Time = CheckedInverse3::Clock::time_point;

/// What the service reports about a device while its cable is out.
class Absence {
  public:
    bool is_back{true};
    std::string ended_by{};  ///< the error that ended the step; empty: none

    void add(const std::optional<Arm>& arm, Time now) {
        is_back = arm.has_value();
        if (!arm) {
            if (!gone_at_) gone_at_ = now;
            gone_ = std::max<Seconds>(gone_, now - seen_);
            end_stay(now);
            return;
        }
        seen_ = now;
        not_powered_ = not_powered_ || !arm->powered;
        not_calibrated_ = not_calibrated_ || !arm->calibrated;
        not_ready_ = not_ready_ || arm->locked;
        const Vec3 position_m = arm->position_m.value_or(last_m_);
        if (count_++ > 0 && position_m != last_m_) end_stay(now);
        if (!stays_since_) stays_since_ = now;
        last_m_ = position_m;
    }
    /// The user reports that the cable is out. An unchanged position counts as frozen from now on,
    /// as does the one before the entry was removed.
    void cable_is_out(Time now) {
        out_at_ = now;
        if (!is_back) frozen_ = last_stay_;
    }

    [[nodiscard]] std::string in_words(Seconds counts_as_frozen) const {
        std::string words;
        const auto append = [&words](const std::string& more) {
            words += (words.empty() ? "" : ", ") + more;
        };
        if (gone_.count() > 0.0)
            append("it goes (" + number_text(gone_.count(), 1) + " s)");
        else if (frozen_ && *frozen_ > counts_as_frozen)
            append("it stays, frozen (" + number_text(frozen_->count(), 1) + " s)");
        else if (out_at_ && !frozen_)
            append("its position never changed again");
        if (not_powered_) append("told to have no power");
        if (not_calibrated_) append("told not to be calibrated");
        if (not_ready_) append("told not to be ready");
        if (!ended_by.empty()) append("and then: " + ended_by);
        if (words.empty())
            append(out_at_ ? "nothing of it changed" : "nobody said that it was out");
        return words;
    }
    void add_to(Json& measured) const {
        const auto after_out = [&](const std::optional<Time>& at) {
            return out_at_ && at ? Json(Seconds(*at - *out_at_).count()) : Json();
        };
        measured["said_out"] = out_at_.has_value();
        measured["gone_s"] = gone_.count();
        measured["gone_after_enter_s"] = after_out(gone_at_);
        measured["frozen_s"] = frozen_ ? Json(frozen_->count()) : Json();
        measured["told_no_power"] = not_powered_;
        measured["told_not_calibrated"] = not_calibrated_;
        measured["told_not_ready"] = not_ready_;
        measured["is_back"] = is_back;
        measured["ended_by"] = ended_by;
    }

  private:
    /// The position changed, or the entry was removed.
    void end_stay(Time now) {
        if (!stays_since_) return;
        last_stay_ = now - *stays_since_;
        if (out_at_ && !frozen_) frozen_ = last_stay_;
        stays_since_.reset();
    }

    Time seen_{CheckedInverse3::Clock::now()};
    std::optional<Time> out_at_{}, gone_at_{}, stays_since_{};
    Seconds gone_{0.0};  // longest time without an entry
    Seconds last_stay_{0.0};
    std::optional<Seconds> frozen_{};
    bool not_powered_{false}, not_calibrated_{false}, not_ready_{false};  // told meanwhile
    Vec3 last_m_{0.0};
    int count_{0};
};

std::string names_in(const ServiceMessage& message) {
    std::string names;
    for (std::size_t k = 0; k < message.arm_count; ++k)
        names += (names.empty() ? "" : ", ") + one_line(message.arms[k].id.view());
    return names.empty() ? "nothing" : names;
}

/// Polls the device until Enter; false: the time was over.
bool watch(CheckContext& context, const std::string& question, Absence& absence) {
    context.console.ask(question);
    const auto limit = CheckedInverse3::Clock::now() + context.options.times.unplugging;
    while (CheckedInverse3::Clock::now() < limit) {
        if (context.answered()) return true;
        absence.add(context.device.poll(context.likely_dialect()), CheckedInverse3::Clock::now());
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    context.print_timeout(context.options.times.unplugging);
    return false;
}

}  // namespace

void check_unplugged(CheckContext& context, Json& measured) {
    Absence absence;
    try {
        if (watch(context,
                  "Keep the grip moving, pull the USB cable out meanwhile; Enter as soon as it is "
                  "out",
                  absence))
            absence.cable_is_out(CheckedInverse3::Clock::now());
        (void)watch(
            context,
            "Count to five, plug the USB cable in again, wait until the light is as before, "
            "and move the grip; then Enter",
            absence);
    } catch (const DeviceError& failure) {  // a failure is a result, too
        absence.ended_by = failure.what();
    }
    absence.add_to(measured);
    measured["at_the_end"] = names_in(context.device.message());
    context.findings.record_answer(
        OpenQuestion::unplugged,
        absence.in_words(context.options.times.frozen) +
            (absence.is_back ? "" : "; not back, there is " + names_in(context.device.message())));
}

}  // namespace dibhr::inverse3
