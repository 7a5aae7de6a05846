// Depth and colour moved along the motion.
#include "core/video/motion/in_betweens.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/video/cleaning/fingertip.hpp"
#include "core/video/motion/motion_course.hpp"
#include "core/video/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kOfOneSurface = 12.0F / 255.0F;  // of the highest level

DIBHR_VECTOR_CLONES void blend_levels(const float* __restrict from, const float* __restrict to,
                                      float share, float* __restrict between, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) between[k] = from[k] + share * (to[k] - from[k]);
}

/// `share` in 256ths.
DIBHR_VECTOR_CLONES void blend_bytes(const std::uint8_t* __restrict from,
                                     const std::uint8_t* __restrict to, int share,
                                     std::uint8_t* __restrict between, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        between[k] =
            static_cast<std::uint8_t>((from[k] * (256 - share) + to[k] * share + 128) >> 8);
}

/// Four pixels around a place and how much each counts.
struct Taps {
    std::array<std::size_t, 4> at{};
    std::array<float, 4> share{};
};

Taps taps_around(int columns, int rows, float x, float y) {
    x = std::clamp(x, 0.0F, static_cast<float>(columns - 1));
    y = std::clamp(y, 0.0F, static_cast<float>(rows - 1));
    const int i = std::min(static_cast<int>(x), columns - 2);
    const int j = std::min(static_cast<int>(y), rows - 2);
    const float right = x - static_cast<float>(i);
    const float down = y - static_cast<float>(j);
    const auto first = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(i);
    const auto below = first + static_cast<std::size_t>(columns);
    return {{first, first + 1, below, below + 1},
            {(1.0F - right) * (1.0F - down), right * (1.0F - down), (1.0F - right) * down,
             right * down}};
}

/// Only those of the surface that is nearest in depth to `level`.
void keep_surface(const DepthImage& depth, float level, Taps& taps) {
    float nearest = depth.levels[taps.at[0]];
    for (const std::size_t at : taps.at)
        if (std::fabs(depth.levels[at] - level) < std::fabs(nearest - level))
            nearest = depth.levels[at];
    const float alike = kOfOneSurface * static_cast<float>(depth.highest_level);
    float sum = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) {
        if (std::fabs(depth.levels[taps.at[k]] - nearest) > alike) taps.share[k] = 0.0F;
        sum += taps.share[k];
    }
    if (sum > 1e-3F) {
        for (float& share : taps.share) share /= sum;
        return;
    }
    for (std::size_t k = 0; k < 4; ++k)  // the place lies beyond it
        taps.share[k] = depth.levels[taps.at[k]] == nearest ? 1.0F : 0.0F;
    const float count = taps.share[0] + taps.share[1] + taps.share[2] + taps.share[3];
    for (float& share : taps.share) share /= count;
}

float level_at(const DepthImage& image, const Taps& taps) {
    float level = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) level += taps.share[k] * image.levels[taps.at[k]];
    return level;
}

float byte_at(const std::vector<std::uint8_t>& bytes, const Taps& taps, std::size_t stride,
              std::size_t offset) {
    float value = 0.0F;
    for (std::size_t k = 0; k < 4; ++k)
        value += taps.share[k] * static_cast<float>(bytes[taps.at[k] * stride + offset]);
    return value;
}

bool has_colour(const Frame& frame) {
    return frame.colour && !frame.colour->rgb.empty();
}

/// Makes one frame after the other.
class Mover {
  public:
    Mover(const Frame& from, const Frame& to)
        : from_(from), to_(to), a_(*from.drawn()), b_(*to.drawn()), course_(*from.motion, a_, b_) {}

    Frame at(float share) {
        course_.go(share);
        auto depth = std::make_shared<DepthImage>(a_);
        blend_levels(a_.levels.data(), b_.levels.data(), share, depth->levels.data(),
                     a_.levels.size());
        auto unseen = blended_unseen(share);
        auto colour = blended_colour(share);
        move(share, *depth, unseen.get(), colour.get());
        Frame frame = from_;
        frame.motion.reset();
        frame.between.reset();
        frame.unseen = std::move(unseen);
        frame.colour = std::move(colour);
        lay(std::move(depth), frame);
        return frame;
    }

  private:
    /// What is felt of the drawn image.
    void lay(std::shared_ptr<DepthImage> depth, Frame& frame) {
        if (!from_.beneath) {
            frame.depth = std::move(depth);
            return;
        }
        frame.depth =
            std::make_shared<const DepthImage>(finger_.dilated(*depth, from_.cleaning.finger));
        frame.beneath = std::move(depth);
    }

    [[nodiscard]] std::shared_ptr<std::vector<std::uint8_t>> blended_unseen(float share) const {
        const auto& nearer = share < 0.5F ? from_.unseen : to_.unseen;
        if (nearer) return std::make_shared<std::vector<std::uint8_t>>(*nearer);
        if (!from_.unseen && !to_.unseen) return nullptr;
        return std::make_shared<std::vector<std::uint8_t>>(a_.levels.size());
    }

    [[nodiscard]] std::shared_ptr<ColourImage> blended_colour(float share) const {
        if (!has_colour(from_)) return nullptr;
        auto colour = std::make_shared<ColourImage>(*from_.colour);
        if (!has_colour(to_) || to_.colour->rgb.size() != colour->rgb.size()) return colour;
        blend_bytes(from_.colour->rgb.data(), to_.colour->rgb.data(),
                    static_cast<int>(std::lround(share * 256.0F)), colour->rgb.data(),
                    colour->rgb.size());
        return colour;
    }

