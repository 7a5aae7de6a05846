// What was measured: names and values that become indented JSON, for people and scripts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/haptics/vec.hpp"
#include "device/falcon/packet.hpp"

namespace dibhr::falcon {

class Measured;

/// In the order in which they were added.
class MeasuredList {
  public:
    MeasuredList& add(double value);  ///< null when it is not finite
    MeasuredList& add(const Measured& object);
    [[nodiscard]] std::string text() const;

  private:
    std::vector<std::string> items_{};
    bool has_objects_{false};
};

class Measured {
  public:
    Measured& add(std::string_view name, std::string_view text);
    Measured& add(std::string_view name, const char* text);
    Measured& add(std::string_view name, bool value);
    Measured& add(std::string_view name, double value);  ///< null when it is not finite
    Measured& add(std::string_view name, int value);
    Measured& add(std::string_view name, std::uint64_t value);
    Measured& add(std::string_view name, const Measured& value);
    Measured& add(std::string_view name, const MeasuredList& value);
    Measured& add(std::string_view name, Vec3 value);
    Measured& add(std::string_view name, const Counts& value);
    Measured& add_null(std::string_view name);
    [[nodiscard]] std::string text() const;

  private:
    Measured& add_json(std::string_view name, std::string json);

    std::vector<std::string> members_{};
};

/// A member of `parent` that is added as this goes out of scope, however that happens.
class MeasuredPart {
  public:
    MeasuredPart(Measured& parent, std::string name) : parent_(parent), name_(std::move(name)) {}
    ~MeasuredPart() { parent_.add(name_, object_); }
    MeasuredPart(const MeasuredPart&) = delete;
    MeasuredPart& operator=(const MeasuredPart&) = delete;

    [[nodiscard]] Measured& operator*() noexcept { return object_; }

  private:
    Measured& parent_;
    std::string name_;
    Measured object_{};
};

/// "0A 44 2C 0D".
[[nodiscard]] std::string hexadecimal(std::span<const std::uint8_t> bytes);

}  // namespace dibhr::falcon
