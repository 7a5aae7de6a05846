// The steps with force: its format, how long it lasts, and how strong it is.
#include <glm/geometric.hpp>

#include <array>
#include <string>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/desk.hpp"
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
struct Spelled {
    ForceDialect dialect{};
    bool told{false};
    bool felt{false};

    [[nodiscard]] std::string in_words() const {
        const std::string name = name_of(dialect);
        if (felt) return name + " is felt" + (told ? " and confirmed by the service" : "");
        return name + (told ? " is confirmed by the service but not felt" : " is not felt");
    }
};

Spelled pull_with(CheckDesk& desk, ForceDialect dialect, InUse& in_use, Json& part) {
    Spelled found{dialect};
    try {
        Push push(desk);
        push.hold(kWeak_newton, dialect, desk.options.times.dialect);
        push.add_to(part);
        found.told = tells_weak_force(*push.last());
        in_use.during = in_use.during || push.last()->in_use;
    } catch (const LinkError&) {
        throw;
    } catch (const DeviceError& complaint) {
        part["complaint"] = complaint.what();
    }
    // Asked after the force has ended.
    found.felt = desk.yes_or_no(std::string("Did the grip pull to the left with \"") +
                                name_of(dialect) + "\"?");
    part["told_back"] = found.told;
    part["felt"] = found.felt;
    return found;
}

/// A reported force proves only that the service understood: the settings get only a felt dialect.
void choose_dialect(CheckDesk& desk, const std::array<Spelled, 2>& spelled) {
    std::string words = spelled[0].in_words() + "; " + spelled[1].in_words();
    bool any_felt = false;
    for (const Spelled& one : spelled) {
        if (one.felt && !any_felt) desk.dialect = one.dialect;
        if (one.told && !desk.dialect) desk.dialect = one.dialect;
        any_felt = any_felt || one.felt;
    }
    if (any_felt) desk.findings.set("dialect", '"' + std::string(name_of(*desk.dialect)) + '"');
    if (!any_felt && desk.dialect) words += "; so no line for the settings file follows";
    desk.findings.settle(OpenQuestion::dialect, words);
}

/// Pushes, pauses, and reads whether the service still reports the force.
void be_silent_once(CheckDesk& desk, ForceDialect dialect, CheckTimes::Span silence, ForceEnd& end,
                    Json& line) {
    line["silence_ms"] = silence.count();
    Push push(desk);
    push.hold(kWeak_newton, dialect, desk.options.times.short_hold);
    if (!push.last()->force_newton) return;
    line["force_before_newton"] = glm::length(*push.last()->force_newton);
    const auto pushed_at = desk.talk.sent_at();
    push.be_silent(silence);
    const Arm after = desk.talk.exchange(std::nullopt, dialect).arm;
    const std::chrono::duration<double, std::milli> gap = desk.talk.sent_at() - pushed_at;
    line["gap_ms"] = gap.count();
    line["force_newton"] = after.force_newton ? Json(glm::length(*after.force_newton)) : Json();
    if (tells_weak_force(*push.last())) end.add(gap.count(), tells_weak_force(after));
}

/// Presses once; a key ends it early.
void press(CheckDesk& desk, double wanted_newton, Json& part) {
    Push push(desk);
    bool let_go = false;
    try {
        push.hold({0.0, 0.0, -wanted_newton}, desk.likely_dialect(), desk.options.times.hold);
    } catch (const ForceLetGo&) {
        let_go = true;
    }
    part["let_go"] = let_go;
    push.add_to(part);
}

}  // namespace

void check_dialect(CheckDesk& desk, Json& measured) {
    InUse in_use;
    in_use.before = desk.talk.exchange(std::nullopt, desk.likely_dialect()).arm.in_use;
    std::array<Spelled, 2> spelled{Spelled{ForceDialect::vector}, Spelled{ForceDialect::values}};
    for (Spelled& one : spelled) {
        if (one.dialect == ForceDialect::values) {
            desk.agree_to_force("F and Enter = pull with the other format, s = skip, q = quit");
        }
        Json& part = measured[name_of(one.dialect)] = Json::object();
        one = pull_with(desk, one.dialect, in_use, part);
    }
    choose_dialect(desk, spelled);
    in_use.after = desk.talk.exchange(std::nullopt, desk.likely_dialect()).arm.in_use;
    measured["in_use"] = {
        {"before", in_use.before}, {"during", in_use.during}, {"after", in_use.after}};
    if (desk.dialect)
        desk.findings.settle(OpenQuestion::in_use, in_use.in_words());  // a force acted
}

void check_silence(CheckDesk& desk, Json& measured) {
    const ForceDialect dialect = desk.likely_dialect();
    measured["dialect"] = name_of(dialect);
    measured["silences"] = Json::array();
    ForceEnd end;
    for (const CheckTimes::Span silence : desk.options.times.silences) {
        Json& line = measured["silences"].emplace_back(Json::object());
        be_silent_once(desk, dialect, silence, end, line);
        if (!line.contains("force_before_newton")) {
            desk.guide.say(
                "This service does not report its force: it cannot be measured in this way.");
            throw StepSkipped{};
        }
    }
    end.add_to(measured);
    desk.findings.settle(
        OpenQuestion::silence,
        end.in_words() + ", as told to a message without force, which may itself end it");
}

void check_force(CheckDesk& desk, Json& measured) {
    std::string words;
    measured["pushes"] = Json::array();
    for (const double wanted_newton : kOnTheScale_newton) {
        desk.agree_to_force("F and Enter = press with " + number_text(wanted_newton, 0) +
                            " N, s = skip, q = quit");
        Json& part = measured["pushes"].emplace_back(Json{{"wanted_newton", wanted_newton}});
        press(desk, wanted_newton, part);
        const bool let_go = part["let_go"].get<bool>();
        if (let_go) desk.guide.say("Released: there is no force any more.");
        if (let_go && !(part.value("held_s", 0.0) > 0.0)) continue;
        const auto grams = desk.number(
            "Grams that the scale showed while the force acted, at its end (Enter alone: not read)",
            0.0, kHeaviest_g);
        if (!grams) continue;
        const double felt_newton = *grams * kStandardGravity / 1000.0;
        const double share = felt_newton / wanted_newton;
        part["grams"] = *grams;
        part["newton"] = felt_newton;
        part["share"] = share;
        if (let_go) continue;
        words += (words.empty() ? "" : ", ") + number_text(felt_newton, 2) + " N of " +
                 number_text(wanted_newton, 0) + " (" + number_text(100.0 * share, 0) + " %)";
        desk.findings.settle(OpenQuestion::force, words);
    }
}

}  // namespace dibhr::inverse3
