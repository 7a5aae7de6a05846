// Step 4: homing with the user, and whether it survives when the homing bit is cleared
// (../README.md, Homing and lamp).
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/reply_watch.hpp"

namespace dibhr::falcon {

namespace {

using Clock = CheckedFalcon::Clock;

constexpr std::array kAxes{"top", "right", "left"};
constexpr std::chrono::milliseconds kPeriod{2};

std::string live_state(const Reply& reply) {
    std::string text;
    for (std::size_t k = 0; k < kAxes.size(); ++k) {
        const bool homed = (reply.homed >> k & 1U) != 0;
        text += std::string(k == 0 ? "" : "   ") + kAxes.at(k) + (homed ? " homed " : " ------ ") +
                std::to_string(reply.encoder.at(k));
    }
    return text;
}

/// Logs the counts right before and after the homed bit of an axis comes on.
class ReferenceLog {
  public:
    void add(const Reply& reply, double at_s) {
        for (std::size_t k = 0; last_ && k < kAxes.size(); ++k) {
            const bool now = (reply.homed >> k & 1U) != 0;
            const bool before = (last_->homed >> k & 1U) != 0;
            if (!now || before) continue;
            lines_.push_back({{"axis", kAxes.at(k)},
                              {"at_s", at_s},
                              {"counts_before", last_->encoder},
                              {"counts_after", reply.encoder}});
        }
        last_ = reply;
    }
    [[nodiscard]] const Json& lines() const noexcept { return lines_; }

  private:
    std::optional<Reply> last_{};
    Json lines_ = Json::array();
};

/// While the homing bit is set or not.
struct Phase {
    std::uint8_t always{kAllAxes};  ///< bits that every reply had
    Reply first{};
    Reply last{};
    int replies{0};
};

Phase run_phase(CheckDesk& desk, const char* name, bool homing, Json& measured) {
    Phase phase;
    const Command command{.motor = {}, .led = Led::blue, .homing = homing};
    const auto begin = Clock::now();
    std::optional<double> first_change_ms;
    while (Clock::now() - begin < desk.options.times.homing_bit || phase.replies == 0) {
        desk.quit_if_interrupted();
        const auto heard = desk.falcon.exchange(command, kPeriod);
        if (!heard) continue;
        if (phase.replies++ == 0) phase.first = heard->reply;
        if (heard->reply.homed != kAllAxes && !first_change_ms) {
            first_change_ms = std::chrono::duration<double, std::milli>(heard->at - begin).count();
        }
        phase.always &= heard->reply.homed;
        phase.last = heard->reply;
    }
    Json part{{"homing_bit", homing},
              {"replies", phase.replies},
              {"homed_first", phase.first.homed},
              {"homed_always", phase.always},
              {"homed_last", phase.last.homed},
              {"counts_first", phase.first.encoder},
              {"counts_last", phase.last.encoder}};
    if (first_change_ms) part["first_not_homed_ms"] = *first_change_ms;
    measured[name] = part;
    return phase;
}

std::string in_words(const Phase& kept, const Phase& cleared, const Phase& again) {
    const std::string counts = moved_between(kept.last.encoder, again.last.encoder)
                                   ? "; the counts jumped"
                                   : "; the counts stayed";
    if (again.last.homed != kAllAxes) return "homing is lost when the bit is cleared" + counts;
    if (cleared.always == kAllAxes) return "homing stays, and is told without the bit too" + counts;
    return "homing stays, but is told only while the bit is set" + counts;
}

}  // namespace

void home_with_person(CheckDesk& desk, Json& measured) {
    constexpr int kLook = 20;  // the first replies may be older than the homing bit
    constexpr std::chrono::milliseconds kShowEvery{100};
    const auto begin = Clock::now();
    HomingWatch watch;
    ReferenceLog references;
    watch.begin(begin);
    auto shown = begin;
    bool asked = false;
    bool hinted = false;
    for (int replies = 0; !watch.ready();) {
        const auto heard = desk.falcon.exchange(no_force(Led::red), kPeriod);
        if (heard) {
            watch.add(heard->reply, heard->at);
            references.add(heard->reply, std::chrono::duration<double>(heard->at - begin).count());
            ++replies;
        }
        if (watch.ready() || replies < kLook) continue;
        if (!asked) {
            desk.guide.ask(
                "Pull the grip all the way out, then push it straight in, until all "
                "three axes say homed. s = skip, q = quit");
            asked = true;
        }
        desk.answered();
        const auto now = Clock::now();
        if (heard && now - shown >= kShowEvery) {
            desk.guide.show(live_state(heard->reply));
            shown = now;
        }
        if (watch.idle(now) && !hinted) {
            desk.guide.say("no motion and no homing for 20 s: check the power adapter");
            hinted = true;
        }
    }
    if (asked) measured["references"] = references.lines();
}

void check_homing(CheckDesk& desk, Json& measured) {
    home_with_person(desk, measured);
    desk.guide.say("Homed. Let the grip hang, and do not touch it.");
    const Phase kept = run_phase(desk, "kept", true, measured);
    const Phase cleared = run_phase(desk, "cleared", false, measured);
    const Phase again = run_phase(desk, "set_again", true, measured);
    const std::string found = in_words(kept, cleared, again);
    desk.findings.settle(OpenQuestion::homing_bit, found);
    desk.guide.say(found);
}

}  // namespace dibhr::falcon