    void move(float share, DepthImage& depth, std::vector<std::uint8_t>* unseen,
              ColourImage* colour) const {
        const bool alike = colour != nullptr && colour->columns == a_.columns &&
                           colour->rows == a_.rows && same_colour_size();
        const Box& box = course_.box();
        for (int j = box.top; j < box.bottom; ++j)
            for (int i = box.left; i < box.right; ++i) {
                const Course::Pixel& pixel = course_.at(i, j);
                if (pixel.shows == Course::Shows::as_it_was) continue;
                const float first = pixel.shows == Course::Shows::second ? 0.0F : 1.0F - share;
                const float second = pixel.shows == Course::Shows::first ? 0.0F : share;
                const float a = first / (first + second);
                const Taps before = taps(a_, pixel, i, j, -share);
                const Taps after = taps(b_, pixel, i, j, 1.0F - share);
                const std::size_t k = depth.index(i, j);
                depth.levels[k] = a * level_at(a_, before) + (1.0F - a) * level_at(b_, after);
                if (unseen != nullptr) (*unseen)[k] = unseen_at(a, before, after);
                if (alike) mix(a, before, after, colour->rgb.data() + 3 * k);
            }
        if (colour != nullptr && !alike && same_colour_size()) move_colour(share, *colour);
    }

    [[nodiscard]] bool same_colour_size() const {
        return has_colour(to_) && to_.colour->columns == from_.colour->columns &&
               to_.colour->rows == from_.colour->rows;
    }

    static Taps taps(const DepthImage& image, const Course::Pixel& pixel, int i, int j,
                     float times) {
        Taps around =
            taps_around(image.columns, image.rows, static_cast<float>(i) + times * pixel.way.right,
                        static_cast<float>(j) + times * pixel.way.down);
        keep_surface(image, pixel.level, around);
        return around;
    }

    [[nodiscard]] std::uint8_t unseen_at(float a, const Taps& before, const Taps& after) const {
        const float first = from_.unseen ? byte_at(*from_.unseen, before, 1, 0) : 0.0F;
        const float second = to_.unseen ? byte_at(*to_.unseen, after, 1, 0) : 0.0F;
        return a * first + (1.0F - a) * second > 0.5F ? 1 : 0;
    }

    void mix(float a, const Taps& before, const Taps& after, std::uint8_t* rgb) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const float value = a * byte_at(from_.colour->rgb, before, 3, k) +
                                (1.0F - a) * byte_at(to_.colour->rgb, after, 3, k);
            rgb[k] = static_cast<std::uint8_t>(std::lround(value));
        }
    }

    /// Of another size than the depth.
    void move_colour(float share, ColourImage& colour) const {
        const float right = static_cast<float>(colour.columns) / static_cast<float>(a_.columns);
        const float down = static_cast<float>(colour.rows) / static_cast<float>(a_.rows);
        const auto under = [](int at, float scale, int count) {
            return std::min(static_cast<int>((static_cast<float>(at) + 0.5F) / scale), count - 1);
        };
        const Box& box = course_.box();
        for (int y = 0; y < colour.rows; ++y) {
            const int j = under(y, down, a_.rows);
            if (j < box.top || j >= box.bottom) continue;
            for (int x = 0; x < colour.columns; ++x) {
                const int i = under(x, right, a_.columns);
                if (i < box.left || i >= box.right) continue;
                const Course::Pixel& pixel = course_.at(i, j);
                if (pixel.shows == Course::Shows::as_it_was) continue;
                const float first = pixel.shows == Course::Shows::second ? 0.0F : 1.0F - share;
                const float second = pixel.shows == Course::Shows::first ? 0.0F : share;
                const auto around = [&](float times) {
                    return taps_around(colour.columns, colour.rows,
                                       static_cast<float>(x) + times * right * pixel.way.right,
                                       static_cast<float>(y) + times * down * pixel.way.down);
                };
                mix(first / (first + second), around(-share), around(1.0F - share),
                    colour.rgb.data() + 3 * (static_cast<std::size_t>(y) *
                                                 static_cast<std::size_t>(colour.columns) +
                                             static_cast<std::size_t>(x)));
            }
        }
    }

    const Frame& from_;
    const Frame& to_;
    const DepthImage& a_;
    const DepthImage& b_;
    Course course_;
    FingertipDilation finger_{};
};

/// Into how many parts the time between the two frames falls.
int parts_of(const MotionField& motion) {
    float farthest2 = 0.0F;
    std::size_t moving = 0;
    for (const MotionField::Way& way : motion.ways) {
        const float way2 = way.right * way.right + way.down * way.down;
        farthest2 = std::max(farthest2, way2);
        moving += way2 < kShortestWay_px * kShortestWay_px ? 0 : 1;
    }
    const auto wanted =
        static_cast<int>(std::ceil(std::sqrt(static_cast<double>(farthest2)) / kBetween_px));
    const auto affordable = static_cast<int>(kMostPixelsBetween / std::max<std::size_t>(moving, 1));
    return std::min({wanted, kMostParts, std::max(affordable, 2)});
}

}  // namespace

std::shared_ptr<const std::vector<Frame>> in_betweens_of(const Frame& from, const Frame& to) {
    if (!from.motion) return nullptr;
    const int parts = parts_of(*from.motion);
    if (parts < 2) return nullptr;
    Mover mover(from, to);
    auto between = std::make_shared<std::vector<Frame>>();
    between->reserve(static_cast<std::size_t>(parts - 1));
    for (int k = 1; k < parts; ++k)
        between->push_back(mover.at(static_cast<float>(k) / static_cast<float>(parts)));
    return between;
}

}  // namespace dibhr
