// What the user is asked to agree to, and whether they agreed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "device/force_device.hpp"

namespace dibhr::forcedimension {

/// The device's thread makes offers, the window's thread agrees. Every offer has a new number, and
/// an agreement is used up: it is never valid for a later offer.
class Offers {
  public:
    // The device's thread:

    [[nodiscard]] DeviceOffer make(std::string label, std::string warning) {
        return {++number_, std::move(label), std::move(warning)};
    }
    /// Whether the user agreed to this offer, the last one that was made. True only once.
    [[nodiscard]] bool taken(const std::optional<DeviceOffer>& offer) noexcept {
        if (!offer || offer->number != number_) return false;
        std::uint64_t agreed = offer->number;
        return agreed_.compare_exchange_strong(agreed, 0);
    }

    /// Any thread.
    void agree_to(std::uint64_t number) noexcept { agreed_ = number; }

  private:
    std::uint64_t number_{0};
    std::atomic<std::uint64_t> agreed_{0};
};

}  // namespace dibhr::forcedimension
