// Which of the attached Falcons is meant.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "device/falcon/attached.hpp"

namespace dibhr::falcon {

/// The one with this serial; when it is empty, the first.
[[nodiscard]] std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                                   const std::string& serial);

/// Why choose() found none, and what to do.
[[nodiscard]] std::string why_none(std::span<const AttachedFalcon> attached,
                                   const std::string& serial);

/// "A1, B2, one without a readable serial".
[[nodiscard]] std::string serials_of(std::span<const AttachedFalcon> attached);

}  // namespace dibhr::falcon
