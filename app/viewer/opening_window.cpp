// Its first pictures, before there is anything to touch.
#include "app/viewer/opening_window.hpp"

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/viewer.hpp"

namespace dibhr {

namespace {

/// The saved or requested size; else the default, which grows with the text.
WindowSize requested_size(const ViewOptions& options) {
    const Settings& settings = options.settings;
    const Settings standard;
    const bool chosen = options.size_given || settings.width != standard.width ||
                        settings.height != standard.height;
    return {settings.width, settings.height,
            chosen ? std::nullopt : std::optional(settings.ui_scale)};
}

bool quits(const WindowInput& input, const KeyTable& keys) {
    const auto by_character = [&keys](const TypedCharacter& typed) {
        return keys.action_of_character(typed.code, typed.repeated, typed.shift) == Action::quit;
    };
    const auto by_key = [&keys](const KeyPress& press) {
        return keys.action_of_key(press.key, press.control, false, press.repeated, press.shift) ==
               Action::quit;
    };
    return std::any_of(input.characters.begin(), input.characters.end(), by_character) ||
           std::any_of(input.keys.begin(), input.keys.end(), by_key);
}

}  // namespace

GuiStyle gui_style(const ViewOptions& options, const Settings& settings, const Window& window) {
    const float scale = window.scale(settings.ui_scale);
    return {options.kiosk ? KioskOptions::kTextTimes * scale : scale, settings.theme};
}

OpeningWindow::OpeningWindow(const ViewOptions& options, Time begin)
    : options_(options),
      begin_(begin),
      window_(requested_size(options), options.sync, "dibhr", Window::Shown::later),
      gui_(window_, gui_style(options, options.settings, window_)),
      keys_(options.settings.keys) {}

bool OpeningWindow::wait() {
    WindowInput input = window_.take_input();
    window_.return_dropped(std::move(input.dropped));  // to the viewer, which opens them
    const bool closed = window_.close_requested() || quits(input, keys_);
    if (closed && !options_.kiosk) return false;
    if (Time::clock::now() - begin_ < kUnnoticedOpening) return true;
    const bool first = !shown_;
    show();
    if (first || input.any || input.damaged) draw();
    return true;
}

void OpeningWindow::show() {
    if (shown_) return;
    shown_ = true;
    window_.set_title(shown_name(options_.open.colour) + " - dibhr");
    window_.show();
    if (options_.full_screen) window_.toggle_full_screen();
}

void OpeningWindow::draw() {
    const float width = static_cast<float>(window_.framebuffer_size().x);
    gui_.begin({});
    const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    ImGui::GetBackgroundDrawList()->AddRectFilled({}, ImGui::GetIO().DisplaySize,
                                                  ImGui::GetColorU32(ground));
    draw_opening({shown_name(options_.open.colour), kReadingFiles}, gui_.fonts(), width);
    gui_.end();
    gui_.draw();
    window_.show_picture();
}

}  // namespace dibhr
