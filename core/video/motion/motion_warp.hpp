// Warps two depth images along the motion: what is visible at a moment between two frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface_motion.hpp"

namespace dibhr {

/// Columns [left, right) and rows [top, bottom).
struct PixelBox {
    int left{0}, top{0}, right{0}, bottom{0};
};

/// Pixels with a shorter way do not move, but blend [px].
inline constexpr float kShortestWay_px = 0.5F;

/// Warps two depth images along the motion. Keeps scratch memory.
class MotionWarp {
  public:
    /// In which images a pixel is visible.
    enum class Visibility : std::uint8_t {
        unmoved,  ///< nothing moves here: the first image blends into the second
        both,     ///< in both images
        first,    ///< covered in the second
        second,   ///< covered in the first
    };
    /// A visible pixel: its way from the first image to the second, and its level in one of them.
    struct Pixel {
        MotionField::Way way{};
        float level{0.0F};
        Visibility visibility{Visibility::unmoved};
    };

    /// Sets motion and images, which must exist until the next call.
    void begin(const MotionField& motion, const DepthImage& first, const DepthImage& second);

    /// Warps to `share` in (0, 1) of the time between the images.
    void warp_to(float share);

    /// The box in which pixels move; outside of it nothing moves.
    [[nodiscard]] const PixelBox& box() const { return box_; }
    /// Whether a pixel moves; it must be in the box.
    [[nodiscard]] bool moves(int i, int j) const { return seen_[index(i, j)].mover != kStays; }
    /// The visible pixel at a place in the box.
    [[nodiscard]] Pixel at(int i, int j) const {
        const Seen& seen = seen_[index(i, j)];
        return {movers_.way(seen.mover), seen.level, movers_.visibility[seen.mover]};
    }

  private:
    /// The visible pixel at a place: its level in an image, and its entry in the table.
    struct Seen {
        float level;
        std::uint32_t mover;
    };
    /// Entries shared by pixels that do not move: in both images, in the first or the second only.
    enum SharedEntry : std::uint32_t { kStays, kStaysInFirst, kStaysInSecond, kFirstMover };
    /// The table: the shared entries, then pixels that move, or do not move and get covered.
    struct Movers {
        std::vector<std::int32_t> x{}, y{};  ///< in the box, in the first image or the second
        std::vector<float> right{}, down{};  ///< its way
        std::vector<float> level{};
        std::vector<Visibility> visibility{};

        [[nodiscard]] MotionField::Way way(std::size_t k) const { return {right[k], down[k]}; }
        void clear();
    };

    [[nodiscard]] std::uint32_t index(int i, int j) const {
        return place(i - box_.left, j - box_.top);
    }
    /// Index of column x and row y of the box.
    [[nodiscard]] std::uint32_t place(int x, int y) const {
        return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(columns_) +
               static_cast<std::uint32_t>(x);
    }
    [[nodiscard]] bool is_inside(int i, int j) const {
        return i >= box_.left && i < box_.right && j >= box_.top && j < box_.bottom;
    }
    void find_box();
    void find_movers();
    std::uint32_t add_mover(int i, int j, MotionField::Way way, float level, Visibility visibility);
    void find_places(float share, std::size_t begin, std::size_t end);
    void warp_first(float share);
    void warp_second(float share);
    void fill_gaps();
    void refine_outlines(float share);
    void refine_outline(float share, int x, int y, const Seen& near, const Seen& far);
    [[nodiscard]] float share_nearer(float level, MotionField::Way way, float share, int x,
                                     int y) const;
    [[nodiscard]] Seen behind(const Seen& far, int x, int y) const;
    void find_covered();
    void find_uncovered();
    [[nodiscard]] MotionField::Way way_beside(int i, int j) const;

    const MotionField* motion_{nullptr};
    const DepthImage* first_{nullptr};
    const DepthImage* second_{nullptr};
    PixelBox box_{};
    int columns_{0}, rows_{0};  ///< of the box
    Movers movers_{};
    std::size_t first_movers_{0};         ///< entries from here on are in the second image only
    std::vector<std::int32_t> places_{};  ///< destination in the box; below 0: outside of it
    std::vector<Seen> still_{};           ///< the first image without its moving pixels
    std::vector<Seen> seen_{};
    struct Refined {
        std::uint32_t at;
        Seen seen;
    };
    std::vector<Refined> refined_{};
};

}  // namespace dibhr
