// Keyboard, mouse and screen of an X display. Keys and buttons are pressed by XTest: a program gets
// what a person's would give it.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace dibhr::test {

class Seat {
  public:
    /// `display`: ":7". Throws std::runtime_error.
    explicit Seat(const std::string& display);
    ~Seat();
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    // Each returns when the server has handed the event out.

    /// "space", "ctrl+shift+o": X keysym names; a letter or sign that needs Shift presses it.
    void press_key(const std::string& name);
    void release_key(const std::string& name);
    void move_to(int x, int y);
    void move_by(int dx, int dy);
    void press_button(int number);
    void release_button(int number);
    /// The pointer in the middle, every key and button up.
    void let_go();
    /// Sizes the newest window whose title holds that. Throws std::runtime_error when there is
    /// none.
    void resize_window(const std::string& title, int columns, int rows);

    /// What is on the screen, raw RGB, row by row.
    [[nodiscard]] std::string picture() const;

    /// "key ctrl+o", "keydown Return", "keyup Return", "type film", "mousemove 330 400",
    /// "mousemove_relative 5 -5", "mousedown 1", "mouseup 1", "click 1", "windowsize 500 470", one
    /// after the other. `after_each`: called after each event, between the two of a click, too.
    /// Throws std::runtime_error for other words.
    void act(const std::string& events, const std::function<void()>& after_each = {});

  private:
    struct Connection;
    std::unique_ptr<Connection> to_;
};

}  // namespace dibhr::test
