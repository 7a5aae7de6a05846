// A window of another program: it takes the keyboard when it opens, and gives it back to the one
// that had it when it is asked to end (SIGTERM).
#include <X11/Xlib.h>

#include <csignal>
#include <cstdlib>

int main() {
    sigset_t wish;
    sigemptyset(&wish);
    sigaddset(&wish, SIGTERM);
    sigprocmask(SIG_BLOCK, &wish, nullptr);
    Display* const display = XOpenDisplay(nullptr);
    if (display == nullptr) return EXIT_FAILURE;
    Window before = 0;
    int reverts_to = 0;
    XGetInputFocus(display, &before, &reverts_to);

    const Window window =
        XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 64, 48, 0, 0, 0);
    XSelectInput(display, window, StructureNotifyMask);
    XMapWindow(display, window);
    XEvent event{};
    while (event.type != MapNotify) XNextEvent(display, &event);
    XSetInputFocus(display, window, RevertToParent, CurrentTime);
    XSync(display, False);

    int signal = 0;
    sigwait(&wish, &signal);
    XSetInputFocus(display, before, reverts_to, CurrentTime);
    XCloseDisplay(display);
    return EXIT_SUCCESS;
}
