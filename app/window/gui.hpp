// Dear ImGui with the program's calm look: fonts, sizes and the colours of a theme.
#pragma once

#include <span>
#include <string>

#include "app/settings/theme.hpp"
#include "app/window/window.hpp"

struct ImFont;

namespace dibhr {

/// null: the built-in one.
struct Fonts {
    ImFont* text{nullptr};
    ImFont* heading{nullptr};
};

/// How the panels look.
struct GuiLook {
    float scale{1.0F};  ///< of text and all that is around it; 1: an ordinary display's
    Theme theme{Theme::dark};

    bool operator==(const GuiLook&) const = default;
};

/// Made after the window (it chains the window's callbacks), destroyed before it.
class Gui {
  public:
    Gui(const Window& window, const GuiLook& look);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// A new picture; panels may be drawn until end(). `pressed` since the last one.
    void begin(std::span<const KeyPress> pressed);
    void end();  ///< draws them into the bound framebuffer

    [[nodiscard]] bool wants_pointer() const;   ///< the cursor is over a panel, or dragging one
    [[nodiscard]] bool wants_keyboard() const;  ///< a text field is being typed into
    /// To and from the desktop's clipboard; what is no text is empty.
    void copy(const std::string& text);
    [[nodiscard]] std::string copied() const;
    /// Between two pictures. Takes some milliseconds when it is another one.
    void wear(const GuiLook& look);
    [[nodiscard]] const Fonts& fonts() const { return fonts_; }
    [[nodiscard]] float scale() const { return look_.scale; }

  private:
    GuiLook look_;
    Fonts fonts_{};
};

}  // namespace dibhr
