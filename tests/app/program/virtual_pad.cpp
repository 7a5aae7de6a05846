// Preloaded into the program: a game pad that SDL pretends to have. VIRTUAL_PAD names the file that
// what its motors are told is written into, a line each: low and high, 0 .. 65535.
#define SDL_MAIN_HANDLED
#include <SDL.h>
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace {

int SDLCALL write_down(void*, Uint16 low, Uint16 high) {
    const char* name = std::getenv("VIRTUAL_PAD");
    std::FILE* file = name == nullptr ? nullptr : std::fopen(name, "a");
    if (file == nullptr) return -1;
    std::fprintf(file, "%d %d\n", low, high);
    return std::fclose(file);
}

void plug_in() {
    SDL_VirtualJoystickDesc pad{};
    pad.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    pad.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    pad.naxes = 6;
    pad.nbuttons = 15;
    pad.name = "Virtual pad";
    pad.Rumble = &write_down;
    SDL_JoystickAttachVirtualEx(&pad);
}

}  // namespace

extern "C" int SDLCALL SDL_InitSubSystem(Uint32 flags) {
    using Init = int(SDLCALL*)(Uint32);
    const auto init = reinterpret_cast<Init>(::dlsym(RTLD_NEXT, "SDL_InitSubSystem"));
    if (init == nullptr) return -1;
    const int result = init(flags);
    if (result == 0 && (flags & SDL_INIT_JOYSTICK) != 0) plug_in();
    return result;
}
