// XTest's events, one function for each.
#include "tests/app/program/seat.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>

#include <X11/XKBlib.h>
#include <array>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr::test {

struct Seat::Connection {
    Display* display{nullptr};

    /// Hands out all that was sent before.
    void sync() const { XSync(display, False); }
    void key(KeyCode code, bool down) const {
        XTestFakeKeyEvent(display, code, down ? True : False, CurrentTime);
    }
    void button(int number, bool down) const {
        XTestFakeButtonEvent(display, static_cast<unsigned>(number), down ? True : False,
                             CurrentTime);
    }
};

namespace {

KeySym symbol_of(std::string_view name) {
    if (name == "ctrl") return XK_Control_L;
    if (name == "shift") return XK_Shift_L;
    if (name == "alt") return XK_Alt_L;
    if (name.size() == 1) return static_cast<unsigned char>(name.front());  // Latin 1
    const KeySym symbol = XStringToKeysym(std::string(name).c_str());
    if (symbol == NoSymbol) throw std::runtime_error("no key is called " + std::string(name));
    return symbol;
}

/// The keys of a chord, in the order in which they go down.
std::vector<KeyCode> codes_of(Display* display, const std::string& chord) {
    std::vector<KeyCode> codes;
    const auto add = [&](std::string_view name) {
        const KeySym symbol = symbol_of(name);
        const KeyCode code = XKeysymToKeycode(display, symbol);
        if (code == 0) throw std::runtime_error("no key gives " + std::string(name));
        if (XkbKeycodeToKeysym(display, code, 0, 0) != symbol)
            codes.push_back(XKeysymToKeycode(display, XK_Shift_L));
        codes.push_back(code);
    };
    std::size_t begin = 0;
    for (std::size_t plus = chord.find('+', 1);
         plus != std::string::npos && plus + 1 < chord.size(); plus = chord.find('+', begin + 1)) {
        add(std::string_view(chord).substr(begin, plus - begin));
        begin = plus + 1;
    }
    add(std::string_view(chord).substr(begin));
    return codes;
}

bool is_called(Display* display, Window window, const std::string& name_part) {
    char* name = nullptr;
    if (XFetchName(display, window, &name) == 0 || name == nullptr) return false;
    const bool is = std::string_view(name).find(name_part) != std::string_view::npos;
    XFree(name);
    return is;
}

}  // namespace

Seat::Seat(const std::string& display) : to_(std::make_unique<Connection>()) {
    to_->display = XOpenDisplay(display.c_str());
    if (to_->display == nullptr) throw std::runtime_error("no display " + display);
}

// Not closed when the server has died: Xlib would end this process.
Seat::~Seat() = default;

void Seat::press_key(const std::string& name) {
    for (const KeyCode code : codes_of(to_->display, name)) to_->key(code, true);
    to_->sync();
}

void Seat::release_key(const std::string& name) {
    const std::vector<KeyCode> codes = codes_of(to_->display, name);
    for (auto code = codes.rbegin(); code != codes.rend(); ++code) to_->key(*code, false);
    to_->sync();
}

void Seat::move_to(int x, int y) {
    XTestFakeMotionEvent(to_->display, -1, x, y, CurrentTime);
    to_->sync();
}

void Seat::move_by(int dx, int dy) {
    XTestFakeRelativeMotionEvent(to_->display, dx, dy, CurrentTime);
    to_->sync();
}

void Seat::press_button(int number) {
    to_->button(number, true);
    to_->sync();
}

void Seat::release_button(int number) {
    to_->button(number, false);
    to_->sync();
}

void Seat::let_go() {
    std::array<char, 32> down{};
    XQueryKeymap(to_->display, down.data());
    for (int code = 8; code < 256; ++code) {
        const auto bits = static_cast<unsigned char>(down[static_cast<std::size_t>(code) / 8]);
        if ((bits >> (code % 8) & 1U) != 0) to_->key(static_cast<KeyCode>(code), false);
    }
    for (const int number : {1, 2, 3}) to_->button(number, false);
    const int screen = DefaultScreen(to_->display);
    move_to(DisplayWidth(to_->display, screen) / 2, DisplayHeight(to_->display, screen) / 2);
}

void Seat::resize_window(const std::string& title, int columns, int rows) {
    Window root = 0;
    Window parent = 0;
    Window* windows = nullptr;
    unsigned count = 0;
    XQueryTree(to_->display, DefaultRootWindow(to_->display), &root, &parent, &windows, &count);
    Window found = 0;
    for (unsigned k = 0; k < count; ++k)
        if (is_called(to_->display, windows[k], title)) found = windows[k];
    XFree(windows);
    if (found == 0) throw std::runtime_error("no window is called " + title);
    XResizeWindow(to_->display, found, static_cast<unsigned>(columns), static_cast<unsigned>(rows));
    to_->sync();
}

std::string Seat::picture() const {
    const int screen = DefaultScreen(to_->display);
    const int columns = DisplayWidth(to_->display, screen);
    const int rows = DisplayHeight(to_->display, screen);
    XImage* const image =
        XGetImage(to_->display, DefaultRootWindow(to_->display), 0, 0,
                  static_cast<unsigned>(columns), static_cast<unsigned>(rows), AllPlanes, ZPixmap);
    if (image == nullptr) throw std::runtime_error("the display gives no picture");
    std::string rgb;
    rgb.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 3);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const unsigned long pixel = XGetPixel(image, column, row);
            for (const int shift : {16, 8, 0}) rgb += static_cast<char>(pixel >> shift & 0xffU);
        }
    }
    XDestroyImage(image);
    return rgb;
}

void Seat::act(const std::string& events, const std::function<void()>& after_each) {
    std::istringstream words(events);
    const auto next = [&words, &events](auto value) {
        if (!(words >> value)) throw std::runtime_error("something lacks in: " + events);
        return value;
    };
    const auto done = [&after_each] {
        if (after_each) after_each();
    };
    const auto tap = [this](const std::string& key) {
        press_key(key);
        release_key(key);
    };
    for (std::string word; words >> word; done()) {
        if (word == "key") {
            tap(next(std::string()));
        } else if (word == "keydown") {
            press_key(next(std::string()));
        } else if (word == "keyup") {
            release_key(next(std::string()));
        } else if (word == "type") {
            for (const char sign : next(std::string())) tap(std::string(1, sign));
        } else if (word == "mousemove") {
            const int x = next(0);
            move_to(x, next(0));
        } else if (word == "mousemove_relative") {
            const int dx = next(0);
            move_by(dx, next(0));
        } else if (word == "mousedown") {
            press_button(next(0));
        } else if (word == "mouseup") {
            release_button(next(0));
        } else if (word == "click") {
            const int number = next(0);
            press_button(number);
            done();
            release_button(number);
        } else if (word == "windowsize") {
            const int columns = next(0);
            resize_window("dibhr", columns, next(0));
        } else {
            throw std::runtime_error("no event is called " + word + ", in: " + events);
        }
    }
}

}  // namespace dibhr::test
