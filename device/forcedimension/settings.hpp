// The settings of a Force Dimension arm: connection, workspace, buttons.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/forcedimension/status.hpp"
#include "device/hand/device_settings.hpp"

namespace dibhr::forcedimension {

/// In the order of Status::presses.
inline constexpr DeviceButtons kDeviceButtons{
    {{"button-0", "Button 0, or the gripper", ButtonAction::clutch},
     {"button-1", "Button 1", ButtonAction::force_off,
      Protection{WeakerWhen::other, "the Force Dimension arm's button 1"}},
     {"button-2", "Button 2", ButtonAction::record},
     {"button-3", "Button 3", ButtonAction::play_or_pause}}};

struct ForceDimensionSettings final : DeviceSettings {
    ForceDimensionSettings() : DeviceSettings(kDeviceButtons, Tuning{}.workspace) {}

    std::string device{};   ///< a serial; empty: the first arm
    std::string library{};  ///< a file, a folder or a record; empty: wherever it is installed
    Tuning tuning{};        ///< only centre_mm; tuning_of() sets the others
    double box_mm{80.0};    ///< edge of the box in which a hand moves comfortably

    [[nodiscard]] std::unique_ptr<DeviceSettings> clone() const override {
        return std::make_unique<ForceDimensionSettings>(*this);
    }
    [[nodiscard]] std::vector<DeviceRow> rows() override;
    [[nodiscard]] std::vector<DeviceTopic> topics() const override;
    void fit(const ImageFrame& image) noexcept override {
        workspace.scale = fitting_scale_to_box(image, box_mm);
    }
    [[nodiscard]] DeviceLimits limits() const override;
};

/// Takes effect at the next start of the program.
[[nodiscard]] ConnectionOptions connection_of(const ForceDimensionSettings& settings);

/// The tuning from these settings and `hand`.
[[nodiscard]] Tuning tuning_of(const ForceDimensionSettings& settings,
                               const HandTuning& hand) noexcept;

}  // namespace dibhr::forcedimension
