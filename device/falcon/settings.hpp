// The settings of a Falcon: the constants on which sources disagree, workspace, buttons.
#pragma once

#include <memory>
#include <vector>

#include "device/falcon/status.hpp"
#include "device/hand/device_settings.hpp"

namespace dibhr::falcon {

/// In the order of Status::presses.
inline constexpr DeviceButtons kDeviceButtons{
    {{"button-plus", "Plus (right)", ButtonAction::record},
     {"button-forward", "Forward (top)", ButtonAction::play_or_pause},
     {"button-centre", "Centre (logo)", ButtonAction::clutch},
     {"button-minus", "Minus (left)", ButtonAction::force_off,
      Protection{WeakerWhen::other, "Falcon's minus button"}}}};

struct FalconSettings final : DeviceSettings {
    FalconSettings() : DeviceSettings(kDeviceButtons) {}

    ConnectionOptions connection{};  ///< takes effect at the next start of the program
    Geometry geometry{};
    Motors motors{};

    [[nodiscard]] std::unique_ptr<DeviceSettings> clone() const override {
        return std::make_unique<FalconSettings>(*this);
    }
    [[nodiscard]] std::vector<DeviceRow> rows() override;
    [[nodiscard]] std::vector<DeviceTopic> topics() const override;
    [[nodiscard]] DeviceLimits limits() const override;
};

/// The tuning from these settings and `hand`.
[[nodiscard]] Tuning tuning_of(const FalconSettings& settings, const HandTuning& hand) noexcept;

}  // namespace dibhr::falcon
