// What ../README.md leaves open, and what the check has found of it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "device/falcon/check/measured.hpp"

namespace dibhr::falcon {

/// In the order of the steps that answer them.
enum class OpenQuestion : std::size_t {
    identity,
    upload_speed,
    stray_bytes,
    loading_again,
    last_byte,
    reply_rate,
    event_character,
    homing_bit,
    end_stops,
    angle_at_zero,
    after_last_packet,
    torque_scale,
    buttons,
    usb_unplugged,
    power_lost
};

inline constexpr std::size_t kOpenQuestions = 15;

class Findings {
  public:
    /// Once more: the last answer counts.
    void settle(OpenQuestion question, std::string found);
    /// A line for the [falcon] table of the settings file: `value` as TOML has it.
    void set(const std::string& name, const std::string& value);

    /// Every question with what was found or that it is still open, and the settings; for people.
    [[nodiscard]] std::string summary() const;
    /// Adds "findings" and "settings" to the record.
    void add_to(Measured& record) const;

  private:
    std::array<std::string, kOpenQuestions> found_{};  // empty: still open
    std::vector<std::pair<std::string, std::string>> settings_{};
};

}  // namespace dibhr::falcon
