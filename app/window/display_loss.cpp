// The end of the X server as Xlib tells it. GLFW (3.3 and 3.4) leaves that to Xlib, which would
// print a line of its own and call exit().
#include "app/window/display_loss.hpp"

#include "app/window/x11.hpp"

namespace dibhr {

int display_connection() {
    Display* const display = x11_display();
    return display == nullptr ? -1 : ConnectionNumber(display);
}

void when_display_goes(const std::function<void()>& act) {
    Display* const display = x11_display();
    if (display == nullptr) return;
    XSetIOErrorHandler([](Display*) { return 0; });  // which would print
    const auto call = [](Display*, void* act_to_call) {
        (*static_cast<const std::function<void()>*>(act_to_call))();
    };
    XSetIOErrorExitHandler(display, call, const_cast<std::function<void()>*>(&act));
}

}  // namespace dibhr
