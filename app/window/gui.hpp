// Dear ImGui with the program's style: fonts, sizes and the colours of a theme.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/settings/theme.hpp"
#include "app/window/keyboard_focus.hpp"
#include "app/window/window.hpp"

struct ImFont;

namespace dibhr {

/// A null font is ImGui's built-in one.
struct Fonts {
    ImFont* text{nullptr};
    ImFont* heading{nullptr};
    ImFont* title{nullptr};  ///< half as large again
};

/// How the panels are drawn.
struct GuiStyle {
    float scale{1.0F};  ///< of text, rows and gaps; 1: for an ordinary display
    Theme theme{Theme::dark};

    bool operator==(const GuiStyle&) const = default;
};

/// Made after the window (it chains the window's callbacks), destroyed before it.
class Gui {
  public:
    Gui(const Window& window, const GuiStyle& gui_style);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Begins a picture; panels may be drawn until end(). `input`: since the last picture.
    /// `text_opens`: a text is about to be typed in, and gets the characters that came too early.
    void begin(const WindowInput& input, bool text_opens = false);
    /// Drops the first `count` characters since the last picture, which were key presses: no field
    /// that opens later may read them. Not those that a field reads.
    void drop_characters(std::size_t count);
    void end();
    void draw();  ///< draws the panels, as of the last end(), into the bound framebuffer

    /// A hash of all that draw() would draw, but of the pixels of pictures in the panels.
    [[nodiscard]] std::size_t content() const;
    /// A person presses a button of the mouse, or has hold of something in a panel: a text, a
    /// slider; or keys are still to be carried out in the panels.
    [[nodiscard]] bool in_use() const;

    /// A panel of the last picture is at that place of the window [px], or a list is open.
    [[nodiscard]] bool covers(glm::dvec2 place_px) const;
    [[nodiscard]] bool wants_keyboard() const;  ///< a text field is being typed into
    [[nodiscard]] bool list_is_open() const;    ///< a list opened from a panel
    void close_lists();                         ///< in the next picture
    /// To and from the desktop's clipboard; a clipboard without text reads as empty.
    void copy(const std::string& text);
    [[nodiscard]] std::string copied() const;
    /// Call between two pictures. A new scale takes some milliseconds: fonts are loaded again.
    void apply(const GuiStyle& gui_style);
    /// The way of the keyboard through the panels.
    [[nodiscard]] KeyboardFocus& focus() { return focus_; }
    [[nodiscard]] const Fonts& fonts() const { return fonts_; }
    [[nodiscard]] float scale() const { return style_.scale; }

  private:
    void lay_out_in_pixels();
    void keep_early_text(bool text_opens);
    void catch_up_control(const WindowInput& input);

    GuiStyle style_;
    Fonts fonts_{};
    bool closes_lists_{false};
    KeyboardFocus focus_{};
    std::vector<unsigned> early_text_{};
    std::vector<unsigned> late_text_{};  // for the next picture
    bool control_missed_{false};
    int events_left_{0};  // of the last picture, not read yet
};

}  // namespace dibhr
