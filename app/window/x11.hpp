// The X server that GLFW is connected to. Only for files without other window libraries: Xlib's
// header defines plain words as macros.
#pragma once

#include <X11/Xlib.h>
#include <dlfcn.h>

namespace dibhr {

/// A function of glfw3native.h that only some builds of GLFW have; null in a build for Wayland
/// only. Looked up by name, because linkers disagree on whether a weak symbol may be absent from
/// one GLFW and present in another.
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
