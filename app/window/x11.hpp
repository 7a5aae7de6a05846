// The X server that GLFW is connected to. Only for files without other libraries of windows: Xlib's
// header defines plain words as macros.
#pragma once

#include <X11/Xlib.h>
#include <dlfcn.h>

namespace dibhr {

/// What only some builds of GLFW have, of its glfw3native.h, whose own header needs GLFW's; null in
/// one that was built for Wayland alone. Looked up by name: linkers disagree on whether a weak
/// symbol that one GLFW has may be absent from another.
template <typename Function>
Function* glfw_native(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Null under another display server.
inline Display* x11_display() {
    const auto display = glfw_native<Display*()>("glfwGetX11Display");
    return display == nullptr ? nullptr : display();
}

}  // namespace dibhr
