// The steps with force: its format, how long it lasts, and how strong it is.
#include <glm/geometric.hpp>

#include <array>
#include <string>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/context.hpp"
#include "device/inverse3/check/push.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr double kHeaviest_g = 2000.0;
constexpr std::array kOnTheScale_newton{1.0, 2.0, 3.0, 4.0};  // the last is the viewer's own limit

/// The status in_use before a force of ours, at its end, and after it.
struct InUse {
    bool before{false}, during{false}, after{false};

    [[nodiscard]] const char* in_words() const {
        if (before) return "set before any force: by another program, by us without one, or always";
        if (!during && !after) return "stays off while we push: another program";
        return after ? "set by our force, and stays: us, too" : "set by our force: us, too";
    }
};

/// Result of a force in one dialect.
struct DialectTrial {
    ForceDialect dialect{};
    bool reported{false};
    bool felt{false};

    [[nodiscard]] std::string in_words() const {
        const std::string name = name_of(dialect);
        if (felt) return name + " is felt" + (reported ? " and confirmed by the service" : "");
        return name + (reported ? " is confirmed by the service but not felt" : " is not felt");
    }
};

DialectTrial try_dialect(CheckContext& context, ForceDialect dialect, InUse& in_use, Json& part) {
    DialectTrial found{dialect};
    try {
        Push push(context);
        push.hold(kWeak_newton, dialect, context.options.times.dialect);
        push.add_to(part);
        found.reported = reports_weak_force(*push.last());
        in_use.during = in_use.during || push.last()->in_use;
    } catch (const LinkError&) {
        throw;
    } catch (const DeviceError& complaint) {
        part["complaint"] = complaint.what();
    }
    // Asked after the force has ended.
    found.felt = context.yes_or_no(std::string("Did the grip pull to the left with \"") +
                                   name_of(dialect) + "\"?");
    part["told_back"] = found.reported;
    part["felt"] = found.felt;
    return found;
}

/// A reported force proves only that the service understood: the settings get only a felt dialect.
void choose_dialect(CheckContext& context, const std::array<DialectTrial, 2>& trials) {
    std::string words = trials[0].in_words() + "; " + trials[1].in_words();
    bool any_felt = false;
    for (const DialectTrial& one : trials) {
        if (one.felt && !any_felt) context.dialect = one.dialect;
        if (one.reported && !context.dialect) context.dialect = one.dialect;
        any_felt = any_felt || one.felt;
    }
    if (any_felt)
        context.findings.set("dialect", '"' + std::string(name_of(*context.dialect)) + '"');
    if (!any_felt && context.dialect) words += "; so no line for the settings file follows";
    context.findings.record_answer(OpenQuestion::dialect, words);
}

/// Pushes, pauses, and reads whether the service still reports the force.
void measure_silence(CheckContext& context, ForceDialect dialect, CheckTimes::Span silence,
                     ForceEnd& end, Json& line) {
    line["silence_ms"] = silence.count();
    Push push(context);
    push.hold(kWeak_newton, dialect, context.options.times.short_hold);
    if (!push.last()->force_newton) return;
    line["force_before_newton"] = glm::length(*push.last()->force_newton);
    const auto pushed_at = context.device.sent_at();
    push.pause_sending(silence);
    const Arm after = context.device.exchange(std::nullopt, dialect).arm;
    const std::chrono::duration<double, std::milli> gap = context.device.sent_at() - pushed_at;
    line["gap_ms"] = gap.count();
    line["force_newton"] = after.force_newton ? Json(glm::length(*after.force_newton)) : Json();
    if (reports_weak_force(*push.last())) end.add(gap.count(), reports_weak_force(after));
}

/// Presses once; a key ends it early.
void press(CheckContext& context, double wanted_newton, Json& part) {
    Push push(context);
    bool released = false;
    try {
        push.hold({0.0, 0.0, -wanted_newton}, context.likely_dialect(), context.options.times.hold);
    } catch (const ForceReleased&) {
        released = true;
    }
    part["let_go"] = released;
    push.add_to(part);
}

}  // namespace

void check_dialect(CheckContext& context, Json& measured) {
    InUse in_use;
    in_use.before = context.device.exchange(std::nullopt, context.likely_dialect()).arm.in_use;
    std::array<DialectTrial, 2> trials{DialectTrial{ForceDialect::vector},
                                       DialectTrial{ForceDialect::values}};
    for (DialectTrial& one : trials) {
        if (one.dialect == ForceDialect::values) {
            context.agree_to_force("F and Enter = pull with the other format, s = skip, q = quit");
        }
        Json& part = measured[name_of(one.dialect)] = Json::object();
        one = try_dialect(context, one.dialect, in_use, part);
    }
    choose_dialect(context, trials);
    in_use.after = context.device.exchange(std::nullopt, context.likely_dialect()).arm.in_use;
    measured["in_use"] = {
        {"before", in_use.before}, {"during", in_use.during}, {"after", in_use.after}};
    if (context.dialect)
        context.findings.record_answer(OpenQuestion::in_use, in_use.in_words());  // a force acted
}

void check_silence(CheckContext& context, Json& measured) {
    const ForceDialect dialect = context.likely_dialect();
    measured["dialect"] = name_of(dialect);
    measured["silences"] = Json::array();
    ForceEnd end;
    for (const CheckTimes::Span silence : context.options.times.silences) {
        Json& line = measured["silences"].emplace_back(Json::object());
        measure_silence(context, dialect, silence, end, line);
        if (!line.contains("force_before_newton")) {
            context.console.print(
                "This service does not report its force: it cannot be measured in this way.");
            throw StepSkipped{};
        }
    }
    end.add_to(measured);
    context.findings.record_answer(
        OpenQuestion::silence,
        end.in_words() + ", as reported for a message without force, which may itself end it");
}

void check_force(CheckContext& context, Json& measured) {
    std::string words;
    measured["pushes"] = Json::array();
    for (const double wanted_newton : kOnTheScale_newton) {
        context.agree_to_force("F and Enter = press with " + number_text(wanted_newton, 0) +
                               " N, s = skip, q = quit");
        Json& part = measured["pushes"].emplace_back(Json{{"wanted_newton", wanted_newton}});
        press(context, wanted_newton, part);
        const bool released = part["let_go"].get<bool>();
        if (released) context.console.print("Released: there is no force any more.");
        if (released && !(part.value("held_s", 0.0) > 0.0)) continue;
        const auto grams = context.number(
            "Grams that the scale showed while the force acted, at its end (Enter alone: not read)",
            0.0, kHeaviest_g);
        if (!grams) continue;
        const double scale_newton = *grams * kStandardGravity / 1000.0;
        const double share = scale_newton / wanted_newton;
        part["grams"] = *grams;
        part["newton"] = scale_newton;
        part["share"] = share;
        if (released) continue;
        words += (words.empty() ? "" : ", ") + number_text(scale_newton, 2) + " N of " +
                 number_text(wanted_newton, 0) + " (" + number_text(100.0 * share, 0) + " %)";
        context.findings.record_answer(OpenQuestion::force, words);
    }
}

}  // namespace dibhr::inverse3
