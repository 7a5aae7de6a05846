// A person with a ruler, a kitchen scale and two hands, for the check of a simulated Falcon.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/check/check.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"

namespace dibhr::test::falcon {

using dibhr::CheckConsole;

/// A user who does what the check asks for and answers truly, unless a test changes that.
class CheckPerson final : public CheckConsole {
  public:
    CheckPerson(UsbBench& bus, Unit& unit) : bus_(bus), unit_(unit) {}

    // What a test may change.

    /// Answers instead, and does nothing else; nothing: as usual.
    std::function<std::optional<std::string>(const std::string&)> instead{
        [](const std::string&) { return std::nullopt; }};
    /// While a force acts, about every millisecond.
    std::function<Request()> wish_under_force{[] { return Request::none; }};
    std::function<void()> after_force{[] {}};
    bool has_left{false};  ///< nobody types
    bool ctrl_c{false};

    // What it has seen.

    std::string heard{};  ///< all that was said, shown and asked
    std::vector<std::string> questions{};
    double pressed_newton{0.0};  ///< on the scale, at the end of the last force's hold

    void print(const std::string& text) override { heard += text + "\n"; }
    void show(const std::string& state) override { heard += state + "\n"; }
    void ask(const std::string& question) override;
    std::optional<std::string> next_line() override;
    bool input_ended() override { return has_left; }
    bool interrupted() override { return ctrl_c; }
    void force_begins() override { most_counts_ = 0; }
    void force_ended() noexcept override { after_force(); }
    Request request() override;

  private:
    /// Enter, a number, or nothing while the hands do what was asked.
    std::optional<std::string> do_it(const std::string& question);
    void hold_grip(Vec3 at_m);

    UsbBench& bus_;
    Unit& unit_;
    std::optional<std::string> line_{};
    int most_counts_{0};
};

/// Short, so that a whole check takes a few seconds.
[[nodiscard]] dibhr::falcon::CheckTimes short_times();

/// A value of a JSON text: "$.steps[2].end"; empty when there is none. Fails when the text is no
/// JSON.
[[nodiscard]] std::string json_value(const std::string& json, const std::string& path);

}  // namespace dibhr::test::falcon
