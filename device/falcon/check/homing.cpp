// Step 4: homing with the user, and whether it survives when the homing bit is cleared
// (../README.md, Homing and lamp).
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "device/falcon/check/context.hpp"
#include "device/falcon/homing_watch.hpp"

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

Phase run_phase(CheckContext& context, const char* name, bool homing, Json& measured) {
    Phase phase;
    const Command command{.motor = {}, .led = Led::blue, .homing = homing};
    const auto begin = Clock::now();
    std::optional<double> first_change_ms;
    while (Clock::now() - begin < context.options.times.homing_bit || phase.replies == 0) {
        context.quit_if_interrupted();
        const auto received = context.falcon.exchange(command, kPeriod);
        if (!received) continue;
        if (phase.replies++ == 0) phase.first = received->reply;
        if (received->reply.homed != kAllAxes && !first_change_ms) {
            first_change_ms =
                std::chrono::duration<double, std::milli>(received->at - begin).count();
        }
        phase.always &= received->reply.homed;
        phase.last = received->reply;
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

void home_with_person(CheckContext& context, Json& measured) {
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
        const auto received = context.falcon.exchange(no_force(Led::red), kPeriod);
        if (received) {
            watch.add(received->reply, received->at);
            references.add(received->reply,
                           std::chrono::duration<double>(received->at - begin).count());
            ++replies;
        }
        if (watch.ready() || replies < kLook) continue;
        if (!asked) {
            context.console.ask(
                "Pull the grip all the way out, then push it straight in, until all "
                "three axes say homed. s = skip, q = quit");
            asked = true;
        }
        context.answered();
        const auto now = Clock::now();
        if (received && now - shown >= kShowEvery) {
            context.console.show(live_state(received->reply));
            shown = now;
        }
        if (watch.idle(now) && !hinted) {
            context.console.print("no motion and no homing for 20 s: check the power adapter");
            hinted = true;
        }
    }
    if (asked) measured["references"] = references.lines();
}

void check_homing(CheckContext& context, Json& measured) {
    home_with_person(context, measured);
    context.console.print("Homed. Let the grip hang, and do not touch it.");
    const Phase kept = run_phase(context, "kept", true, measured);
    const Phase cleared = run_phase(context, "cleared", false, measured);
    const Phase again = run_phase(context, "set_again", true, measured);
    const std::string found = in_words(kept, cleared, again);
    context.findings.record_answer(OpenQuestion::homing_bit, found);
    context.console.print(found);
}

}  // namespace dibhr::falcon
