// The window while the files of the command line are opened on another thread.
#pragma once

#include <chrono>

#include "app/settings/keys.hpp"
#include "app/window/gui.hpp"
#include "app/window/window.hpp"

namespace dibhr {

struct Settings;
struct ViewOptions;

/// Files open unnoticed for so long; after that the window says what is being done.
inline constexpr std::chrono::milliseconds kUnnoticedOpening{300};

inline constexpr const char* kReadingFiles = "Reading its files";
inline constexpr const char* kReadingFirstFrame = "Reading its first frame";

/// How the panels are drawn in that window: larger in a kiosk.
[[nodiscard]] GuiStyle gui_style(const ViewOptions& options, const Settings& settings,
                                 const Window& window);

/// The viewer's window and its panels' library. It is hidden at first: where the files cannot be
/// opened, there is one line and no window.
class OpeningWindow {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `options` must outlive it; `begin`: when the program started. Throws DeviceError without a
    /// display or OpenGL 3.3.
    OpeningWindow(const ViewOptions& options, Time begin);
    OpeningWindow(const OpeningWindow&) = delete;
    OpeningWindow& operator=(const OpeningWindow&) = delete;

    /// To be called again and again while the files are opened: shows their name once this takes
    /// longer than kUnnoticedOpening. False: a person has closed the window.
    [[nodiscard]] bool wait();
    void show();  ///< if it is hidden still

    [[nodiscard]] Window& window() noexcept { return window_; }
    [[nodiscard]] Gui& gui() noexcept { return gui_; }
    [[nodiscard]] Time begin() const noexcept { return begin_; }

  private:
    void draw();

    const ViewOptions& options_;
    Time begin_;
    Window window_;
    Gui gui_;
    KeyTable keys_;
    bool shown_{false};
};

}  // namespace dibhr
