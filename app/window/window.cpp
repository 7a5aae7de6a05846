// The window, through GLFW; Dear ImGui's context, fonts and theme.
#include "app/window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <thread>
#include <utility>

#include "app/settings/settings.hpp"
#include "app/window/display_loss.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

WindowInput& input_of(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

bool pressed(GLFWwindow* window, int button) {
    return glfwGetMouseButton(window, button) == GLFW_PRESS;
}

bool key_down(GLFWwindow* window, int key) {
    return glfwGetKey(window, key) == GLFW_PRESS;
}

/// Newer GLFW tries Wayland first and complains on stderr where there is none.
void choose_display_server() {
#ifdef GLFW_PLATFORM
    const char* const wayland = std::getenv("WAYLAND_DISPLAY");
    if (wayland == nullptr || *wayland == '\0') glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

GLFWwindow* open_window(int width, int height, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 24);
    // Where the driver can: its reset is told, and not a crash.
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    return glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
}

/// ImGui takes for granted that there is memory.
void* allocate_or_throw(std::size_t bytes, void*) {
    void* const memory = std::malloc(std::max<std::size_t>(bytes, 1));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

constexpr float kTextHeight_px = 13.5F;

ImVec4 grey_blue(float lightness, float alpha = 1.0F) {
    return {lightness * 0.94F, lightness * 0.98F, lightness * 1.04F, alpha};
}

void set_spacing(ImGuiStyle& style, float scale) {
    style.WindowPadding = {12.0F, 10.0F};
    style.FramePadding = {8.0F, 3.0F};
    style.ItemSpacing = {8.0F, 4.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.ScrollbarSize = 10.0F;
    style.GrabMinSize = 8.0F;
    style.WindowRounding = 0.0F;
    style.ChildRounding = style.FrameRounding = style.GrabRounding = style.PopupRounding = 4.0F;
    style.ScrollbarRounding = 5.0F;
    style.WindowBorderSize = 0.0F;
    style.FrameBorderSize = 0.0F;
    style.ScaleAllSizes(scale);
}

void set_colours(ImGuiStyle& style) {
    const ImVec4 accent{0.29F, 0.62F, 0.66F, 1.0F};
    const ImVec4 accent_bright{0.39F, 0.74F, 0.78F, 1.0F};
    ImVec4* colours = style.Colors;
    colours[ImGuiCol_Text] = grey_blue(0.88F);
    colours[ImGuiCol_TextDisabled] = grey_blue(0.60F);
    colours[ImGuiCol_WindowBg] = grey_blue(0.095F);
    colours[ImGuiCol_PopupBg] = grey_blue(0.13F, 0.98F);
    colours[ImGuiCol_Border] = grey_blue(0.24F);
    colours[ImGuiCol_FrameBg] = grey_blue(0.17F);
    colours[ImGuiCol_FrameBgHovered] = grey_blue(0.22F);
    colours[ImGuiCol_FrameBgActive] = grey_blue(0.25F);
    colours[ImGuiCol_Header] = grey_blue(0.14F);
    colours[ImGuiCol_HeaderHovered] = grey_blue(0.19F);
    colours[ImGuiCol_HeaderActive] = grey_blue(0.22F);
    colours[ImGuiCol_Button] = grey_blue(0.20F);
    colours[ImGuiCol_ButtonHovered] = grey_blue(0.27F);
    colours[ImGuiCol_ButtonActive] = grey_blue(0.32F);
    // The value is written over it.
    colours[ImGuiCol_SliderGrab] = {accent.x, accent.y, accent.z, 0.45F};
    colours[ImGuiCol_SliderGrabActive] = accent;
    colours[ImGuiCol_CheckMark] = accent_bright;
    colours[ImGuiCol_Separator] = grey_blue(0.20F);
    colours[ImGuiCol_ScrollbarBg] = grey_blue(0.095F);
    colours[ImGuiCol_ScrollbarGrab] = grey_blue(0.24F);
    colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = grey_blue(0.14F);
    colours[ImGuiCol_ModalWindowDimBg] = {0.0F, 0.0F, 0.0F, 0.45F};
    colours[ImGuiCol_TextSelectedBg] = {accent.x, accent.y, accent.z, 0.4F};
}

/// The distribution's font when it is there; ImGui's own is a bitmap of 13 pixels.
ImFont* load_font(const char* name, float height_px) {
    const std::filesystem::path file =
        std::filesystem::path("/usr/share/fonts/truetype/dejavu") / name;
    if (!std::filesystem::exists(file)) return nullptr;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), height_px);
}

Fonts load_fonts(float scale) {
    Fonts fonts{load_font("DejaVuSans.ttf", kTextHeight_px * scale),
                load_font("DejaVuSans-Bold.ttf", kTextHeight_px * scale)};
    if (fonts.text == nullptr) {
        ImFontConfig sharp;
        sharp.SizePixels = 13.0F * scale;
        fonts.text = ImGui::GetIO().Fonts->AddFontDefault(&sharp);
    }
    if (fonts.heading == nullptr) fonts.heading = fonts.text;
    return fonts;
}

#if IMGUI_VERSION_NUM < 18700
/// Keys that count as down for as long as it lives.
class LingeringKeys {
  public:
    explicit LingeringKeys(std::span<const KeyPress> pressed) {
        bool* const down = ImGui::GetIO().KeysDown;
        constexpr int kKeys = IM_ARRAYSIZE(ImGuiIO::KeysDown);
        for (const KeyPress& press : pressed) {
            if (press.key < 0 || press.key >= kKeys || down[press.key]) continue;
            down[press.key] = true;
            keys_.push_back(press.key);
        }
    }
    ~LingeringKeys() {
        for (const int key : keys_) ImGui::GetIO().KeysDown[key] = false;
    }
    LingeringKeys(const LingeringKeys&) = delete;
    LingeringKeys& operator=(const LingeringKeys&) = delete;

  private:
    std::vector<int> keys_{};
};
#endif

}  // namespace

