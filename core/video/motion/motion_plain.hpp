// Parts of a plain colour: their own pixels do not say where they go, the outlines of their surface
// do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/motion/motion_cells.hpp"

namespace dibhr {

/// The plain parts of a frame, in groups: the parts of a group are of one surface, continuous in
/// depth.
class PlainParts {
  public:
    struct Part {
        std::size_t part, k;
        std::size_t group{0};
        std::size_t begin{0}, end{0};  ///< its neighbours in edges_
        bool has_outline{false};
    };

    void clear(const MotionCells& cells);
    /// Finds the plain parts among those that have changed and up to `reach` cells away from them.
    /// `structure`: sums of the slopes of the parts' own colour and that of similar parts around.
    void find(const MotionCells& cells, const MotionLayers& changed, const MotionSums& structure,
              int reach);

    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    [[nodiscard]] std::size_t groups() const { return groups_; }
    [[nodiscard]] const MotionLayers& layers() const { return is_plain_; }  ///< 1: plain
    [[nodiscard]] bool has(std::size_t part, std::size_t k) const {
        return is_plain_.of[part].values[k] > 0.0F;
    }

    /// Finds new ways of all plain parts: the most even ones within a surface that fit its outlines
    /// and the ways of its other parts, as far as those are trusted. `sums` are those of the
    /// present ways, with slopes, in a picture that is smaller by `scale`.
    void settle(const MotionSums& sums, const MotionLayers& changed, const MotionLayers& trust,
                const MotionWays& ways, float scale);
    /// Moves the ways towards the new ones, by `most` px at most; none gets longer than `farthest`.
    void take(float most, float farthest, MotionWays& ways) const;

  private:
    using Way = MotionField::Way;
    /// Of a way: (xx, xy; xy, yy) times it is (right, down).
    struct Equation {
        float xx{0.0F}, xy{0.0F}, yy{0.0F}, right{0.0F}, down{0.0F};

        void hold_at(const Way& way, float weight);
        /// Its inverse, and in (right, down) the way.
        [[nodiscard]] Equation solved() const;
    };
    /// Of a plain part, or of another one beside such.
    struct Place {
        std::size_t part, k;
    };
    struct Edge {
        std::uint32_t place;
        float alike;
        float weight;  ///< of the ways of both for each other
    };

    void connect(const MotionCells& cells);
    void find_groups();
    void find_fits(const MotionSums& sums, const MotionLayers& changed);
    [[nodiscard]] Equation equation_of(const Part& part, const MotionSums& sums, const Way& now,
                                       float scale) const;
    void move_groups();
    void even_out(std::size_t number);

    MotionLayers is_plain_{};
    std::vector<Part> parts_{};
    std::vector<Place> others_{};  ///< their places have numbers from parts_.size() on
    std::vector<Edge> edges_{};
    std::size_t groups_{0};
    // For settle(): of groups, of places, of plain parts.
    std::vector<float> fits_{};
    std::vector<Equation> of_groups_{};
    std::vector<Way> ways_{};
    std::vector<Equation> own_{}, solved_{};  ///< by the part's own pixels; with those around
};

}  // namespace dibhr
