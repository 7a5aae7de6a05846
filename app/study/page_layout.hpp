// What pages are laid out with: broken text, buttons in rows, and a page whose buttons are in sight
// however long its text is. Any text is drawn as it is: "##" is no mark of an ID here.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/study/study_pages.hpp"

namespace dibhr {

/// The height of the text [px], which all is measured in.
[[nodiscard]] float em();

enum class LineAlign : std::uint8_t { left, middle, right };

/// Broken where it is wider than the width that it was made with, also within a word.
struct TextBlock {
    std::vector<std::string> lines{};
    ImVec2 size{0.0F, 0.0F};  ///< of all of it [px]
    float times{1.0F};        ///< as large as the font
};

[[nodiscard]] TextBlock text_block(const std::string& text, float most_width, float times = 1.0F);

/// With its upper left corner at `at` [px of the display]; `align`: of its lines to each other.
void draw_text(const TextBlock& block, ImVec2 at, LineAlign align, bool quiet = false);

/// Side by side in the middle; in columns of one width where they do not fit, down to one under
/// the other.
struct ButtonGroup {
    std::vector<std::string> labels{};
    int marked{-1};  ///< shown as chosen
    bool enabled{true};
    float least_width{6.0F};  ///< [em]
    float space{1.0F};        ///< beside the label [em]
};

/// Of some pixels; draws into the full width at the cursor and gives what was pressed.
struct FootPart {
    float height{0.0F};
    std::function<std::optional<StudyPress>()> draw{};
};

/// `press_of`: what a click on the button of that number is.
[[nodiscard]] FootPart button_part(const ButtonGroup& group,
                                   std::function<StudyPress(int)> press_of);
/// A quiet line in the middle.
[[nodiscard]] FootPart note_part(const std::string& text);

/// What is read on a page.
struct PageText {
    std::string text{};
    float times{1.0F};  ///< as large as the font
    bool quiet{false};
};

struct PageBody {
    std::uintptr_t picture{0};  ///< a texture, above the text; 0: none
    int picture_columns{1}, picture_rows{1};
    std::vector<PageText> texts{};
    /// Where it begins in the window's height, from 0 to 1; higher up where it needs the room.
    float top{0.26F};
    bool first_picture{false};  ///< of this page: nothing is scrolled yet
    float scroll{0.0F};         ///< down by so many lines, since the last picture
};

/// The body, and below it the parts. What does not fit is scrolled, each by itself.
std::optional<StudyPress> draw_page(const PageBody& body, std::span<const FootPart> foot);

/// The parts at the lower edge of the window.
std::optional<StudyPress> draw_at_bottom(std::span<const FootPart> foot);

/// Over the relief, on a ground of its own, in the middle from `top` on. Its lower edge [px].
float draw_label(const std::string& text, float top, float times = 1.0F);

}  // namespace dibhr
