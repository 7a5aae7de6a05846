// The drawn vertices at outlines and under near faces, of which the layers are built.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render/outline_ramps.hpp"
#include "render/silhouette_layers.hpp"

namespace dibhr {

template <class Value>
struct Mean {
    Value sum{0.0F};
    float count{0.0F};

    void add(const Value& value, float weight = 1.0F) {
        sum += weight * value;
        count += weight;
    }
    /// Nothing: no value was added.
    [[nodiscard]] std::optional<Value> value() const {
        return count > 0.0F ? std::optional<Value>(sum / count) : std::nullopt;
    }
};

/// A drawn vertex at an outline, or under a near face.
struct Rim {
    GridPlace at{};
    std::optional<float> far{};         ///< of the face behind, where this vertex is not on it [px]
    std::optional<float> near{};        ///< of the face in front, likewise [px]
    std::optional<float> front{};       ///< drawn here, so that this face ends at `near` [px]
    std::optional<glm::vec2> faces{};   ///< far and near one, where they end at the outline [px]
    std::optional<glm::vec3> colour{};  ///< of the face behind, where this vertex is not on it
    std::optional<glm::vec3> own_colour{};  ///< of its own face, which is another one's far face
    std::optional<GridPlace> far_source{};  ///< a vertex of the face behind
    std::optional<GridPlace> near_source{};
    bool is_far{false};       ///< in a cut cell
    int ring{0};              ///< how many vertices from the outline, under the near face
    glm::vec2 outward{0.0F};  ///< from the near face
};

/// The rims by their places, and what is known about every drawn vertex.
class Rims {
  public:
    explicit Rims(const CutRelief& relief)
        : grid_(relief.grid),
          elevations_(relief.elevations),
          eye_(relief.eye),
          columns_(grid_.columns()),
          rows_(grid_.rows()),
          same_face_px_(kSameFace_units * static_cast<float>(outline_unit(relief.depth.from))),
          numbers_(elevations_.size(), 0) {}

    /// The number of the rim at a vertex, which is added if there is none yet.
    std::uint32_t number(GridPlace p) {
        std::uint32_t& number = numbers_[index(p)];
        if (number == 0) {
            all_.push_back({p});
            number = static_cast<std::uint32_t>(all_.size());
        }
        return number - 1;
    }
    [[nodiscard]] Rim& operator[](std::uint32_t number) { return all_[number]; }
    [[nodiscard]] const Rim& operator[](std::uint32_t number) const { return all_[number]; }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(all_.size()); }

    /// Null: there is none at this vertex.
    [[nodiscard]] const Rim* known(GridPlace p) const {
        const std::uint32_t number = numbers_[index(p)];
        return number == 0 ? nullptr : &all_[number - 1];
    }
    /// Whether a face behind is known under the vertex.
    [[nodiscard]] bool is_under(GridPlace p) const {
        const Rim* rim = known(p);
        return rim != nullptr && rim->far;
    }

    /// Calls `visit` with the rims at a vertex and its eight neighbours.
    template <class Visit>
    void each_around(GridPlace middle, const Visit& visit) const {
        const int left = std::max(middle.i - 1, 0);
        const int right = std::min(middle.i + 1, columns_ - 1);
        for (int j = std::max(middle.j - 1, 0); j <= std::min(middle.j + 1, rows_ - 1); ++j) {
            for (int i = left; i <= right; ++i)
                if (const Rim* rim = known({i, j})) visit(*rim);
        }
    }

    [[nodiscard]] bool inside(GridPlace p) const {
        return p.i >= 0 && p.j >= 0 && p.i < columns_ && p.j < rows_;
    }
    [[nodiscard]] std::size_t index(GridPlace p) const {
        return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(p.i);
    }
    [[nodiscard]] GridPlace place(std::size_t index) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
    }
    [[nodiscard]] float elevation_px(GridPlace p) const { return elevations_[index(p)]; }
    /// Whether two elevations behind a near face are of one face.
    [[nodiscard]] bool is_one_face(float far_px, float other_px) const {
        return std::abs(far_px - other_px) <= same_face_px_;
    }
    [[nodiscard]] const ReliefGrid& grid() const { return grid_; }
    [[nodiscard]] glm::vec2 in_image(GridPlace p) const {
        return {static_cast<float>(grid_.image_i(p.i)), static_cast<float>(grid_.image_j(p.j))};
    }
    /// How far what lies at `far_px` behind a vertex is seen beside it [px of the image].
    [[nodiscard]] glm::vec2 shift(GridPlace vertex, float far_px) const {
        const glm::vec2 towards = glm::vec2(eye_) - eye_.w * in_image(vertex);
        const float above = eye_.z - eye_.w * far_px;
        if (!(above > 0.0F)) return glm::vec2(0.0F);
        return towards * ((elevation_px(vertex) - far_px) / above);
    }

  private:
    static constexpr float kSameFace_units = 24.0F;  // what is steeper between neighbours is a step

    const ReliefGrid& grid_;
    const std::vector<float>& elevations_;
    glm::vec4 eye_;
    int columns_;
    int rows_;
    float same_face_px_;
    std::vector<std::uint32_t> numbers_;  // of each vertex, from 1; 0: none
    std::vector<Rim> all_{};
};

}  // namespace dibhr
