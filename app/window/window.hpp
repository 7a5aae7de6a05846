// The program's window with its OpenGL context, and the input in it.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/window/event_times.hpp"
#include "core/realtime/wake.hpp"
#include "core/video/playing/drawing_rate.hpp"

struct GLFWwindow;

namespace dibhr {

/// A key press as GLFW reports it.
struct KeyPress {
    int key{0};
    bool control{false};
    bool repeated{false};  ///< the key is being held down
    bool shift{false};
    EventTimes::Time at{};  ///< when it went down
};

struct TypedCharacter {
    unsigned code{0};  ///< Unicode code point
    bool repeated{false};
    bool shift{false};
    EventTimes::Time at{};  ///< when its key went down
    /// How many of WindowInput::keys came before, the one that typed it among them.
    std::size_t keys{0};
};

/// The pointer at a moment; position in pixels of the framebuffer from the upper left.
struct Pointer {
    glm::dvec2 position_px{0.0};
    bool left{false};
    bool middle{false};
    bool right{false};
    bool shift{false};
};

/// A mouse button went down or up: the pointer right after it.
struct PointerClick {
    Pointer pointer{};
    EventTimes::Time at{};
};

/// What happened since the last call of Window::take_input().
struct WindowInput {
    std::vector<KeyPress> keys{};
    std::vector<TypedCharacter> characters{};
    std::vector<std::filesystem::path> dropped{};
    std::vector<PointerClick> clicks{};  ///< in their order; but for those of take_pointer()
    double wheel_steps{0.0};             ///< > 0: away from the person
    /// When the left mouse button was last pressed.
    std::optional<EventTimes::Time> clicked_at{};
    bool any{false};        ///< something happened, also what has no entry here
    bool by_person{false};  ///< of it a key, a button, the wheel, a drop or a move of the pointer
    bool damaged{false};    ///< the screen has lost the window's picture, or part of it
};

/// Calls take_key(press) and take_character(typed) for all of an input, in the order in which they
/// were pressed and typed.
template <typename TakeKey, typename TakeCharacter>
void each_in_order(const WindowInput& input, const TakeKey& take_key,
                   const TakeCharacter& take_character) {
    auto typed = input.characters.begin();
    for (std::size_t keys = 0; keys <= input.keys.size(); ++keys) {
        if (keys > 0) take_key(input.keys[keys - 1]);
        for (; typed != input.characters.end() && typed->keys <= keys; ++typed)
            take_character(*typed);
    }
}

/// The input that the window's callbacks collect.
struct PendingInput {
    WindowInput input{};
    KeyPress key{};  ///< the last key press: its character may follow
    EventTimes times{};
    Pointer pointer{};          ///< as of the last event; position in screen units
    bool pointer_moved{false};  ///< since take_pointer()
    glm::ivec2 window_size{0};
    glm::ivec2 framebuffer_size{0};
    bool iconified{false};
};

/// The size of a window to open [screen units].
struct WindowSize {
    int width{0}, height{0};
    /// A factor as for Window::scale(), as far as the display has room; nothing: exactly this size.
    std::optional<double> times{};
};

/// One window with a current OpenGL 3.3 core context. Belongs to the thread that made it.
class Window {
  public:
    /// later: by show(), or never, where only its OpenGL context is used.
    enum class Shown { at_once, later };

    /// Throws DeviceError without a display or OpenGL 3.3.
    Window(const WindowSize& size, bool sync, const std::string& title,
           Shown shown = Shown::at_once);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// `act` is called when the display is lost, before the program prints a line and exits with
    /// status 1. It must not use the window.
    void on_display_loss(std::function<void()> act) { on_display_loss_ = std::move(act); }

    void show();
    [[nodiscard]] bool close_requested() const;
    void close();

