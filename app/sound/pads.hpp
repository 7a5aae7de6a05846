// The connected game pads and their motors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/sound/touch_source.hpp"
#include "core/sound/touch_rumble.hpp"

struct _SDL_Joystick;

namespace dibhr {

/// A pad as the Touch panel shows it.
struct FoundPad {
    std::string name{};
    bool rumbles{false};
    bool has_coils{false};  ///< voice coils: by cable, its sound device may move them

    bool operator==(const FoundPad&) const = default;
};

/// Whether initialising SDL's joysticks would copy the whole process, which makes ticks late. SDL
/// uses the session's D-Bus; with an X server but no bus, the D-Bus library forks to start one.
[[nodiscard]] bool pads_would_copy_process();

/// SDL's joysticks, from construction to destruction, all on one thread. Their buttons and sticks
/// are ignored.
class Pads {
  public:
    explicit Pads(TouchSource& source);
    ~Pads();  ///< stops all motors
    Pads(const Pads&) = delete;
    Pads& operator=(const Pads&) = delete;

    /// Opens pads that were connected, closes pads that were disconnected. A pad that cannot be
    /// opened is tried again by the next call.
    void scan();

    /// Call it often while there is a pad. `coils_move`: pads with voice coils do not rumble, which
    /// would switch off their sound.
    void set_motors(Rumble rumble, bool coils_move);

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
