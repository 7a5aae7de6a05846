// Reads Xlib's queue and leaves all events in it.
#include "app/window/event_times.hpp"

#include <algorithm>

#include "app/window/x11.hpp"

namespace dibhr {

namespace {

/// An X server on this machine has the clock of std::chrono. A stamp of another machine's server is
/// seldom this young.
EventTimes::Time of_server(std::uint32_t server_ms, EventTimes::Time now) {
    using std::chrono::milliseconds;
    constexpr std::uint32_t kOldest_ms = 10'000;
    const auto now_ms = std::chrono::floor<milliseconds>(now);
    const auto age_ms = static_cast<std::uint32_t>(now_ms.time_since_epoch().count()) - server_ms;
    return age_ms > kOldest_ms ? now : now_ms - milliseconds(age_ms);
}

}  // namespace

void EventTimes::collect() {
    presses_.clear();
    Display* const display = x11_display();
    if (display == nullptr) return;
    const auto note = [](Display*, XEvent* event, XPointer presses) -> Bool {
        auto& all = *reinterpret_cast<std::vector<Press>*>(presses);
        if (event->type == KeyPress)
            all.push_back(
                {Kind::key, event->xkey.keycode, static_cast<std::uint32_t>(event->xkey.time)});
        if (event->type == ButtonPress || event->type == ButtonRelease)
            all.push_back({event->type == ButtonPress ? Kind::mouse_button : Kind::mouse_release,
                           event->xbutton.button, static_cast<std::uint32_t>(event->xbutton.time)});
        return False;
    };
    XEvent none;
    XCheckIfEvent(display, &none, note, reinterpret_cast<XPointer>(&presses_));
}

EventTimes::Time EventTimes::of(Kind kind, unsigned code) {
    const Time now = std::chrono::steady_clock::now();
    const auto found = std::find_if(presses_.begin(), presses_.end(), [&](const Press& press) {
        return press.kind == kind && press.code == code;
    });
    if (found == presses_.end()) return now;  // pressed after collect()
    const Time at = of_server(found->server_ms, now);
    presses_.erase(presses_.begin(), found + 1);
    return at;
}

}  // namespace dibhr
