// Dear ImGui's context, fonts and theme.
#include "app/window/gui.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fontconfig/fontconfig.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/window/gui_input.hpp"

namespace dibhr {

namespace {

/// ImGui does not check whether an allocation failed.
void* allocate_or_throw(std::size_t bytes, void*) {
    void* const memory = std::malloc(std::max<std::size_t>(bytes, 1));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

constexpr float kTextHeight_px = 13.5F;
constexpr float kLargeText_px = 20.0F;

/// Greys with a touch of blue: less of it the lighter they are.
ImVec4 grey_blue(float lightness, float alpha = 1.0F) {
    const float tint = 0.05F * (1.0F - 0.85F * lightness);
    return {lightness * (1.0F - 1.2F * tint), lightness * (1.0F - 0.4F * tint),
            std::min(lightness * (1.0F + 0.8F * tint), 1.0F), alpha};
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

/// The lightness of a colour in each theme.
struct Shade {
    float dark, light;
};

void set_colours(ImGuiStyle& style, Theme theme) {
    const bool dark = theme == Theme::dark;
    const auto grey = [dark](Shade shade, float alpha = 1.0F) {
        return grey_blue(dark ? shade.dark : shade.light, alpha);
    };
    const ImVec4 accent =
        dark ? ImVec4{0.29F, 0.62F, 0.66F, 1.0F} : ImVec4{0.16F, 0.56F, 0.61F, 1.0F};
    const ImVec4 accent_text =
        dark ? ImVec4{0.39F, 0.74F, 0.78F, 1.0F} : ImVec4{0.02F, 0.42F, 0.47F, 1.0F};
    ImVec4* colours = style.Colors;
    colours[ImGuiCol_Text] = grey({0.88F, 0.10F});
    colours[ImGuiCol_TextDisabled] = grey({0.60F, 0.36F});
    colours[ImGuiCol_WindowBg] = grey({0.095F, 0.93F});
    colours[ImGuiCol_PopupBg] = grey({0.13F, 0.96F}, 0.98F);
    colours[ImGuiCol_Border] = grey({0.24F, 0.74F});
    colours[ImGuiCol_FrameBg] = grey({0.17F, 0.86F});
    colours[ImGuiCol_FrameBgHovered] = grey({0.22F, 0.82F});
    colours[ImGuiCol_FrameBgActive] = grey({0.25F, 0.78F});
    colours[ImGuiCol_Header] = grey({0.14F, 0.88F});
    colours[ImGuiCol_TableHeaderBg] = grey({0.17F, 0.86F});
    colours[ImGuiCol_HeaderHovered] = grey({0.19F, 0.83F});
    colours[ImGuiCol_HeaderActive] = grey({0.22F, 0.80F});
    colours[ImGuiCol_Button] = grey({0.20F, 0.81F});
    colours[ImGuiCol_ButtonHovered] = grey({0.27F, 0.75F});
    colours[ImGuiCol_ButtonActive] = grey({0.32F, 0.69F});
    // Half transparent, because the value is written over the grab.
    colours[ImGuiCol_SliderGrab] = {accent.x, accent.y, accent.z, 0.45F};
    colours[ImGuiCol_SliderGrabActive] = accent;
    colours[ImGuiCol_CheckMark] = accent_text;
    colours[ImGuiCol_Separator] = grey({0.20F, 0.78F});
    colours[ImGuiCol_ScrollbarBg] = grey({0.095F, 0.93F});
    colours[ImGuiCol_ScrollbarGrab] = grey({0.24F, 0.74F});
    colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = grey({0.14F, 0.86F});
    colours[ImGuiCol_ModalWindowDimBg] = {0.0F, 0.0F, 0.0F, 0.45F};
    colours[ImGuiCol_TextSelectedBg] = {accent.x, accent.y, accent.z, 0.4F};
}

/// A font's file, and the number of the font in it.
struct FontFile {
    std::string name{};
    int number{0};
};

std::optional<FontFile> matched(FcPattern* wanted) {
    FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result = FcResultNoMatch;
    FcPattern* const match = FcFontMatch(nullptr, wanted, &result);
    if (match == nullptr) return std::nullopt;
    FcChar8* name = nullptr;
    FcChar8* format = nullptr;
    FontFile file;
    const bool known = FcPatternGetString(match, FC_FILE, 0, &name) == FcResultMatch &&
                       FcPatternGetString(match, FC_FONTFORMAT, 0, &format) == FcResultMatch;
    // On other formats ImGui's font reader stops the program.
    const bool readable =
        known && std::string_view(reinterpret_cast<const char*>(format)) == "TrueType";
    if (readable) file.name = reinterpret_cast<const char*>(name);
    FcPatternGetInteger(match, FC_INDEX, 0, &file.number);
    FcPatternDestroy(match);
    return readable ? std::optional(file) : std::nullopt;
}

/// The desktop's sans-serif font; nothing if fontconfig finds none.
std::optional<FontFile> desktop_font(int weight) {
    FcPattern* const wanted = FcPatternCreate();
    FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcPatternAddInteger(wanted, FC_WEIGHT, weight);
    FcPatternAddInteger(wanted, FC_SLANT, FC_SLANT_ROMAN);
    FcPatternAddBool(wanted, FC_SCALABLE, FcTrue);
    FcPatternAddBool(wanted, FC_VARIABLE, FcFalse);
    auto font = matched(wanted);
    FcPatternDestroy(wanted);
    return font;
}

/// Alphabets written from left to right, letter by letter, and their signs. Other letters, and
/// letters that the font lacks, are shown as "?".
constexpr ImWchar kLetters[] = {0x20,   0x36F,   // Latin, and accents that follow their letter
                                0x370,  0x58F,   // Greek, Cyrillic, Armenian
                                0x10A0, 0x10FF,  // Georgian
                                0x1E00, 0x1FFF,  // Latin of Vietnamese, Greek with all accents
                                0x2010, 0x205E,  // dashes, quotation marks
                                0x2070, 0x20BF,  // raised and lowered digits, currencies
                                0x2100, 0x22FF,  // letterlike signs, fractions, arrows, mathematics
                                0x25A0, 0x25FF,  // shapes
                                0x2713, 0x2717,  // ticks
                                0};

ImFont* load_font(int weight, float height_px) {
    const auto file = desktop_font(weight);
    if (!file || ::access(file->name.c_str(), R_OK) != 0) return nullptr;
    ImFontConfig config;
    config.FontNo = file->number & 0xFFFF;
    // 3, as ImGui 1.86 has it, looks the same and takes 6 MB more; large letters need none.
    config.OversampleH = height_px > kLargeText_px ? 1 : 2;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file->name.c_str(), height_px, &config,
                                                    kLetters);
}

Fonts load_fonts(float scale) {
    Fonts fonts{load_font(FC_WEIGHT_REGULAR, kTextHeight_px * scale),
                load_font(FC_WEIGHT_BOLD, kTextHeight_px * scale),
                load_font(FC_WEIGHT_BOLD, 1.5F * kTextHeight_px * scale)};
    if (fonts.text == nullptr) {
        ImFontConfig sharp;
        sharp.SizePixels = 13.0F * scale;
        fonts.text = ImGui::GetIO().Fonts->AddFontDefault(&sharp);
    }
    if (fonts.heading == nullptr) fonts.heading = fonts.text;
    if (fonts.title == nullptr) fonts.title = fonts.heading;
    return fonts;
}

void set_style(const GuiStyle& gui_style) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    if (gui_style.theme == Theme::dark)
        ImGui::StyleColorsDark();
    else
        ImGui::StyleColorsLight();
    set_spacing(style, gui_style.scale);
    set_colours(style, gui_style.theme);
}

/// Whether a field has the keyboard in the next picture.
bool field_reads() {
    return ImGui::GetCurrentContext()->WantTextInputNextFrame == 1;
}

}  // namespace

Gui::Gui(const Window& window, const GuiStyle& gui_style) : style_(gui_style) {
    IMGUI_CHECKVERSION();
    ImGui::SetAllocatorFunctions(allocate_or_throw, [](void* memory, void*) { std::free(memory); });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().UserData = &focus_;
    set_style(style_);
    fonts_ = load_fonts(style_.scale);
    ImGui::GetIO().Fonts->Build();  // now, while another thread opens the files
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330");
#if IMGUI_VERSION_NUM < 18700
    ImGui::GetIO().KeyMap[ImGuiKey_Tab] = -1;  // the focus moves by it, not ImGui
#endif
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::apply(const GuiStyle& gui_style) {
    if (gui_style == style_) return;
    const bool other_size = gui_style.scale != style_.scale;
    style_ = gui_style;
    set_style(style_);
    if (!other_size) return;
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui::GetIO().Fonts->Clear();
    fonts_ = load_fonts(style_.scale);
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

/// Panels are laid out in pixels of the framebuffer, as all else is. Under Wayland a screen unit
/// may be several of them.
void Gui::lay_out_in_pixels() {
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 pixels = std::exchange(io.DisplayFramebufferScale, {1.0F, 1.0F});
    if (!(pixels.x > 0.0F && pixels.y > 0.0F)) return;  // a window without a size
    io.DisplaySize = {std::round(io.DisplaySize.x * pixels.x),
                      std::round(io.DisplaySize.y * pixels.y)};
    scale_pointer(pixels, events_left_);
}

void Gui::drop_characters(std::size_t count) {
    if (count == 0 || field_reads()) return;
    const std::vector<unsigned> typed = take_characters();
    for (std::size_t k = count; k < typed.size(); ++k) ImGui::GetIO().AddInputCharacter(typed[k]);
}

/// A field reads characters only in the picture after the one in which it gets the keyboard.
void Gui::keep_early_text(bool text_opens) {
    const bool keeps = text_opens && !field_reads();
    if (!keeps && early_text_.empty()) return;
    for (const unsigned character : take_characters()) {
        const bool opened_it = character == ' ' && early_text_.empty();
        if (!opened_it) early_text_.push_back(character);
    }
    if (keeps) return;
    for (const unsigned character : early_text_) ImGui::GetIO().AddInputCharacter(character);
    early_text_.clear();
}

/// A field reads no characters while Control is down: what was typed after a missed key with
/// Control waits for the next picture.
void Gui::catch_up_control(const WindowInput& input) {
    control_missed_ = late_text_.empty() && field_reads() && missed_control(input);
    if (control_missed_) {
        set_control(true);
        late_text_ = take_characters();
    } else if (!late_text_.empty()) {
        const std::vector<unsigned> newest = take_characters();
        for (const auto& text : {std::exchange(late_text_, {}), newest})
            for (const unsigned character : text) ImGui::GetIO().AddInputCharacter(character);
    }
}

void Gui::begin(const WindowInput& input, bool text_opens) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::GetIO().Fonts->ClearTexData();  // OpenGL has its own: 10 MB
    ImGui_ImplGlfw_NewFrame();
    lay_out_in_pixels();
    const LingeringKeys lingering(input.keys);
    drop_tabs();
    keep_early_text(text_opens);
    catch_up_control(input);
    ImGui::NewFrame();
    events_left_ = queued_events();
    focus_.begin();
    constexpr bool kFocusReturns = true;
    if (std::exchange(closes_lists_, false) && list_is_open())
        ImGui::ClosePopupToLevel(0, kFocusReturns);
}

void Gui::end() {
    focus_.end(style_.scale);
    ImGui::Render();
    if (std::exchange(control_missed_, false)) set_control(false);
}

void Gui::draw() {
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

std::size_t Gui::content() const {
    const ImDrawData& data = *ImGui::GetDrawData();
    std::size_t all = 0;
    const auto add = [&all](const void* bytes, std::size_t size) {
        const std::string_view text(static_cast<const char*>(bytes), size);
        all = 31 * all + std::hash<std::string_view>{}(text);
    };
    const auto add_all = [&add](const auto& values) {
        add(values.Data, static_cast<std::size_t>(values.size_in_bytes()));
    };
    add(&data.DisplaySize, sizeof data.DisplaySize);
    for (int k = 0; k < data.CmdListsCount; ++k) {
        const ImDrawList& list = *data.CmdLists[k];
        add_all(list.VtxBuffer);
        add_all(list.IdxBuffer);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImTextureID texture = command.GetTexID();
            add(&texture, sizeof texture);
            add(&command.ClipRect, sizeof command.ClipRect);
            add(&command.ElemCount, sizeof command.ElemCount);
        }
    }
    return all;
}

bool Gui::in_use() const {
    return ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown() || focus_.busy();
}

void Gui::copy(const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
}

std::string Gui::copied() const {
    const char* const text = ImGui::GetClipboardText();
    return text != nullptr ? text : "";
}

bool Gui::covers(glm::dvec2 place_px) const {
    if (list_is_open()) return true;
    const ImVec2 place(static_cast<float>(place_px.x), static_cast<float>(place_px.y));
    const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
    return std::any_of(windows.begin(), windows.end(), [place](const ImGuiWindow* window) {
        return window->Active && !window->Hidden &&
               (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
               window->OuterRectClipped.Contains(place);
    });
}

bool Gui::wants_keyboard() const {
    return ImGui::GetIO().WantTextInput;
}

bool Gui::list_is_open() const {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Gui::close_lists() {
    closes_lists_ = true;
}

}  // namespace dibhr
