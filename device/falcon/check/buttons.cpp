// Step 8: which bit is which button, and how long it bounces (../README.md, Buttons).
#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "device/falcon/check/context.hpp"

namespace dibhr::falcon {

namespace {

using Clock = CheckedFalcon::Clock;
using std::chrono::milliseconds;

struct Named {
    const char* name;
    const char* where;
    Button bit;  ///< by ../README.md
};

constexpr std::array kButtons{Named{"plus", "plus, on the right", Button::plus},
                              Named{"forward", "forward, at the top", Button::forward},
                              Named{"centre", "centre, with the logo", Button::centre},
                              Named{"minus", "minus, on the left", Button::minus}};

constexpr milliseconds kPeriod{1};

/// Bits of a press, collected until they no longer change.
struct Press {
    std::uint8_t bits{0};  ///< all that came on
    int changes{0};
    milliseconds bounced{0};  ///< from the first change to the last one before the calm
};

/// Waits until a button is down (`pressed`) or none is, and the bits no longer change. `last`: the
/// bits before.
Press watch_until(CheckContext& context, bool pressed, std::uint8_t last) {
    const milliseconds calm = context.options.times.button_calm;
    Press press;
    Clock::time_point first_change{};
    Clock::time_point last_change{};
    for (;;) {
        if (context.answered()) return press;  // Enter: this button does nothing
        const auto received = context.falcon.exchange(no_force(Led::blue), kPeriod);
        if (!received) continue;
        const std::uint8_t bits = received->reply.buttons;
        if (bits != last) {
            if (press.changes++ == 0) first_change = received->at;
            last_change = received->at;
            last = bits;
        }
        press.bits |= bits;
        const bool there = (bits != 0) == pressed;
        if (press.changes > 0 && there && received->at - last_change >= calm) break;
    }
    press.bounced = std::chrono::duration_cast<milliseconds>(last_change - first_change);
    return press;
}

}  // namespace

void check_buttons(CheckContext& context, Json& measured) {
    int as_expected = 0;
    std::string others;
    for (const Named& button : kButtons) {
        context.console.ask(std::string("Press and hold the button ") + button.where +
                            ". Enter = it does nothing, s = skip, q = quit");
        const Press down = watch_until(context, true, 0);
        Json part{
            {"bits", down.bits}, {"changes", down.changes}, {"bounced_ms", down.bounced.count()}};
        if (down.bits != 0) {
            context.console.ask("Release the button.");
            const Press up = watch_until(context, false, down.bits);
            part["release_changes"] = up.changes;
            part["release_bounced_ms"] = up.bounced.count();
        }
        measured[button.name] = part;
        if (down.bits == static_cast<std::uint8_t>(button.bit)) {
            ++as_expected;
        } else {
            others += std::string(others.empty() ? "" : ", ") + button.name + " gives " +
                      std::to_string(down.bits);
        }
    }
    context.findings.record_answer(OpenQuestion::buttons,
                                   as_expected == static_cast<int>(kButtons.size())
                                       ? "plus 1, forward 2, centre 4, minus 8, as expected"
                                       : others);
}

}  // namespace dibhr::falcon
