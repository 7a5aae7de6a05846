// What is to be seen at each pixel at a moment between two frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface_motion.hpp"

namespace dibhr {

/// Columns [left, right) and rows [top, bottom).
struct Box {
    int left{0}, top{0}, right{0}, bottom{0};
};

/// A shorter way is not worth going: what goes it blends [px].
inline constexpr float kShortestWay_px = 0.5F;

/// Two depth images and the motion between them, which outlive it.
class Course {
  public:
    enum class Shows : std::uint8_t {
        as_it_was,  ///< nothing moves here: the one image blends into the other
        both,       ///< what is in both images
        first,      ///< what is covered in the second
        second,     ///< what was covered in the first
    };
    /// Which way what is here goes from the first image to the second, and its level in one.
    struct Pixel {
        MotionField::Way way{};
        float level{0.0F};
        Shows shows{Shows::as_it_was};
    };

    Course(const MotionField& motion, const DepthImage& first, const DepthImage& second);

    /// To `share` in (0, 1) of the way.
    void go(float share);

    /// Where anything moves; outside of it all is as it was.
    [[nodiscard]] const Box& box() const { return box_; }
    /// Of a pixel in the box.
    [[nodiscard]] const Pixel& at(int i, int j) const { return pixels_[index(i, j)]; }

  private:
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j - box_.top) *
                   static_cast<std::size_t>(box_.right - box_.left) +
               static_cast<std::size_t>(i - box_.left);
    }
    [[nodiscard]] bool is_inside(int i, int j) const {
        return i >= box_.left && i < box_.right && j >= box_.top && j < box_.bottom;
    }
    [[nodiscard]] MotionField::Way way_of(int i, int j) const;
    void find_box();
    void send_first(float share);
    void send_second(float share);
    void mend();
    void find_covered();
    void find_uncovered();
    [[nodiscard]] MotionField::Way way_beside(int i, int j) const;

    struct Uncovered {
        int i, j;
        MotionField::Way way;
    };

    const MotionField& motion_;
    const DepthImage& first_;
    const DepthImage& second_;
    Box box_{};
    std::vector<Pixel> pixels_{};
    std::vector<float> nearest_{};         ///< of what shows at each pixel
    std::vector<std::uint8_t> covered_{};  ///< of each pixel of the first image: not in the second
    std::vector<Uncovered> uncovered_{};   ///< pixels of the second image that are not in the first
};

}  // namespace dibhr
