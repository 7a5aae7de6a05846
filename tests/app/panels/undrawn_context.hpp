// A context of Dear ImGui whose pictures are laid out and not drawn.
#pragma once

#include <imgui.h>

namespace dibhr::test {

/// The current context while it lives, of 800 x 600 pixels.
class UndrawnContext {
  public:
    UndrawnContext() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800.0F, 600.0F};
        io.DeltaTime = 1.0F / 30.0F;
        unsigned char* pixels = nullptr;
        int columns = 0;
        int rows = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &columns, &rows);
    }
    ~UndrawnContext() { ImGui::DestroyContext(); }
    UndrawnContext(const UndrawnContext&) = delete;
    UndrawnContext& operator=(const UndrawnContext&) = delete;
};

}  // namespace dibhr::test
