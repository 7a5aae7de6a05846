// Dear ImGui in a window: its context, fonts and the program's calm dark look.
#pragma once

#include "app/window/window.hpp"

struct ImFont;

namespace dibhr {

/// Fonts at the display's scale; null: the built-in one.
struct Fonts {
    ImFont* text{nullptr};
    ImFont* heading{nullptr};
};

/// Made after the window (it chains the window's callbacks), destroyed before it.
class Gui {
  public:
    explicit Gui(const Window& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void begin();  ///< a new picture; panels may be drawn until end()
    void end();    ///< draws them into the bound framebuffer

    [[nodiscard]] bool wants_pointer() const;   ///< the cursor is over a panel, or dragging one
    [[nodiscard]] bool wants_keyboard() const;  ///< a text field is being typed into
    [[nodiscard]] const Fonts& fonts() const { return fonts_; }
    [[nodiscard]] float scale() const { return scale_; }

  private:
    float scale_{1.0F};
    Fonts fonts_{};
};

}  // namespace dibhr
