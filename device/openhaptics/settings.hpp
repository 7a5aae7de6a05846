// The settings of a Touch: which one, its library, workspace, buttons.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/hand/device_settings.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

/// In the order of Status::presses.
inline constexpr DeviceButtons kDeviceButtons{
    {{"button-front", "Front", ButtonAction::clutch},
     {"button-back", "Back", ButtonAction::force_off,
      Protection{WeakerWhen::other, "Touch's back button"}},
     {"button-3", "Third", ButtonAction::none},
     {"button-4", "Fourth", ButtonAction::none}}};

struct OpenhapticsSettings final : DeviceSettings {
    OpenhapticsSettings() : DeviceSettings(kDeviceButtons, Tuning{}.workspace) {}

    std::string name{};     ///< of the device's configuration; empty: the default one
    std::string library{};  ///< a file or a folder; empty: where OpenHaptics installs it

    [[nodiscard]] std::unique_ptr<DeviceSettings> clone() const override {
        return std::make_unique<OpenhapticsSettings>(*this);
    }
    [[nodiscard]] std::vector<DeviceRow> rows() override;
    [[nodiscard]] std::vector<DeviceTopic> topics() const override;
    [[nodiscard]] DeviceLimits limits() const override;
};

/// Takes effect at the next start of the program.
[[nodiscard]] ConnectionOptions connection_of(const OpenhapticsSettings& settings);

/// The tuning from these settings and `hand`.
[[nodiscard]] Tuning tuning_of(const OpenhapticsSettings& settings,
                               const HandTuning& hand) noexcept;

}  // namespace dibhr::openhaptics
