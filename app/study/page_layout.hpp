// Layout of pages: wrapped text, buttons in rows, and pages whose buttons stay visible however long
// the text is. Text is drawn as it is: "##" does not begin an ID here.
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

/// The height of the text [px], the unit of all sizes here.
[[nodiscard]] float em();

enum class LineAlign : std::uint8_t { left, middle, right };

/// Text wrapped to the width given to text_block(), within a word where needed.
struct TextBlock {
    std::vector<std::string> lines{};
    ImVec2 size{0.0F, 0.0F};  ///< of the whole block [px]
    float times{1.0F};        ///< as large as the font
};

[[nodiscard]] TextBlock text_block(const std::string& text, float most_width, float times = 1.0F);

/// Draws with the upper left corner at `at` [px of the display]; `align`: of the lines.
void draw_text(const TextBlock& block, ImVec2 at, LineAlign align, bool dimmed = false);

/// Buttons side by side in the middle; where they do not fit, in columns of equal width, down to
/// one column.
struct ButtonGroup {
    std::vector<std::string> labels{};
    int marked{-1};  ///< index of the chosen button; -1: none
    bool enabled{true};
    float least_width{6.0F};  ///< [em]
    float space{1.0F};        ///< beside the label [em]
};

/// A part of a page's foot. `draw` draws at the cursor, over the full width, and returns a press.
struct FootPart {
    float height{0.0F};
    std::function<std::optional<StudyPress>()> draw{};
};

/// `press_of`: the press that a click on the button of that index means.
[[nodiscard]] FootPart button_part(const ButtonGroup& group,
                                   std::function<StudyPress(int)> press_of);
/// A dimmed line in the middle.
[[nodiscard]] FootPart note_part(const std::string& text);

/// A text on a page.
struct PageText {
    std::string text{};
    float times{1.0F};  ///< as large as the font
    bool dimmed{false};
    LineAlign align{LineAlign::left};
};

struct PageBody {
    std::uintptr_t picture{0};  ///< a texture, above the text; 0: none
    int picture_columns{1}, picture_rows{1};
    std::vector<PageText> texts{};
    /// Top of the body as a share of the window's height, 0 to 1; less where it needs the room.
    float top{0.26F};
    bool first_picture{false};  ///< the page is new: scroll to its top
    float scroll{0.0F};         ///< lines to scroll down since the last picture
};

/// Draws the body, and below it the parts. Each of the two scrolls where it does not fit.
std::optional<StudyPress> draw_page(const PageBody& body, std::span<const FootPart> foot);

/// Draws the parts at the lower edge of the window.
std::optional<StudyPress> draw_at_bottom(std::span<const FootPart> foot);

/// Draws a label with a background over the relief, in the middle. Returns its lower edge [px].
float draw_label(const std::string& text, float top, float times = 1.0F);

}  // namespace dibhr
