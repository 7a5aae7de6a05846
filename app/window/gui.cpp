// Dear ImGui's context, fonts and theme.
#include "app/window/gui.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <filesystem>

namespace dibhr {

namespace {

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

}  // namespace

Gui::Gui(const Window& window) : scale_(window.content_scale()) {
    IMGUI_CHECKVERSION();
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

void Gui::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
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
