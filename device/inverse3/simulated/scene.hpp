// What is attached to the simulated service, and its manners: all that sources tell of services and
// that a client has to stand.
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
    Vec3 velocity_m_per_s{0.0};   ///< as it is reported
    std::string position_text{};  ///< in the place of the position: "null", "{\"x\":NaN}"
    bool calibrated{true};
    bool powered{true};
    bool in_use{false};
    bool ready{true};
    std::string preset{"defaults"};
    std::string basis{"XYZ"};
    // What its motors do.
    Vec3 force_newton{0.0};
    Clock::time_point force_at{};
};

struct Grip {
    std::string id{"61548"};
    std::string list{"wireless_verse_grip"};
    std::uint8_t buttons{0};
    bool numbered{false};  ///< button_0 .. instead of a ..
    bool awake{true};
    double battery{0.8};
};

enum class Takes { vector, values, both };
enum class OnWrong { ignores, refuses, closes };

/// What comes in the place of an answer.
enum class Garble {
    none,
    malformed,
    cut,
    empty,
    megabyte,
    not_utf8,
    masked,         ///< a frame as only a client may send it
    reserved_bits,  ///< of a frame's first byte
    close_frame,    ///< and it goes on to obey until the client's own
    array,
    binary,       ///< a whole answer, in a binary frame
    fragments,    ///< a whole answer, in three frames with a ping between them
    long_length,  ///< a whole answer, and so much room in it that its length takes 64 bits
    two           ///< a whole answer, and another one that nobody asked for
};

struct Manners {
    std::string version{"3.5.0"};
    bool newer_shape{true};  ///< 3.5: session_id, preset, current_cursor_force; else 3.1
    Takes takes{Takes::vector};
    OnWrong on_wrong{OnWrong::ignores};
    bool inventory_at_once{true};
    bool takes_preset{true};            ///< else it keeps its own
    bool answers{true};                 ///< else it keeps silent: half open
    std::chrono::microseconds tick{0};  ///< answers come at its own ticks; 0: at once
    std::chrono::microseconds delay{0};
    std::chrono::microseconds jitter{0};  ///< up to that much more
    Garble garble{Garble::none};
    /// What it keeps for all programs: gravity compensation, as JSON; empty: it does not tell.
    std::string gravity_compensation{R"({"enabled":true,"gravity_scaling_factor":1.0})"};
    bool http_beside{true};                    ///< /version on the WebSocket's own port
    bool http_older{true};                     ///< and on the older one
    std::chrono::milliseconds force_held{50};  ///< without a new one; 0: for ever
};

/// All of it, behind one lock.
struct Scene {
    std::vector<Arm> arms{Arm{}};
    std::vector<Grip> grips{};
    Manners manners{};
    /// Where the first arm's hand is at a time [s] since the service began; null: where it is.
    std::function<Vec3(double)> hand_m{};

    [[nodiscard]] Arm* arm(std::string_view id);
    /// Lets forces end that nobody renewed.
    void forget_old_forces(Clock::time_point now);
};

/// The state message; `whole`: with the configurations, as the inventory.
[[nodiscard]] std::string state_text(const Scene& scene, bool whole);

/// What one message did.
struct Obeyed {
    bool understood{false};  ///< JSON of a known shape
    bool drives{false};      ///< it held a force, whatever became of it
    bool wrong_dialect{false};
    bool wants_whole{false};
    bool asks_preset{false};
    Vec3 force_newton{0.0};
    std::string arm{};
};

/// Does what a client's message asks for.
Obeyed obey(Scene& scene, std::string_view message, Clock::time_point now);

}  // namespace dibhr::inverse3::simulated
