// The devices of the simulated service, and its behaviour: the variants that sources describe, and
// faults that a client has to handle.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr::inverse3::simulated {

using Clock = std::chrono::steady_clock;

/// A simulated Inverse3 or Minverse and the hand that holds it.
struct Arm {
    std::string id{"049D"};
    bool minverse{false};
    std::string handedness{"right"};
    Vec3 position_m{0.0, -0.15, 0.18};
    Vec3 velocity_m_per_s{0.0};   ///< as reported
    std::string position_text{};  ///< sent in place of the position: "null", "{\"x\":NaN}"
    bool calibrated{true};
    bool powered{true};
    bool in_use{false};
    bool ready{true};
    std::string preset{"defaults"};
    std::string basis{"XYZ"};
    // The force of its motors.
    Vec3 force_newton{0.0};
    Clock::time_point force_at{};
};

struct Grip {
    std::string id{"61548"};
    std::string list{"wireless_verse_grip"};
    std::uint8_t buttons{0};
    bool numbered{false};  ///< names are button_0 .. instead of a ..
    bool awake{true};
    double battery{0.8};
};

enum class AcceptedDialect { vector, values, both };
enum class OnWrongDialect { ignores, refuses, closes };

/// What is sent in place of an answer.
enum class Garble {
    none,
    malformed,
    cut,
    empty,
    megabyte,
    not_utf8,
    masked,         ///< a frame that only a client may send
    reserved_bits,  ///< a frame with the reserved bits of its first byte set
    close_frame,    ///< a close frame; messages still take effect until the client's own
    array,
    binary,       ///< a whole answer, in a binary frame
    fragments,    ///< a whole answer, in three frames with a ping between them
    long_length,  ///< a whole answer, padded so that its length takes 64 bits
    two           ///< a whole answer, and another one that was not requested
};

struct Behaviour {
    std::string version{"3.5.0"};
    bool newer_shape{true};  ///< 3.5: session_id, preset, current_cursor_force; else 3.1
    AcceptedDialect accepts{AcceptedDialect::vector};
    OnWrongDialect on_wrong_dialect{OnWrongDialect::ignores};
    bool inventory_at_once{true};
    bool takes_preset{true};            ///< else the service keeps its own preset
    bool answers{true};                 ///< else no answers come: a half-open connection
    std::chrono::microseconds tick{0};  ///< answers are sent at ticks of this period; 0: at once
    std::chrono::microseconds delay{0};
    std::chrono::microseconds jitter{0};  ///< a random part added to the delay, at most this
    Garble garble{Garble::none};
    /// A setting kept for all programs, gravity compensation, as JSON; empty: no answer.
    std::string gravity_compensation{R"({"enabled":true,"gravity_scaling_factor":1.0})"};
    bool http_beside{true};                    ///< /version on the WebSocket's own port
    bool http_older{true};                     ///< /version on the older port
    std::chrono::milliseconds force_held{50};  ///< a force lasts so long without a new one; 0: ever
};

/// The state of the simulation; the service guards it by one lock.
struct Scene {
    std::vector<Arm> arms{Arm{}};
    std::vector<Grip> grips{};
    Behaviour behaviour{};
    /// Position of the first arm's hand at a time [s] since the service began; null: constant.
    std::function<Vec3(double)> hand_m{};

    [[nodiscard]] Arm* arm(std::string_view id);
    /// Ends forces that were not renewed.
    void forget_old_forces(Clock::time_point now);
};

/// The state message; `whole`: with the configurations, as the inventory.
[[nodiscard]] std::string state_text(const Scene& scene, bool whole);

/// Effect of one message.
struct MessageEffect {
    bool understood{false};  ///< JSON of a known shape
    bool drives{false};      ///< the message has a force, taken or not
    bool wrong_dialect{false};
    bool requests_whole_state{false};
    bool requests_preset{false};
    Vec3 force_newton{0.0};
    std::string arm{};
};

/// Applies a client's message to the scene.
MessageEffect apply_message(Scene& scene, std::string_view message, Clock::time_point now);

}  // namespace dibhr::inverse3::simulated
