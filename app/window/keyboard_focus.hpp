// Which part of the panels has the keyboard, and what a key does there.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <string>
#include <vector>

#include "app/window/window.hpp"

struct ImGuiWindow;

namespace dibhr {

/// What keys do with the item that has the keyboard.
enum class ItemKeys {
    press,  ///< Space and Enter press it
    type,   ///< Space and Enter begin to type in it
    slide,  ///< likewise, and left and right change it
    turn,   ///< left and right change it
    line,   ///< a text line: it is typed in as soon as it has the keyboard
    list,   ///< up and down choose, Enter takes
};

/// An item in words, for those who do not see it.
struct ItemWords {
    std::string label{};
    std::string kind{};   ///< "check box"
    std::string value{};  ///< "on"; empty: it has none
    std::string help{};   ///< of its tooltip; empty: it has none, or it is the label

    bool operator==(const ItemWords&) const = default;
};

/// Moves the keyboard from item to item: the panels add their items in each picture. It is off
/// until go_to_area(); then Tab, arrows, Home and End move, and leave() returns the keyboard to
/// the picture. ImGui's own navigation stays off: it would take the arrow keys at all times, and
/// skips what is scrolled out of view.
class KeyboardFocus {
  public:
    /// The steps of the arrow keys that the item with the keyboard takes in this picture.
    struct Steps {
        int across{0};  ///< > 0: right
        int down{0};
        bool enter{false};
    };

    /// Of the current ImGui context; nothing where the window has none, as in a test.
    [[nodiscard]] static KeyboardFocus* current();

    [[nodiscard]] bool on() const { return on_; }
    /// To the first item of the next window with items (`by` 1), or the one before it (-1); from
    /// the last one back to the picture.
    void go_to_area(int by);
    void leave();
    /// Takes a key for the next picture; false: the key means nothing in the panels. `typing`: a
    /// text has the keyboard, to which most keys belong.
    bool take(const KeyPress& press, bool typing);
    /// Keys that are not carried out yet: they need further pictures.
    [[nodiscard]] bool busy() const { return !keys_.empty() || moved_; }

    /// Of the item that has the keyboard, as of the last picture; empty: none has it.
    [[nodiscard]] const ItemWords& words() const { return words_; }

    // In a picture.
    void begin();
    /// The item that was just submitted to ImGui. True if it has the keyboard. `preferred`: where
    /// the keyboard begins in its window.
    bool add(ItemKeys keys, bool preferred = false);
    /// The same with an ID and a place on the screen, for an item that is not the last one any
    /// more.
    bool add(ItemKeys keys, ImGuiID id, ImVec2 low, ImVec2 high, bool preferred = false);
    [[nodiscard]] bool has(ImGuiID id) const { return on_ && id != 0 && id == id_; }
    void describe(ItemWords words);
    /// The tooltip of the item that was described last.
    void explain(const std::string& help) {
        if (help != described_.label) described_.help = help;
    }
    [[nodiscard]] const Steps& steps() const { return steps_; }
    /// Carries out the keys and draws the frame around the item. `scale`: pixels of a layout pixel.
    void end(float scale);

  private:
    struct Item {
        ImGuiID id{0};
        ItemKeys keys{ItemKeys::press};
        ImVec2 low{}, high{};  // on the screen [px]
        ImGuiWindow* window{nullptr};
        ImGuiWindow* area{nullptr};
        bool preferred{false};
    };
    /// Where the keyboard goes back to, as windows above close.
    struct Place {
        ImGuiID id{0};
        std::size_t at{0};
    };

    void keep_popup_only();
    void go_to_new_area();
    void find_again();
    void follow_typing();
    bool carry_out(const KeyPress& key);
    void go_to(std::size_t at);
    void go_by(int by, bool around);
    void go_by_areas(int by);
    void activate(ItemKeys keys);
    [[nodiscard]] std::size_t first_in(const ImGuiWindow* area) const;
    [[nodiscard]] bool holds(const ImGuiWindow* area) const;
    [[nodiscard]] std::vector<ImGuiWindow*> areas() const;
    void draw_frame(float scale) const;

    bool on_{false};
    bool moved_{false};           // the next picture describes the item
    ImGuiID id_{0};               // of the item that has the keyboard; 0: none yet
    std::size_t at_{0};           // its index in `items_`
    ImGuiWindow* area_{nullptr};  // its window
    std::vector<KeyPress> keys_{};
    Steps steps_{};
    std::vector<Item> items_{};
    std::vector<ImGuiWindow*> seen_{};  // areas of the last picture
    std::vector<Place> back_{};
    ItemWords words_{}, described_{};
    int area_moves_{0};
};

}  // namespace dibhr
