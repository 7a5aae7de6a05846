// The steps with force: how it is spelled, how long it lasts, and how strong it is.
#include <glm/geometric.hpp>

#include <algorithm>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/desk.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = CheckTalk::Clock;

constexpr Vec3 kWeak_newton{-0.5, 0.0, 0.0};  // to the left
constexpr double kToldBack = 0.05;            // of a force: filters may take most of it away
constexpr double kGravity = 9.80665;
constexpr double kHeaviest_g = 2000.0;

/// While it lives a force acts; at its end it does not, whatever happened.
class Push {
  public:
    explicit Push(CheckDesk& desk) : desk_(desk) { desk_.guide.force_begins(); }
    ~Push() {
        desk_.talk.let_go();
        desk_.guide.force_ended();
    }
    Push(const Push&) = delete;
    Push& operator=(const Push&) = delete;

    // These throw ForceLetGo, PersonQuits and DeviceError.

    /// Rises to the force and holds it for `hold`; the last state.
    Arm hold(Vec3 force_newton, ForceDialect dialect, CheckTimes::Span hold) {
        const auto begin = Clock::now();
        const auto ramp = std::chrono::duration<double>(desk_.options.times.ramp);
        const auto end = begin + desk_.options.times.ramp + hold;
        Arm last;
        while (Clock::now() < end) {
            if (!goes_on()) throw ForceLetGo{};
            const std::chrono::duration<double> since = Clock::now() - begin;
            const double share = std::min(1.0, since / ramp);
            last = desk_.talk.exchange(share * force_newton, dialect).arm;
            if (!last.calibrated || !last.powered) {
                throw DeviceError("the Inverse3 lost its calibration or its power");
            }
        }
        return last;
    }

    /// Sends nothing.
    void be_silent(CheckTimes::Span span) {
        if (!desk_.talk.keep_silent(span, [this] { return goes_on(); })) throw ForceLetGo{};
    }

  private:
    [[nodiscard]] bool goes_on() {
        const CheckGuide::Wish wish = desk_.guide.wish();
        if (wish == CheckGuide::Wish::quit) throw PersonQuits{};
        return wish == CheckGuide::Wish::none;
    }

    CheckDesk& desk_;
};

bool told_back(const Arm& state) {
    return state.force_newton &&
           glm::length(*state.force_newton) >= kToldBack * glm::length(kWeak_newton);
}

/// What in_use said before a force of ours, at its end, and after it.
struct InUse {
    bool before{false}, during{false}, after{false};

    [[nodiscard]] const char* in_words() const {
        if (before) return "set before any force: by another program, by us without one, or always";
        if (!during && !after) return "stays off while we push: another program";
        return after ? "set by our force, and stays: us, too" : "set by our force: us, too";
    }
};

/// Asked after the force has gone.
bool was_felt(CheckDesk& desk, ForceDialect dialect) {
    const std::string answer = desk.word(std::string("Did the grip pull to the left with \"") +
                                         name_of(dialect) + "\"? y or n");
    return answer == "y" || answer == "yes";
}

}  // namespace

void check_dialect(CheckDesk& desk, Json& measured) {
    std::string words;
    InUse in_use;
    in_use.before = desk.talk.exchange(std::nullopt, desk.likely_dialect()).arm.in_use;
    for (const ForceDialect dialect : {ForceDialect::vector, ForceDialect::values}) {
        Json& part = measured[name_of(dialect)] = Json::object();
        if (dialect != ForceDialect::vector) {
            desk.agree_to_force("F and Enter = pull with the other spelling, s = skip, q = quit");
        }
        bool told = false;
        try {
            Push push(desk);
            const Arm last = push.hold(kWeak_newton, dialect, desk.options.times.dialect);
            told = told_back(last);
            in_use.during = in_use.during || last.in_use;
        } catch (const LinkError&) {
            throw;
        } catch (const DeviceError& complaint) {
            part["complaint"] = complaint.what();
        }
        const bool felt = was_felt(desk, dialect);
        part["told_back"] = told;
        part["felt"] = felt;
        if ((felt || told) && !desk.dialect) desk.dialect = dialect;
        words += (words.empty() ? "" : "; ") + std::string(name_of(dialect)) +
                 (felt ? " is felt" : " is not felt") + (told ? " and told back" : "");
    }
    if (desk.dialect) desk.findings.set("dialect", '"' + std::string(name_of(*desk.dialect)) + '"');
    desk.settle(OpenQuestion::dialect, words);
    in_use.after = desk.talk.exchange(std::nullopt, desk.likely_dialect()).arm.in_use;
    measured["in_use"] = {
        {"before", in_use.before}, {"during", in_use.during}, {"after", in_use.after}};
    if (desk.dialect) desk.settle(OpenQuestion::in_use, in_use.in_words());  // a force acted
}

void check_silence(CheckDesk& desk, Json& measured) {
    const ForceDialect dialect = desk.likely_dialect();
    std::optional<CheckTimes::Span> gone_after;
    for (const CheckTimes::Span silence : desk.options.times.silences) {
        Push push(desk);
        (void)push.hold(kWeak_newton, dialect, CheckTimes::Span(100));
        push.be_silent(silence);
        const Arm after = desk.talk.exchange(std::nullopt, dialect).arm;
        Json line{{"silence_ms", silence.count()}};
        if (!after.force_newton) {
            measured["told"] = false;
            throw DeviceError("this service does not tell its force: it cannot be measured so");
        }
        line["force_newton"] = glm::length(*after.force_newton);
        measured["silences"].push_back(line);
        const bool acts = told_back(after);
        if (!acts && !gone_after) gone_after = silence;
        if (acts) gone_after.reset();
    }
    desk.settle(OpenQuestion::silence,
                gone_after ? "gone after " + std::to_string(gone_after->count()) + " ms at most"
                           : "still told after the longest silence");
}

void check_force(CheckDesk& desk, Json& measured) {
    std::string words;
    for (const double wanted_newton : {1.0, 2.0, 3.0}) {
        desk.agree_to_force("F and Enter = press with " + number_text(wanted_newton, 0) +
                            " N, s = skip, q = quit");
        {
            Push push(desk);
            (void)push.hold({0.0, 0.0, -wanted_newton}, desk.likely_dialect(),
                            desk.options.times.hold);
        }
        const auto grams =
            desk.number("Grams at the end (Enter alone: not read)", 0.0, kHeaviest_g);
        if (!grams) continue;
        const double felt_newton = *grams * kGravity / 1000.0;
        measured["pushes"].push_back(
            {{"wanted_newton", wanted_newton}, {"grams", *grams}, {"newton", felt_newton}});
        words += (words.empty() ? "" : ", ") + number_text(felt_newton, 2) + " N of " +
                 number_text(wanted_newton, 0);
    }
    if (!words.empty()) desk.settle(OpenQuestion::force, words);
}

}  // namespace dibhr::inverse3
