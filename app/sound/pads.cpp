// SDL's joysticks.
#include "app/sound/pads.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "core/files/machine.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostPads = 8;
constexpr Uint16 kSony = 0x054c;
constexpr Uint16 kDualSense = 0x0ce6;
constexpr Uint16 kDualSenseEdge = 0x0df2;
constexpr Uint32 kRumbleDuration_ms = 1000;  // set_motors() renews the rumble long before its end
constexpr double kSteps = 64.0;              // smaller changes are not sent to a pad

Uint16 motor(double strength) {
    return static_cast<Uint16>(std::lround(std::round(kSteps * strength) / kSteps * 65535.0));
}

bool has_coils(SDL_Joystick* joystick) {
    const Uint16 product = SDL_JoystickGetProduct(joystick);
    return SDL_JoystickGetVendor(joystick) == kSony &&
           (product == kDualSense || product == kDualSenseEdge);
}

/// Updates SDL's list of pads and discards their events.
void read_pads() {
    SDL_JoystickUpdate();
    SDL_FlushEvents(SDL_FIRSTEVENT, SDL_LASTEVENT);
}

}  // namespace

bool pads_would_copy_process() {
    if (!environment_variable("DBUS_SESSION_BUS_ADDRESS").empty() ||
        environment_variable("DISPLAY").empty())
        return false;
    const std::filesystem::path folder = environment_variable("XDG_RUNTIME_DIR");
    std::error_code failed;
    return folder.empty() || !std::filesystem::exists(folder / "bus", failed);
}

Pads::Pads(TouchSource& source) : source_(source) {
    const SdlLock::Guard guard(source.sdl);
    initialised_ = SDL_InitSubSystem(SDL_INIT_JOYSTICK) == 0;
}

Pads::~Pads() {
    set_motors({}, false);
    const SdlLock::Guard guard(source_.sdl);
    for (const Pad& pad : pads_) SDL_JoystickClose(pad.joystick);
    if (initialised_) SDL_QuitSubSystem(SDL_INIT_JOYSTICK);
}

void Pads::scan() {
    if (!initialised_) return;
    read_pads();
    std::erase_if(pads_, [](const Pad& pad) {
        if (SDL_JoystickGetAttached(pad.joystick) == SDL_TRUE) return false;
        SDL_JoystickClose(pad.joystick);
        return true;
    });
    for (int k = 0; k < SDL_NumJoysticks() && pads_.size() < kMostPads; ++k) {
        const SDL_JoystickID id = SDL_JoystickGetDeviceInstanceID(k);
        if (std::none_of(pads_.begin(), pads_.end(), [id](const Pad& pad) { return pad.id == id; }))
            open(k);
    }
}

void Pads::open(int index) {
    SDL_Joystick* joystick = SDL_JoystickOpen(index);
    if (joystick == nullptr) return;
    const char* name = SDL_JoystickName(joystick);
    pads_.push_back({.joystick = joystick,
                     .id = SDL_JoystickInstanceID(joystick),
                     .found = {.name = name == nullptr ? "Game pad" : name,
                               .rumbles = SDL_JoystickHasRumble(joystick) == SDL_TRUE,
                               .has_coils = has_coils(joystick)}});
}

void Pads::set_motors(Rumble rumble, bool coils_move) {
    if (pads_.empty()) return;
    read_pads();
    for (const Pad& pad : pads_) {
        if (!pad.found.rumbles) continue;
        const Rumble own = coils_move && pad.found.has_coils ? Rumble{} : rumble;
        SDL_JoystickRumble(pad.joystick, motor(own.low), motor(own.high), kRumbleDuration_ms);
    }
}

std::vector<FoundPad> Pads::found() const {
    std::vector<FoundPad> found;
    for (const Pad& pad : pads_) found.push_back(pad.found);
    return found;
}

}  // namespace dibhr
