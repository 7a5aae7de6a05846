// The queries, by Xlib. GLFW (3.3 and 3.4) leaves the loss of the X server to Xlib, which would
// print a line of its own and call exit().
#include "app/window/x_server.hpp"

#include <poll.h>

#include <algorithm>
#include <array>

#include "app/window/x11.hpp"

namespace dibhr {

namespace {

/// A window manager may close its frame between two queries; Xlib would then exit the program.
class IgnoredXErrors {
  public:
    IgnoredXErrors() : before_(XSetErrorHandler([](Display*, XErrorEvent*) { return 0; })) {}
    ~IgnoredXErrors() { XSetErrorHandler(before_); }
    IgnoredXErrors(const IgnoredXErrors&) = delete;
    IgnoredXErrors& operator=(const IgnoredXErrors&) = delete;

  private:
    XErrorHandler before_;
};

/// The window's frame: the child of `root` that contains it; 0 if it was just closed.
Window frame_of(Display* display, Window window, Window root) {
    for (;;) {
        Window of_screen = 0;
        Window parent = 0;
        Window* children = nullptr;
        unsigned count = 0;
        if (XQueryTree(display, window, &of_screen, &parent, &children, &count) == 0) return 0;
        if (children != nullptr) XFree(children);
        if (parent == root || parent == 0) return window;
        window = parent;
    }
}

}  // namespace

unsigned long x11_window_of(GLFWwindow* window) {
    const auto window_of = glfw_native<Window(GLFWwindow*)>("glfwGetX11Window");
    return window_of == nullptr ? 0 : window_of(window);
}

bool is_covered(unsigned long x11_window, int width, int height) {
    Display* const display = x11_display();
    if (display == nullptr) return false;
    const IgnoredXErrors ignored;
    const Window root = DefaultRootWindow(display);
    const Window frame = frame_of(display, x11_window, root);
    const std::array<std::array<int, 2>, 5> of_four{{{2, 2}, {1, 1}, {3, 1}, {1, 3}, {3, 3}}};
    return std::none_of(of_four.begin(), of_four.end(), [&](const auto& point) {
        int x = 0;
        int y = 0;
        Window topmost = 0;
        XTranslateCoordinates(display, x11_window, root, point[0] * width / 4,
                              point[1] * height / 4, &x, &y, &topmost);
        return topmost == frame;
    });
}

bool wait_for_x_events(int descriptor, std::chrono::milliseconds at_most) {
    Display* const display = x11_display();
    if (display == nullptr) return false;
    if (XPending(display) > 0) return true;  // read before, with the answer to a query
    std::array<pollfd, 2> ready{{{ConnectionNumber(display), POLLIN, 0}, {descriptor, POLLIN, 0}}};
    poll(ready.data(), ready.size(), static_cast<int>(at_most.count()));
    return true;
}

void set_display_loss_handler(const std::function<void()>& act) {
    Display* const display = x11_display();
    if (display == nullptr) return;
    XSetIOErrorHandler([](Display*) { return 0; });  // the default handler would print
    const auto call = [](Display*, void* act_to_call) {
        (*static_cast<const std::function<void()>*>(act_to_call))();
    };
    XSetIOErrorExitHandler(display, call, const_cast<std::function<void()>*>(&act));
}

int display_connection() {
    Display* const display = x11_display();
    return display == nullptr ? -1 : ConnectionNumber(display);
}

}  // namespace dibhr
