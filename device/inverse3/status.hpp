// Options and tuning of an Inverse3, and its status: the stage, and one plain sentence with the
// next step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "device/arm_exchanges.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/state_board.hpp"
#include "device/hand/workspace.hpp"
#include "device/inverse3/service_request.hpp"

namespace dibhr::inverse3 {

/// Set before the connection.
struct ConnectionOptions {
    std::string device{};                   ///< an ID, "left" or "right"; empty: the first ID
    std::uint16_t port{10001};              ///< WebSocket, and HTTP of newer services
    std::uint16_t older_port{10000};        ///< HTTP of older ones
    std::optional<ForceDialect> dialect{};  ///< nothing: by the service's version
    ShortWord preset{"defaults"};           ///< of mount, axes and origin, from 3.5 on
    /// The service is installed if one of these files exists; empty: the files of its package.
    std::vector<std::filesystem::path> installed_as{};
};

/// May change while touching; the next tick takes it as a whole.
struct Tuning {
    /// centre_z_mm is 0, because `centre_mm` is subtracted; there is no soft boundary.
    WorkspaceOptions workspace{.centre_z_mm = 0.0, .boundary_newton_per_mm = 0.0};
    Vec3 centre_mm{0.0, -150.0, 180.0};  ///< of the comfortable box, the service's axes
    /// Tilt of the image, from upright (0) to lying flat (90) [degrees].
    double tilt_deg{0.0};
    double max_force_newton{4.0};
    std::uint8_t clutch_buttons{0};
    std::uint8_t force_off_buttons{0};
    std::uint32_t centre_count{0};  ///< a new value resets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// The values that change the goal of a pose.
    [[nodiscard]] auto rendered_values() const noexcept {
        return std::tie(workspace, centre_mm, tilt_deg, centre_count);
    }
    // As of an ArmDevice.
    [[nodiscard]] Vec3 hand_mm(Vec3 position_m) const noexcept;
    [[nodiscard]] Vec3 arm_newton(Vec3 hand_newton) const noexcept;
    [[nodiscard]] static double delay_s(int exchange_ms) noexcept;
};

/// After a failure the stage is `looking` again, with the reason in Status::sentence.
enum class Stage {
    looking,         ///< no service, or the connection was lost
    too_old,         ///< the service has only the protocol of 3.0
    not_understood,  ///< the service sends messages that are not valid
    no_device,       ///< the service has no Inverse3, or not the requested one
    no_power,
    not_calibrated,
    locked,         ///< calibrated and powered, but not ready: a Minverse without a grip
    in_use,         ///< by another program
    other_frame,    ///< its axes are permuted
    other_preset,   ///< the service keeps another preset than the requested one
    force_refused,  ///< the service takes a force in neither format
    slow,           ///< the service answers too slowly for a force
    ready           ///< poses and forces
};

struct GripStatus {
    std::string id{};
    bool wired{false};
    bool awake{true};
    std::optional<double> battery{};  ///< full: 1
};

struct Status : DeviceStatus, ExchangeStatus {
    Stage stage{Stage::looking};
    bool installed{false};  ///< files of the service were found
    std::string version{};  ///< of the service; empty: not known
    std::string id{};       ///< of the chosen device; empty: none
    bool minverse{false};
    Handedness handedness{Handedness::unknown};
    std::string preset{};      ///< as read back; empty: not known
    bool other_preset{false};  ///< the service keeps another preset than the requested one
    std::optional<ForceDialect> dialect{};
    bool dialect_confirmed{false};  ///< the service reported back a force in this dialect
    std::optional<GripStatus> grip{};
    std::uint64_t unrequested{0};     ///< unrequested messages
    std::uint64_t not_understood{0};  ///< messages that were not valid
};

/// Written by the network thread, read by the window.
using Board = StateBoard<Status>;

/// "Inverse3 049D", "Minverse 049D", "Inverse3".
[[nodiscard]] std::string name_of(const Status& status);

/// The sentence for the user: the state and the next step.
[[nodiscard]] std::string sentence_for(Stage stage, const Status& status);

}  // namespace dibhr::inverse3
