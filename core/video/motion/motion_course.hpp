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

/// Between two depth images, by the motion. Keeps scratch memory.
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

    /// From here on of these, which are there until the next ones.
    void begin(const MotionField& motion, const DepthImage& first, const DepthImage& second);

    /// To `share` in (0, 1) of the way.
    void go(float share);

    /// Where anything moves; outside of it all is as it was.
    [[nodiscard]] const Box& box() const { return box_; }
    /// Whether anything moves at a pixel in the box.
    [[nodiscard]] bool moves(int i, int j) const { return seen_[index(i, j)].goer != kStays; }
    /// Of a pixel in the box.
    [[nodiscard]] Pixel at(int i, int j) const {
        const Seen& seen = seen_[index(i, j)];
        return {goers_.way(seen.goer), seen.level, goers_.shows[seen.goer]};
    }

  private:
    /// What is seen at a pixel: its level in an image, and which of the goers it is.
    struct Seen {
        float level;
        std::uint32_t goer;
    };
    /// Those that stand for many: what stays, in both images, in the first or in the second alone.
    enum Standing : std::uint32_t { kStays, kStaysInFirst, kStaysInSecond, kStanding };
    /// After them, pixels that go, or are covered where they stay.
    struct Goers {
        std::vector<std::int32_t> x{}, y{};  ///< in the box of the first image, or of the second
        std::vector<float> right{}, down{};  ///< its way
        std::vector<float> level{};
        std::vector<Shows> shows{};

        [[nodiscard]] MotionField::Way way(std::size_t k) const { return {right[k], down[k]}; }
        void clear();
    };

    [[nodiscard]] std::uint32_t index(int i, int j) const {
        return place(i - box_.left, j - box_.top);
    }
    /// Of column x and row y of the box.
    [[nodiscard]] std::uint32_t place(int x, int y) const {
        return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(columns_) +
               static_cast<std::uint32_t>(x);
    }
    [[nodiscard]] bool is_inside(int i, int j) const {
        return i >= box_.left && i < box_.right && j >= box_.top && j < box_.bottom;
    }
    void find_box();
    void find_goers();
    std::uint32_t add_goer(int i, int j, MotionField::Way way, float level, Shows shows);
    void find_places(float share, std::size_t begin, std::size_t end);
    void send_first(float share);
    void send_second(float share);
    void mend();
    void settle_outlines(float share);
    void settle(float share, int x, int y, const Seen& near, const Seen& far);
    [[nodiscard]] float share_nearer(float level, MotionField::Way way, float share, int x,
                                     int y) const;
    [[nodiscard]] Seen behind(const Seen& far, int x, int y) const;
    void find_covered();
    void find_uncovered();
    [[nodiscard]] MotionField::Way way_beside(int i, int j) const;

    const MotionField* motion_{nullptr};
    const DepthImage* first_{nullptr};
    const DepthImage* second_{nullptr};
    Box box_{};
    int columns_{0}, rows_{0};  ///< of the box
    Goers goers_{};
    std::size_t first_goers_{0};          ///< those after them are in the second image alone
    std::vector<std::int32_t> places_{};  ///< where each goes to in the box; below 0: out of it
    std::vector<Seen> still_{};           ///< of the first image, without what goes
    std::vector<Seen> seen_{};
    struct Settled {
        std::uint32_t at;
        Seen seen;
    };
    std::vector<Settled> settled_{};
};

}  // namespace dibhr