    /// Polls for events; does not wait.
    WindowInput take_input();
    /// The next take_input() has these dropped files again.
    void return_dropped(std::vector<std::filesystem::path> files);
    /// Polls for events and returns the clicks, where the pointer has moved or clicked since the
    /// last call. All other input waits for take_input().
    std::optional<std::vector<PointerClick>> take_pointer();
    /// Waits for an event, for wake(), or so long. The next take_input() has what happened.
    void wait_for_input(std::chrono::milliseconds at_most);
    /// Ends a wait_for_input() that runs, or else the next one. For any thread.
    void wake() const;
    /// Whether a person works in the window now: it has the keyboard and is visible. Queries the
    /// display server, because events may arrive in another order than their causes.
    [[nodiscard]] bool in_front() const;
    /// Whether a person may see the window: it is mapped and no icon, as of the last
    /// ping_display(). (Wayland does not tell GLFW when a window is minimised.)
    [[nodiscard]] bool visible() const { return visible_ && !pending_.iconified; }
    [[nodiscard]] Pointer pointer() const;
    /// Whether a GLFW key is down now.
    [[nodiscard]] bool holds(int key) const;
    [[nodiscard]] bool holds_control() const;
    [[nodiscard]] glm::ivec2 framebuffer_size() const { return pending_.framebuffer_size; }
    [[nodiscard]] glm::ivec2 window_size() const;  ///< when not on the full screen [screen units]
    /// Of text and panels: `requested`, or if that is 0, the display's own scale (1: an ordinary
    /// one).
    [[nodiscard]] float scale(double requested) const;
    void set_title(const std::string& title);
    void toggle_full_screen();
    [[nodiscard]] bool full_screen() const;
    void show_picture();  ///< swaps the buffers; with `sync`, waits for an X display
    /// A round trip to the display server, which returns only if the server responds. (Does nothing
    /// under Wayland.)
    void ping_display();

    /// The X server's ID of the window; 0: no X server.
    [[nodiscard]] unsigned long x11_window() const;

    [[nodiscard]] GLFWwindow* handle() const { return window_; }

  private:
    void collect_events();
    [[noreturn]] void exit_without_display();

    std::function<void()> on_display_loss_{};
    const std::function<void()> display_lost_{[this] { exit_without_display(); }};
    GLFWwindow* window_{nullptr};
    PendingInput pending_{};
    Wake wake_{};
    bool on_x11_{false};
    bool visible_{true};
    glm::ivec2 place_{0};  // before the full screen
    glm::ivec2 size_{0};
};

/// The cost of a window and its program over the last whole second.
struct WindowCost {
    double pictures_per_s{0.0};
    double core_share{0.0};  ///< processor time of all threads; 1: one core's, all the time
    DrawingCost drawing{};
};

/// Waits between pictures, so that the haptic thread and the decoder keep their share of the
/// processor, and measures the window's cost.
class PicturePace {
  public:
    /// `shortest`: least time from picture to picture; zero: do not wait. `drawing_s`: processor
    /// time that drawing has taken so far [s], asked once a second; empty: not known.
    explicit PicturePace(std::chrono::nanoseconds shortest, std::function<double()> drawing_s = {})
        : shortest_(shortest), drawing_s_(std::move(drawing_s)) {}

    /// After a picture was shown: waits until the next one may be drawn, at least so long.
    /// Meanwhile calls `meanwhile` every few milliseconds.
    void wait(std::chrono::nanoseconds least, const std::function<void()>& meanwhile);

    /// Once a turn of the window. `drawn`: it showed a picture.
    void count(bool drawn);
    [[nodiscard]] const WindowCost& cost() const { return cost_; }

  private:
    using Clock = std::chrono::steady_clock;

    std::chrono::nanoseconds shortest_;
    std::function<double()> drawing_s_;
    Clock::time_point next_{};
    Clock::time_point second_begin_{};
    double used_before_s_{0.0};   // processor time until this second
    double drawn_before_s_{0.0};  // of it, what drawing took
    int pictures_{0};
    WindowCost cost_{};
};

}  // namespace dibhr