Window::Window(int width, int height, bool sync, const std::string& title) : size_{width, height} {
    choose_display_server();
    if (glfwInit() != GLFW_TRUE) {
        throw DeviceError(
            "no display: set DISPLAY, or unset it and use ./app/run, which makes a virtual one");
    }
    when_display_goes(display_lost_);
    window_ = open_window(width, height, title);
    if (window_ == nullptr) {
        const char* reason = nullptr;
        glfwGetError(&reason);
        const std::string text = reason != nullptr ? reason : "no reason given";
        glfwTerminate();
        throw DeviceError("cannot open a window with OpenGL 3.3 (" + text +
                          "): install a graphics driver, or libgl1-mesa-dri for software drawing");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(sync ? 1 : 0);
    glfwSetWindowSizeLimits(window_, kSmallestWindow, kSmallestWindow, GLFW_DONT_CARE,
                            GLFW_DONT_CARE);
    glfwSetWindowUserPointer(window_, &input_);
    collect_events();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::collect_events() {
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
        if (action == GLFW_RELEASE) return;
        input_of(window).keys.push_back({key, (mods & GLFW_MOD_CONTROL) != 0, action == GLFW_REPEAT,
                                         (mods & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
        WindowInput& input = input_of(window);
        // GLFW tells a character right after the key that typed it.
        const bool repeated = !input.keys.empty() && input.keys.back().repeated;
        input.characters.push_back({character, repeated});
    });
    glfwSetScrollCallback(
        window_, [](GLFWwindow* window, double, double up) { input_of(window).wheel_steps += up; });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
        input_of(window).dropped.assign(files, files + count);
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int given) {
        WindowFocus& focus = input_of(window).focus;
        focus.has = given == GLFW_TRUE;
        focus.had = true;  // also by losing it
    });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* window, int iconified) {
        input_of(window).focus.iconified = iconified == GLFW_TRUE;
    });
}

void Window::leave_without_display() {
    if (on_display_loss_) on_display_loss_();
    print_error_line("the display went away: start dibhr again when it is back");
    // No destructor and no handler of exit(): a driver's would talk to the display.
    _exit(EXIT_FAILURE);
}

bool Window::wants_to_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

WindowInput Window::take_input() {
    glfwPollEvents();
    return std::exchange(input_, {.focus = input_.focus});
}

Pointer Window::pointer() const {
    glm::dvec2 position{0.0};
    glfwGetCursorPos(window_, &position.x, &position.y);
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const glm::dvec2 pixels_per_unit = glm::dvec2(framebuffer_size()) / glm::dvec2(width, height);
    return {position * pixels_per_unit, pressed(window_, GLFW_MOUSE_BUTTON_LEFT),
            pressed(window_, GLFW_MOUSE_BUTTON_MIDDLE), pressed(window_, GLFW_MOUSE_BUTTON_RIGHT),
            key_down(window_, GLFW_KEY_LEFT_SHIFT) || key_down(window_, GLFW_KEY_RIGHT_SHIFT)};
}

bool Window::holds(int key) const {
    return key_down(window_, key);
}

glm::ivec2 Window::framebuffer_size() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::window_size() const {
    if (glfwGetWindowMonitor(window_) != nullptr) return size_;
    glm::ivec2 size{0};
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

float Window::content_scale() const {
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::isfinite(x) && x > 0.5F ? x : 1.0F;
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

bool Window::full_screen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::toggle_full_screen() {
    if (full_screen()) {
        glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, size_.x, size_.y,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &place_.x, &place_.y);
    size_ = window_size();
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::show_picture() {
    glfwSwapBuffers(window_);
}

void PicturePace::wait() {
    if (next_ == Clock::time_point{}) next_ = second_begin_ = Clock::now();
    next_ = std::max(next_ + shortest_, Clock::now());
    std::this_thread::sleep_until(next_);
    ++pictures_;
    const double age_s = std::chrono::duration<double>(Clock::now() - second_begin_).count();
    if (age_s < 1.0) return;
    pictures_per_s_ = pictures_ / age_s;
    pictures_ = 0;
    second_begin_ = Clock::now();
}

Gui::Gui(const Window& window) : scale_(window.content_scale()) {
    IMGUI_CHECKVERSION();
    ImGui::SetAllocatorFunctions(allocate_or_throw, [](void* memory, void*) { std::free(memory); });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
    set_spacing(ImGui::GetStyle(), scale_);
    set_colours(ImGui::GetStyle());
    fonts_ = load_fonts(scale_);
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::begin(std::span<const KeyPress> pressed) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
#if IMGUI_VERSION_NUM < 18700
    // It looks at what is down now: a key that came up again since the last picture would be lost.
    const LingeringKeys lingering(pressed);
#else
    static_cast<void>(pressed);  // it has all of them in a queue
#endif
    ImGui::NewFrame();
}

void Gui::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wants_pointer() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wants_keyboard() const {
    return ImGui::GetIO().WantTextInput;
}

}  // namespace dibhr
