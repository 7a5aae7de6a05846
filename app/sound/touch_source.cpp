// How SDL is kept from disturbing the rest of the program.
#include "app/sound/touch_source.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>
#include <alsa/asoundlib.h>

#include <chrono>

namespace dibhr {

namespace {

/// Ignores ALSA's error messages: a machine without a sound card is no error.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

SdlTurn::Taken::Taken(SdlTurn& turn) : turn_(turn) {
    constexpr auto kPatience = std::chrono::seconds(1);
    std::unique_lock lock(turn.mutex_);
    mine_ = turn.given_back_.wait_for(lock, kPatience, [&turn] { return !turn.taken_; });
    if (mine_) turn.taken_ = true;
}

SdlTurn::Taken::~Taken() {
    if (!mine_) return;
    const std::lock_guard lock(turn_.mutex_);
    turn_.taken_ = false;
    turn_.given_back_.notify_all();
}

void teach_sdl_manners() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program handles signals itself
    SDL_SetHint(SDL_HINT_APP_NAME, "dibhr");
    SDL_SetHint(SDL_HINT_AUDIO_DEVICE_STREAM_NAME, "Touch");
    // The kernel's drivers can rumble; SDL's drivers would open every pad and set its lights.
    SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // SDL has no window
    snd_lib_error_set_handler(say_nothing);
}

}  // namespace dibhr
