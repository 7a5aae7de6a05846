// The step that measures how long a force lasts when its connection ends without a zero force.
#include <glm/geometric.hpp>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/context.hpp"
#include "device/inverse3/check/push.hpp"

namespace dibhr::inverse3 {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

void close_once(CheckContext& context, ForceDialect dialect, CheckTimes::Span closed, ForceEnd& end,
                Json& line) {
    line["closed_ms"] = closed.count();
    Push push(context);
    push.hold(kWeak_newton, dialect, context.options.times.closing_hold);
    const auto pushed_at = context.device.sent_at();
    context.device.drop_connection();
    push.pause_sending(closed);
    const CheckedInverse3::Found found = context.device.reconnect();
    line["gap_ms"] = Milliseconds(CheckedInverse3::Clock::now() - pushed_at).count();
    line["told_unasked"] = found.unrequested;
    if (!found.arm.force_newton) return;
    line["force_newton"] = glm::length(*found.arm.force_newton);
    if (reports_weak_force(*push.last())) {
        end.add(line["gap_ms"].get<double>(), reports_weak_force(found.arm));
    }
}

}  // namespace

void check_closing(CheckContext& context, Json& measured) {
    constexpr double kLongest_s = 60.0;
    const ForceDialect dialect = context.likely_dialect();
    const CheckTimes& times = context.options.times;
    measured["dialect"] = name_of(dialect);
    measured["closings"] = Json::array();
    ForceEnd end;
    for (const CheckTimes::Span closed : times.closings) {
        Json& line = measured["closings"].emplace_back(Json::object());
        close_once(context, dialect, closed, end, line);
    }
    end.add_to(measured);
    const Milliseconds pushed = times.ramp + times.closing_hold;
    const Milliseconds closed = times.closings.back();
    measured["pushed_s"] = pushed.count() / 1000.0;
    std::string words = end.in_words() + ", as reported to the next connection";
    const auto felt_s = context.number("For how many seconds did it pull, the last time? " +
                                           number_text(pushed.count() / 1000.0, 1) +
                                           " if it ended with the connection, " +
                                           number_text((pushed + closed).count() / 1000.0, 1) +
                                           " or more if it went on (Enter alone: not known)",
                                       0.0, kLongest_s);
    measured["felt_s"] = felt_s ? Json(*felt_s) : Json();
    if (felt_s)
        words += "; felt for " + number_text(*felt_s, 1) + " s, of which " +
                 number_text(pushed.count() / 1000.0, 1) + " s before it ended";
    context.findings.record_answer(OpenQuestion::closed, words);
}

}  // namespace dibhr::inverse3
