// A real OpenGL 3.3 core context for the tests, in a hidden window; counts the driver's errors.
#pragma once

#include <epoxy/gl.h>
// After epoxy, which brings the OpenGL declarations.
#include <GLFW/glfw3.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace dibhr {

class HiddenWindow {
  public:
    HiddenWindow() {
        // Once for all tests: a virtual display resets itself when its last client disconnects.
        static const bool ready = glfwInit() == GLFW_TRUE;
        if (!ready) throw std::runtime_error("no display: run under xvfb-run");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        window_ = glfwCreateWindow(64, 48, "dibhr test", nullptr, nullptr);
        if (!window_) throw std::runtime_error("no OpenGL 3.3 core context");
        glfwMakeContextCurrent(window_);
        if (epoxy_has_gl_extension("GL_KHR_debug")) {
            glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
            glDebugMessageCallback(&HiddenWindow::note, this);
        }
    }
    ~HiddenWindow() { glfwDestroyWindow(window_); }
    HiddenWindow(const HiddenWindow&) = delete;
    HiddenWindow& operator=(const HiddenWindow&) = delete;

    /// The driver's error messages so far.
    [[nodiscard]] std::vector<std::string> errors() {
        for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
            errors_.push_back("glGetError " + std::to_string(error));
        }
        return errors_;
    }

  private:
    static void GLAPIENTRY note(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                                const void* self) {
        if (type != GL_DEBUG_TYPE_ERROR) return;
        static_cast<HiddenWindow*>(const_cast<void*>(self))->errors_.emplace_back(text);
    }

    GLFWwindow* window_{nullptr};
    std::vector<std::string> errors_{};
};

}  // namespace dibhr
