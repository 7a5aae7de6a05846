// What only some builds of GLFW have, of its glfw3native.h, whose own header brings X11's macros.
#pragma once

#include <dlfcn.h>

namespace dibhr {

/// Null in a GLFW that was built for Wayland alone. Looked up by name: linkers disagree on whether
/// a weak symbol that one GLFW has may be absent from another.
template <typename Function>
Function* glfw_native(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

}  // namespace dibhr
