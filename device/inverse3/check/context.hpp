// What every step of the check works on: user, device, options and findings.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "core/files/json.hpp"
#include "core/haptics/vec.hpp"
#include "device/hand/check/questions.hpp"
#include "device/hand/check/record.hpp"
#include "device/inverse3/check/check.hpp"
#include "device/inverse3/check/checked_inverse3.hpp"

namespace dibhr::inverse3 {

/// In the order of the steps that answer them.
enum class OpenQuestion : std::size_t {
    service,
    rate,
    device_rate,
    step,
    workspace,
    dialect,
    in_use,
    silence,
    closed,
    force,
    unplugged
};

inline constexpr std::array<CheckQuestion, 11> kQuestions{{
    {"service", "Version and devices"},
    {"rate", "Exchanges a second, and how long one takes"},
    {"device-rate", "New positions a second"},
    {"step", "Smallest step of the position"},
    {"workspace", "Workspace"},
    {"dialect", "The format of a force"},
    {"in-use", "Which program in_use means"},
    {"silence", "The force without a new message"},
    {"closed", "The force when its connection ends without a zero"},
    {"force", "Force at the grip"},
    {"unplugged", "The entry of an unplugged device"},
}};

inline constexpr double kMetre_mm = 1000.0;

/// {"x": .., "y": .., "z": ..}: along the axes of the service's frame.
[[nodiscard]] inline Json along_axes(Vec3 values) {
    return {{"x", values.x}, {"y", values.y}, {"z", values.z}};
}

/// While a question is open, the check polls the device's pose and sends no force.
struct CheckContext final : CheckQuestions {
    CheckContext(CheckConsole& person, CheckedInverse3& checked, const CheckOptions& chosen)
        : CheckQuestions(person), device(checked), options(chosen) {}

    CheckedInverse3& device;
    const CheckOptions& options;
    CheckFindings findings{kQuestions, "inverse3"};
    std::optional<ForceDialect> dialect{};  ///< as measured; nothing: not yet

    /// The dialect as measured, else of the settings, else by the version.
    [[nodiscard]] ForceDialect likely_dialect() const noexcept {
        const ForceDialect by_version =
            device.newer() ? ForceDialect::vector : ForceDialect::values;
        return dialect.value_or(options.connection.dialect.value_or(by_version));
    }
    /// Prints that the step went on by itself, `after` so long a wait for an Enter.
    void print_timeout(CheckTimes::Span after) const;

  private:
    void keep_alive() override;
};

/// Preset and axes of the positions, as read back; null: not known.
[[nodiscard]] Json reported_frame(const CheckedInverse3& device);
/// The meaning of every name in the record: of its head under "record", of a step under its name.
[[nodiscard]] Json check_legend();

// The steps. They add their results to `measured`; they throw StepSkipped, ForceReleased,
// PersonQuits, and DeviceError when the device fails.
void check_service(CheckContext& context, Json& measured);
void check_rate(CheckContext& context, Json& measured);
void check_moving(CheckContext& context, Json& measured);
void check_dialect(CheckContext& context, Json& measured);
void check_silence(CheckContext& context, Json& measured);
void check_closing(CheckContext& context, Json& measured);
void check_force(CheckContext& context, Json& measured);
void check_unplugged(CheckContext& context, Json& measured);

}  // namespace dibhr::inverse3
