// One Falcon on the USB, as it can be named without opening it.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace dibhr::falcon {

struct AttachedFalcon {
    int bus{0};
    int address{0};
    std::string serial{};  ///< empty: could not be read

    bool operator==(const AttachedFalcon&) const = default;
};

/// "the Falcon SIM00001", or where it is plugged in when its serial is not known.
[[nodiscard]] std::string full_name_of(const AttachedFalcon& falcon);

/// The one with this serial; when it is empty, the first.
[[nodiscard]] std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                                   const std::string& serial);

/// Why choose() found none, and what to do.
[[nodiscard]] std::string why_none(std::span<const AttachedFalcon> attached,
                                   const std::string& serial);

/// "A1, B2, one without a readable serial".
[[nodiscard]] std::string serials_of(std::span<const AttachedFalcon> attached);

}  // namespace dibhr::falcon
