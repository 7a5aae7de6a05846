// The record of a check: one JSON file, written again after every step, and what was found of the
// questions that ../README.md leaves open.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/vec.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

[[nodiscard]] Json as_json(Vec3 values);
/// "0A 44 2C 0D".
[[nodiscard]] std::string hexadecimal(std::span<const std::uint8_t> bytes);

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

inline constexpr std::size_t kOpenQuestions =
    static_cast<std::size_t>(OpenQuestion::power_lost) + 1;

class Findings {
  public:
    /// Once more: the last answer counts.
    void settle(OpenQuestion question, std::string found);
    /// A line for the [falcon] table of the settings file: `value` as TOML has it.
    void set(const std::string& name, const std::string& value) { settings_[name] = value; }

    /// Every question with what was found or that it is still open, and the settings; for people.
    [[nodiscard]] std::string summary() const;
    /// Adds "findings" and "settings" to the record.
    void add_to(Json& record) const;

  private:
    std::array<std::string, kOpenQuestions> found_{};  // empty: still open
    Json settings_ = Json::object();
};

/// How a step ended.
enum class StepEnd : std::size_t { done, skipped, quit, failed, not_begun };

class CheckRecord {
  public:
    /// `file` empty: falcon-check-SERIAL-DATE.json in the current folder.
    CheckRecord(std::filesystem::path file, const AttachedFalcon& falcon,
                const std::vector<std::pair<std::string, std::string>>& facts);

    /// `remark`: why it failed or was not begun.
    void add(const char* step, StepEnd end, const std::string& remark, double seconds,
             const Json& measured);
    /// The whole file, or none of it. Throws InputError.
    void write(const Findings& findings) const;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  private:
    std::filesystem::path file_;
    Json head_{};
    Json steps_ = Json::array();
};

}  // namespace dibhr::falcon
