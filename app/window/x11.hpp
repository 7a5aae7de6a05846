// The X server that GLFW is connected to. Only for files without other libraries of windows: Xlib's
// header defines plain words as macros.
#pragma once

#include <X11/Xlib.h>

#include "app/window/glfw_native.hpp"

namespace dibhr {

/// Null under another display server.
inline Display* x11_display() {
    const auto display = glfw_native<Display*()>("glfwGetX11Display");
    return display == nullptr ? nullptr : display();
}

}  // namespace dibhr
