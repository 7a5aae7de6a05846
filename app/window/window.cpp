// The window, by GLFW.
#include "app/window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "app/settings/settings.hpp"
#include "app/window/x_server.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

PendingInput& pending_of(GLFWwindow* window) {
    return *static_cast<PendingInput*>(glfwGetWindowUserPointer(window));
}

WindowInput& input_of(GLFWwindow* window) {
    return pending_of(window).input;
}

void note_event(GLFWwindow* window) {
    input_of(window).any = true;
}

void note_person(GLFWwindow* window) {
    note_event(window);
    input_of(window).by_person = true;
}

/// The state of a mouse button that dibhr uses; null: of another one.
bool* button_of(Pointer& pointer, int button) {
    switch (button) {
        case GLFW_MOUSE_BUTTON_LEFT:
            return &pointer.left;
        case GLFW_MOUSE_BUTTON_MIDDLE:
            return &pointer.middle;
        case GLFW_MOUSE_BUTTON_RIGHT:
            return &pointer.right;
        default:
            return nullptr;
    }
}

/// From screen units to pixels of the framebuffer.
Pointer in_pixels(Pointer pointer, const PendingInput& pending) {
    pointer.position_px *=
        glm::dvec2(pending.framebuffer_size) / glm::dvec2(glm::max(pending.window_size, 1));
    return pointer;
}

void note_click(GLFWwindow* window, int button, bool down, int mods) {
    PendingInput& all = pending_of(window);
    bool* const state = button_of(all.pointer, button);
    // The X server's numbers: 1 left, 2 middle, 3 right.
    const unsigned code = button == GLFW_MOUSE_BUTTON_LEFT     ? 1
                          : button == GLFW_MOUSE_BUTTON_MIDDLE ? 2
                                                               : 3;
    if (state == nullptr) return;
    *state = down;
    all.pointer.shift = (mods & GLFW_MOD_SHIFT) != 0;
    all.pointer_moved = true;
    const auto at =
        all.times.of(down ? EventTimes::Kind::mouse_button : EventTimes::Kind::mouse_release, code);
    all.input.clicks.push_back({in_pixels(all.pointer, all), at});
    if (down && button == GLFW_MOUSE_BUTTON_LEFT) all.input.clicked_at = at;
}

bool key_down(GLFWwindow* window, int key) {
    return glfwGetKey(window, key) == GLFW_PRESS;
}

/// Newer GLFW tries Wayland first, and prints an error on stderr if there is none.
void choose_display_server() {
#ifdef GLFW_PLATFORM
    const char* const wayland = std::getenv("WAYLAND_DISPLAY");
    if (wayland == nullptr || *wayland == '\0') glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

GLFWwindow* open_window(int width, int height, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 24);
    // If the driver supports it, a reset of the driver is reported and does not crash the program.
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    return glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
}

/// Clamped, since a display may report any scale.
float usable_scale(double requested, float displays) {
    const double scale = requested > 0.0 ? requested : static_cast<double>(displays);
    if (!std::isfinite(scale) || scale <= 0.0) return 1.0F;
    return static_cast<float>(std::clamp(scale, kSmallestUi, kLargestUi));
}

/// Text twice as large needs a window twice as large, if the display has room for it.
glm::ivec2 scaled_size(glm::ivec2 size, double requested) {
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return size;
    float displays = 1.0F;
    float vertical = 1.0F;
    glfwGetMonitorContentScale(monitor, &displays, &vertical);
    glm::ivec2 place{0};
    glm::ivec2 room{0};
    glfwGetMonitorWorkarea(monitor, &place.x, &place.y, &room.x, &room.y);
    const glm::ivec2 wanted(glm::vec2(size) * usable_scale(requested, displays));
    return glm::max(size, glm::min(wanted, room));
}

}  // namespace

Window::Window(const WindowSize& size, bool sync, const std::string& title, Shown shown)
    : size_{size.width, size.height} {
    choose_display_server();
    if (glfwInit() != GLFW_TRUE)
        throw DeviceError(
            "no display: set DISPLAY, or unset it and use ./app/run, which makes a virtual one");
    set_display_loss_handler(display_lost_);
    if (size.times) size_ = scaled_size(size_, *size.times);
    if (shown == Shown::later) glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window_ = open_window(size_.x, size_.y, title);
    if (window_ == nullptr) {
        const char* reason = nullptr;
        glfwGetError(&reason);
        const std::string text = reason != nullptr ? reason : "no reason given";
        glfwTerminate();
        throw DeviceError("cannot open a window with OpenGL 3.3 (" + text +
                          "): install a graphics driver, or libgl1-mesa-dri for software drawing");
    }
    glfwMakeContextCurrent(window_);
    // Not under Wayland: a hidden window would wait in the swap until it is visible again.
    on_x11_ = x11_window() != 0;
    glfwSwapInterval(sync && on_x11_ ? 1 : 0);
    glfwSetWindowSizeLimits(window_, kSmallestWindow, kSmallestWindow, GLFW_DONT_CARE,
                            GLFW_DONT_CARE);
    glfwSetWindowUserPointer(window_, &pending_);
    collect_events();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::collect_events() {
    glfwGetWindowSize(window_, &pending_.window_size.x, &pending_.window_size.y);
    glfwGetFramebufferSize(window_, &pending_.framebuffer_size.x, &pending_.framebuffer_size.y);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int mods) {
        note_person(window);
        if (action == GLFW_RELEASE) return;
        PendingInput& all = pending_of(window);
        all.key = {key, (mods & GLFW_MOD_CONTROL) != 0, action == GLFW_REPEAT,
                   (mods & GLFW_MOD_SHIFT) != 0,
                   all.times.of(EventTimes::Kind::key, static_cast<unsigned>(code))};
        all.input.keys.push_back(all.key);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
        note_person(window);
        // GLFW reports a character after the key that typed it.
        const KeyPress& by = pending_of(window).key;
        WindowInput& input = input_of(window);
        input.characters.push_back({character, by.repeated, by.shift, by.at, input.keys.size()});
    });
    glfwGetCursorPos(window_, &pending_.pointer.position_px.x, &pending_.pointer.position_px.y);
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
        note_person(window);
        note_click(window, button, action == GLFW_PRESS, mods);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double up) {
        note_person(window);
        input_of(window).wheel_steps += up;
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
        note_person(window);
        input_of(window).dropped.assign(files, files + count);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        note_person(window);
        pending_of(window).pointer.position_px = {x, y};
        pending_of(window).pointer_moved = true;
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int) { note_event(window); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { note_event(window); });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* window, int iconified) {
        note_event(window);
        pending_of(window).iconified = iconified == GLFW_TRUE;
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
        note_event(window);
        input_of(window).damaged = true;
    });
    glfwSetWindowSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
        note_event(window);
        pending_of(window).window_size = {width, height};
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
        note_event(window);
        pending_of(window).framebuffer_size = {width, height};
    });
}

