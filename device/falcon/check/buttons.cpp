// Step 8: which bit is which button, and how long it bounces (../README.md, Buttons).
#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "device/falcon/check/desk.hpp"

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
Press watch_until(CheckDesk& desk, bool pressed, std::uint8_t last) {
    const milliseconds calm = desk.options.times.button_calm;
    Press press;
    Clock::time_point first_change{};
    Clock::time_point last_change{};
    for (;;) {
        if (desk.answered()) return press;  // Enter: this button does nothing
        const auto heard = desk.falcon.exchange(no_force(Led::blue), kPeriod);
        if (!heard) continue;
        const std::uint8_t bits = heard->reply.buttons;
        if (bits != last) {
            if (press.changes++ == 0) first_change = heard->at;
            last_change = heard->at;
            last = bits;
        }
        press.bits |= bits;
        const bool there = (bits != 0) == pressed;
        if (press.changes > 0 && there && heard->at - last_change >= calm) break;
    }
    press.bounced = std::chrono::duration_cast<milliseconds>(last_change - first_change);
    return press;
}

}  // namespace

void check_buttons(CheckDesk& desk, Json& measured) {
    int as_told = 0;
    std::string others;
    for (const Named& button : kButtons) {
        desk.guide.ask(std::string("Press and hold the button ") + button.where +
                       ". Enter = it does nothing, s = skip, q = quit");
        const Press down = watch_until(desk, true, 0);
        Json part{
            {"bits", down.bits}, {"changes", down.changes}, {"bounced_ms", down.bounced.count()}};
        if (down.bits != 0) {
            desk.guide.ask("Release the button.");
            const Press up = watch_until(desk, false, down.bits);
            part["release_changes"] = up.changes;
            part["release_bounced_ms"] = up.bounced.count();
        }
        measured[button.name] = part;
        if (down.bits == static_cast<std::uint8_t>(button.bit)) {
            ++as_told;
        } else {
            others += std::string(others.empty() ? "" : ", ") + button.name + " gives " +
                      std::to_string(down.bits);
        }
    }
    desk.findings.settle(OpenQuestion::buttons,
                         as_told == static_cast<int>(kButtons.size())
                             ? "plus 1, forward 2, centre 4, minus 8, as expected"
                             : others);
}

}  // namespace dibhr::falcon
