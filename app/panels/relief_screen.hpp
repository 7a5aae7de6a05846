// From grid space to the window, for drawings of panels over the relief.
#pragma once

#include <imgui.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "app/panels/panels.hpp"

namespace dibhr {

class ReliefScreen {
  public:
    /// `clip_from_grid` is the relief's camera.
    ReliefScreen(const ViewerState& state, const glm::dmat4& clip_from_grid)
        : clip_from_grid_(clip_from_grid),
          low_(0.0F, panes_height(state)),
          high_(ImGui::GetIO().DisplaySize.x - panel_column_width(state),
                ImGui::GetIO().DisplaySize.y) {}

    /// The place in the window [px]; nothing: behind the camera.
    [[nodiscard]] std::optional<ImVec2> at(Vec3 place) const {
        const glm::dvec4 clip = clip_from_grid_ * glm::dvec4(place, 1.0);
        if (clip.w <= 0.0) return std::nullopt;
        return ImVec2(
            low_.x + static_cast<float>(0.5 + 0.5 * clip.x / clip.w) * (high_.x - low_.x),
            low_.y + static_cast<float>(0.5 - 0.5 * clip.y / clip.w) * (high_.y - low_.y));
    }

    /// The relief's part of the window [px].
    [[nodiscard]] ImVec2 low() const noexcept { return low_; }
    [[nodiscard]] ImVec2 high() const noexcept { return high_; }

  private:
    glm::dmat4 clip_from_grid_;
    ImVec2 low_;
    ImVec2 high_;
};

}  // namespace dibhr