void Window::exit_without_display() {
    if (on_display_loss_) on_display_loss_();
    print_error_line("the display went away: start dibhr again when it is back");
    // Without destructors and exit() handlers: a driver's would use the display.
    _exit(EXIT_FAILURE);
}

void Window::show() {
    glfwShowWindow(window_);
}

bool Window::close_requested() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

WindowInput Window::take_input() {
    pending_.times.collect();
    glfwPollEvents();
    return std::exchange(pending_.input, {});
}

void Window::return_dropped(std::vector<std::filesystem::path> files) {
    pending_.input.dropped = std::move(files);
}

std::optional<std::vector<PointerClick>> Window::take_pointer() {
    pending_.times.collect();
    glfwPollEvents();
    if (!std::exchange(pending_.pointer_moved, false)) return {};
    return std::exchange(pending_.input.clicks, {});
}

void Window::wait_for_input(std::chrono::milliseconds at_most) {
    if (!wait_for_x_events(wake_.descriptor(), at_most))
        glfwWaitEventsTimeout(std::chrono::duration<double>(at_most).count());
    wake_.clear();
}

void Window::wake() const {
    wake_.signal();
    if (!on_x11_) glfwPostEmptyEvent();
}

void Window::ping_display() {
    visible_ = glfwGetWindowAttrib(window_, GLFW_VISIBLE) == GLFW_TRUE;
}

bool Window::in_front() const {
    const auto is = [this](int attribute) {
        return glfwGetWindowAttrib(window_, attribute) == GLFW_TRUE;
    };
    if (!is(GLFW_FOCUSED) || !is(GLFW_VISIBLE) || is(GLFW_ICONIFIED)) return false;
    const glm::ivec2 size = framebuffer_size();
    return !is_covered(x11_window(), size.x, size.y);
}

Pointer Window::pointer() const {
    Pointer now = pending_.pointer;
    glfwGetCursorPos(window_, &now.position_px.x, &now.position_px.y);
    now.shift = key_down(window_, GLFW_KEY_LEFT_SHIFT) || key_down(window_, GLFW_KEY_RIGHT_SHIFT);
    return in_pixels(now, pending_);
}

bool Window::holds(int key) const {
    return key_down(window_, key);
}

bool Window::holds_control() const {
    return holds(GLFW_KEY_LEFT_CONTROL) || holds(GLFW_KEY_RIGHT_CONTROL);
}

glm::ivec2 Window::window_size() const {
    return glfwGetWindowMonitor(window_) != nullptr ? size_ : pending_.window_size;
}

float Window::scale(double requested) const {
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return usable_scale(requested, x);
}

unsigned long Window::x11_window() const {
    return x11_window_of(window_);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

bool Window::full_screen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::toggle_full_screen() {
    if (full_screen()) {
        glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, size_.x, size_.y,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &place_.x, &place_.y);
    size_ = window_size();
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::show_picture() {
    glfwSwapBuffers(window_);
}

void PicturePace::wait(std::chrono::nanoseconds least, const std::function<void()>& meanwhile) {
    constexpr std::chrono::milliseconds kBetween{4};
    if (next_ == Clock::time_point{}) next_ = Clock::now();
    next_ = std::max(next_ + std::max(shortest_, least), Clock::now());
    for (auto now = Clock::now(); now < next_; now = Clock::now()) {
        meanwhile();
        std::this_thread::sleep_until(std::min(next_, now + kBetween));
    }
}

void PicturePace::count(bool drawn) {
    pictures_ += drawn ? 1 : 0;
    const Clock::time_point now = Clock::now();
    const double age_s = std::chrono::duration<double>(now - second_begin_).count();
    if (age_s < 1.0) return;
    const double used_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    const double drawn_s = drawing_s_ ? drawing_s_() : 0.0;
    const double drawing_share = (drawn_s - drawn_before_s_) / age_s;
    cost_ = {pictures_ / age_s,
             (used_s - used_before_s_) / age_s,
             {pictures_ > 0 ? (drawn_s - drawn_before_s_) / pictures_ : 0.0,
              drawing_share / std::max(std::thread::hardware_concurrency(), 1U)}};
    used_before_s_ = used_s;
    drawn_before_s_ = drawn_s;
    pictures_ = 0;
    second_begin_ = now;
}

}  // namespace dibhr
