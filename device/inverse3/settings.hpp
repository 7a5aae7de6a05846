// The settings of an Inverse3: connection to its service, workspace, buttons.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/enum_names.hpp"
#include "device/hand/device_settings.hpp"
#include "device/inverse3/frame.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// The format of a force in messages to the service.
enum class Dialect : std::uint8_t { automatic, vector, values };

inline constexpr std::array<NamedValue<Dialect>, 3> kDialectNames{
    {{Dialect::automatic, "auto", "By service version"},
     {Dialect::vector, "vector", "vector (3.5)"},
     {Dialect::values, "values", "values"}}};
static_assert(has_all_in_order(kDialectNames, Dialect::values));

[[nodiscard]] constexpr const auto& name_table(Dialect) noexcept {
    return kDialectNames;
}

/// In the order of Status::presses.
inline constexpr DeviceButtons kDeviceButtons{
    {{"button-a", "A, or the only one", ButtonAction::clutch},
     {"button-b", "B", ButtonAction::force_off,
      Protection{WeakerWhen::other, "Inverse3's button B"}},
     {"button-c", "C", ButtonAction::record},
     {"button-home", "Home", ButtonAction::play_or_pause}}};

struct Inverse3Settings final : DeviceSettings {
    Inverse3Settings() : DeviceSettings(kDeviceButtons, Tuning{}.workspace) {}

    std::string device{};  ///< an ID, "left" or "right"; empty: the first
    int port{10001};
    int older_port{10000};
    Dialect dialect{Dialect::automatic};
    std::string preset{};  ///< of mount, axes and origin; empty: "defaults"
    Tuning tuning{};       ///< only centre_mm and tilt_deg; tuning_of() sets the others
    double box_mm{120.0};  ///< edge of the box in which a hand moves comfortably

    [[nodiscard]] std::unique_ptr<DeviceSettings> clone() const override {
        return std::make_unique<Inverse3Settings>(*this);
    }
    [[nodiscard]] std::vector<DeviceRow> rows() override;
    [[nodiscard]] std::vector<DeviceTopic> topics() const override;
    void fit(const ImageFrame& image) noexcept override {
        workspace.scale = fitting_scale_to_box(image, box_mm);
    }
    [[nodiscard]] DeviceLimits limits() const override;
};

/// Takes effect at the next start of the program.
[[nodiscard]] ConnectionOptions connection_of(const Inverse3Settings& settings);

/// The tuning from these settings and `hand`.
[[nodiscard]] Tuning tuning_of(const Inverse3Settings& settings, const HandTuning& hand) noexcept;

}  // namespace dibhr::inverse3
