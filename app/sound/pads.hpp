// The game pads that are plugged in, and their motors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/sound/touch_source.hpp"
#include "core/sound/touch_rumble.hpp"

struct _SDL_Joystick;

namespace dibhr {

/// A pad as people are told of it.
struct FoundPad {
    std::string name{};
    bool rumbles{false};
    bool has_coils{false};  ///< by cable it may show as a sound device that moves them

    bool operator==(const FoundPad&) const = default;
};

/// Whether setting up SDL's pads would copy the whole process, and so make ticks late: SDL asks the
/// session's D-Bus, and where nobody has started one the D-Bus library does, beside an X server.
[[nodiscard]] bool pads_would_copy_process();

/// SDL's joysticks, from construction to destruction, on one thread. What is pressed or moved on
/// them is read from nobody.
class Pads {
  public:
    explicit Pads(TouchSource& source);
    ~Pads();  ///< no motor turns any more
    Pads(const Pads&) = delete;
    Pads& operator=(const Pads&) = delete;

    /// Takes note of what has been plugged in and pulled out. What cannot be opened is tried again
    /// the next time.
    void look();

    /// To be called often while there is a pad. `coils_move`: pads that have them do not rumble,
    /// which would switch them over from their sound.
    void turn(Rumble rumble, bool coils_move);

    [[nodiscard]] bool empty() const noexcept { return pads_.empty(); }
    [[nodiscard]] std::vector<FoundPad> found() const;

  private:
    struct Pad {
        _SDL_Joystick* joystick{nullptr};
        std::int32_t id{-1};
        FoundPad found{};
    };
    void open(int index);

    TouchSource& source_;
    bool initialised_{false};
    std::vector<Pad> pads_{};
};

}  // namespace dibhr
