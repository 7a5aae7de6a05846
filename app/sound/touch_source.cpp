// How SDL is kept from disturbing the rest of the program.
#include "app/sound/touch_source.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>
#include <alsa/asoundlib.h>

#include <chrono>

namespace dibhr {

namespace {

/// Ignores ALSA's error messages: a machine without a sound card is no error.
void ignore_alsa_error(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

SdlLock::Guard::Guard(SdlLock& sdl_lock) : sdl_lock_(sdl_lock) {
    constexpr auto kTurnTimeout = std::chrono::seconds(1);
    std::unique_lock lock(sdl_lock.mutex_);
    owned_ =
        sdl_lock.released_.wait_for(lock, kTurnTimeout, [&sdl_lock] { return !sdl_lock.locked_; });
    if (owned_) sdl_lock.locked_ = true;
}

SdlLock::Guard::~Guard() {
    if (!owned_) return;
    const std::lock_guard lock(sdl_lock_.mutex_);
    sdl_lock_.locked_ = false;
    sdl_lock_.released_.notify_all();
}

void configure_sdl() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program handles signals itself
    SDL_SetHint(SDL_HINT_APP_NAME, "dibhr");
    SDL_SetHint(SDL_HINT_AUDIO_DEVICE_STREAM_NAME, "Touch");
    // The kernel's drivers can rumble; SDL's drivers would open every pad and set its lights.
    SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // SDL has no window
    snd_lib_error_set_handler(ignore_alsa_error);
}

}  // namespace dibhr
