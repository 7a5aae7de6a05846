// What people choose about their Inverse3, and what they are told of it: its stage, and one plain
// sentence with the next step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "device/hand/buttons.hpp"
#include "device/hand/state_board.hpp"
#include "device/hand/workspace.hpp"
#include "device/inverse3/order.hpp"

namespace dibhr::inverse3 {

/// Chosen before the service is asked.
struct ConnectionOptions {
    std::string device{};  ///< a name, "left" or "right"; empty: the first, in order of their names
    std::uint16_t port{10001};              ///< WebSocket, and HTTP of newer services
    std::uint16_t older_port{10000};        ///< HTTP of older ones
    std::optional<ForceDialect> dialect{};  ///< nothing: by the service's version
    ShortWord preset{"defaults"};           ///< of mount, axes and origin, from 3.5 on
    /// One of them is there where the service is installed; empty: where its package has them.
    std::vector<std::filesystem::path> installed_as{};
};

/// Changed while touching, handed whole to the next tick.
struct Tuning {
    /// Over the image; centre_z_mm is 0 and there is no soft boundary: `centre_mm` is taken off.
    WorkspaceOptions workspace{.centre_z_mm = 0.0, .boundary_newton_per_mm = 0.0};
    Vec3 centre_mm{0.0, -150.0, 180.0};  ///< of the comfortable box, the service's axes
    /// By how much the image leans back from upright (0) to lying flat (90) [degrees].
    double tilt_deg{0.0};
    double max_force_newton{4.0};
    std::uint8_t clutch_buttons{0};
    std::uint8_t force_off_buttons{0};
    std::uint32_t centred{0};  ///< a new value forgets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// With these the same pose gives the same goal.
    [[nodiscard]] auto felt() const noexcept {
        return std::tie(workspace, centre_mm, tilt_deg, centred);
    }
};

/// How far it has come. A fault leads back to `looking` with the reason in Status::sentence.
enum class Stage {
    looking,         ///< no service, or it has gone
    too_old,         ///< a service that speaks only the format of 3.0
    not_understood,  ///< it says what cannot be made sense of
    no_device,       ///< the service has no Inverse3, or not the one that is meant
    no_power,
    not_calibrated,
    locked,        ///< calibrated and powered, but not ready: a Minverse without a grip
    in_use,        ///< by another program
    other_frame,   ///< its axes are permuted
    other_preset,  ///< it keeps another one than is asked for
    deaf,          ///< the service takes no force, however it is spelled
    slow,          ///< the service answers too slowly for a force
    ready          ///< poses and forces
};

struct GripStatus {
    std::string id{};
    bool wired{false};
    bool awake{true};
    std::optional<double> battery{};  ///< full: 1
};

struct Status : DeviceStatus {
    Stage stage{Stage::looking};
    bool installed{false};  ///< the service, as far as can be seen
    std::string version{};  ///< of the service; empty: not told
    std::string id{};       ///< of the chosen device; empty: none
    bool minverse{false};
    Handedness handedness{Handedness::unknown};
    std::string preset{};      ///< as read back; empty: not told
    bool other_preset{false};  ///< it stays another one than was asked for
    std::optional<ForceDialect> dialect{};
    bool dialect_confirmed{false};  ///< the service told back a force that was sent so
    std::optional<GripStatus> grip{};
    double exchanges_per_s{0.0};
    double exchange_ms{0.0};  ///< from a message to its answer, lately
    bool softened{false};     ///< they take so long that springs are held softer
    std::uint64_t exchanges{0};
    std::uint64_t unasked{0};         ///< messages that nobody had asked for
    std::uint64_t not_understood{0};  ///< messages that made no sense
};

/// The network thread writes it, the window reads it.
using Board = StateBoard<Status>;

/// "Inverse3 049D", "Minverse 049D", "Inverse3".
[[nodiscard]] std::string name_of(const Status& status);

/// What is, and what to do next, in a stage that needs its person.
[[nodiscard]] std::string sentence_for(Stage stage, const Status& status);

}  // namespace dibhr::inverse3
