// Moves depth and colour along the motion.
#include "core/video/motion/in_betweens.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/video/cleaning/fingertip.hpp"
#include "core/video/frames/object_pool.hpp"
#include "core/video/frames/vector_clones.hpp"
#include "core/video/motion/motion_warp.hpp"

namespace dibhr {

namespace {

constexpr float kOfOneSurface = 12.0F / 255.0F;  // of the highest level
constexpr float kHalf = 0.5F;                    // added to round before a fraction is cut off

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

/// Pixels that are computed together.
constexpr std::size_t kAtOnce = 64;
using Floats = std::array<float, kAtOnce>;
using Places = std::array<std::int32_t, kAtOnce>;

/// Moving pixels of one row of an in-between.
struct Movers {
    std::size_t count{0};
    Places column{};
    Floats right{}, down{};  ///< their ways
    Floats level{};          ///< in one of the frames
    Floats first{};          ///< weight of the first frame, in [0, 1]
};

/// Where the pixels are in one of the frames: four pixels around each place, of which only those of
/// one surface count.
struct Taps {
    Places at{};  ///< the upper left one; the others are right of it and below
    std::array<Floats, 4> share{};
    Floats value{};  ///< the depth there
};

DIBHR_VECTOR_CLONES void find_taps(const DepthImage& image, const Movers& movers, int row,
                                   float times, Taps& __restrict taps) {
    const float* __restrict const levels = image.levels.data();
    const int columns = image.columns;
    const auto last_column = static_cast<float>(image.columns - 1);
    const auto last_row = static_cast<float>(image.rows - 1);
    const int most_right = image.columns - 2;
    const int lowest = image.rows - 2;
    const float alike = kOfOneSurface * static_cast<float>(image.highest_level);
    for (std::size_t k = 0; k < kAtOnce; ++k) {
        float x = static_cast<float>(movers.column[k]) + times * movers.right[k];
        float y = static_cast<float>(row) + times * movers.down[k];
        x = std::min(std::max(x, 0.0F), last_column);
        y = std::min(std::max(y, 0.0F), last_row);
        const int i = std::min(static_cast<int>(x), most_right);
        const int j = std::min(static_cast<int>(y), lowest);
        const float u = x - static_cast<float>(i);
        const float v = y - static_cast<float>(j);
        const std::int32_t at = j * columns + i;
        taps.at[k] = at;
        const float a = levels[at];
        const float b = levels[at + 1];
        const float c = levels[at + columns];
        const float d = levels[at + columns + 1];
        // The surface that is nearest in depth to the moving pixel.
        const float level = movers.level[k];
        const float from_a = std::fabs(a - level);
        const float from_b = std::fabs(b - level);
        const float from_c = std::fabs(c - level);
        const float from_d = std::fabs(d - level);
        float nearest = a;
        float least = from_a;
        nearest = from_b < least ? b : nearest;
        least = std::min(from_b, least);
        nearest = from_c < least ? c : nearest;
        least = std::min(from_c, least);
        nearest = from_d < least ? d : nearest;
        const float of_a = std::fabs(a - nearest) > alike ? 0.0F : 1.0F;
        const float of_b = std::fabs(b - nearest) > alike ? 0.0F : 1.0F;
        const float of_c = std::fabs(c - nearest) > alike ? 0.0F : 1.0F;
        const float of_d = std::fabs(d - nearest) > alike ? 0.0F : 1.0F;
        // A small share also where the place lies beside that surface.
        constexpr float kSome = 1e-4F;
        const float share_a = of_a * ((1.0F - u) * (1.0F - v) + kSome);
        const float share_b = of_b * (u * (1.0F - v) + kSome);
        const float share_c = of_c * ((1.0F - u) * v + kSome);
        const float share_d = of_d * (u * v + kSome);
        const float inverse = 1.0F / ((share_a + share_b) + (share_c + share_d));
        taps.share[0][k] = inverse * share_a;
        taps.share[1][k] = inverse * share_b;
        taps.share[2][k] = inverse * share_c;
        taps.share[3][k] = inverse * share_d;
        taps.value[k] = inverse * ((share_a * a + share_b * b) + (share_c * c + share_d * d));
    }
}

/// The colours of four pixels around each place, as 32-bit words of which three bytes count.
struct Colours {
    std::array<std::array<std::uint32_t, kAtOnce>, 4> word{};
};
/// First bit of the three: right pixels are read a byte early, so not beyond the picture's end.
constexpr std::array<int, 4> kFirstBit{0, 8, 0, 8};

void read_colours(const ColourImage& image, const Taps& taps, std::size_t count, Colours& colours) {
    const std::uint8_t* const rgb = image.rgb.data();
    const std::ptrdiff_t below = 3 * std::ptrdiff_t{image.columns};
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint8_t* const here = rgb + 3 * std::ptrdiff_t{taps.at[k]};
        std::memcpy(&colours.word[0][k], here, 4);
        std::memcpy(&colours.word[1][k], here + 2, 4);
        std::memcpy(&colours.word[2][k], here + below, 4);
        std::memcpy(&colours.word[3][k], here + below + 2, 4);
    }
}

struct Coloured {
    const Colours& colours;
    const Taps& taps;
};

/// Mixes one channel of all pixels.
DIBHR_VECTOR_CLONES void mix_channel(const Coloured& before, const Coloured& after,
                                     const Floats& first, int channel,
                                     std::int32_t* __restrict mixed) {
    for (std::size_t k = 0; k < kAtOnce; ++k) {
        const auto value = [&](const Coloured& side) {
            float sum = 0.0F;
            for (std::size_t tap = 0; tap < 4; ++tap) {
                const auto byte = static_cast<std::int32_t>(
                    side.colours.word[tap][k] >> (kFirstBit[tap] + 8 * channel) & 0xFFU);
                sum += side.taps.share[tap][k] * static_cast<float>(byte);
            }
            return sum;
        };
        const float of_before = value(before);
        const float of_after = value(after);
        mixed[k] = static_cast<std::int32_t>(of_after + first[k] * (of_before - of_after) + kHalf);
    }
}

/// Longest way, squared, and count of pixels that move by kShortestWay_px or more, in kLanes parts.
struct Moving {
    static constexpr std::size_t kLanes = 16;
    std::array<float, kLanes> farthest2{};
    std::array<std::int32_t, kLanes> count{};
};

DIBHR_VECTOR_CLONES void measure(const MotionField::Way* __restrict ways, std::size_t count,
                                 Moving& __restrict moving) {
    for (std::size_t k = 0; k + Moving::kLanes <= count; k += Moving::kLanes)
        for (std::size_t lane = 0; lane < Moving::kLanes; ++lane) {
            const MotionField::Way way = ways[k + lane];
            const float way2 = way.right * way.right + way.down * way.down;
            moving.farthest2[lane] = std::max(moving.farthest2[lane], way2);
            moving.count[lane] += way2 < kShortestWay_px * kShortestWay_px ? 0 : 1;
        }
}

/// Number of parts of the time between the two frames. A few pixels at the end are not measured.
int parts_of(const MotionField& motion) {
    Moving moving;
    measure(motion.ways.data(), motion.ways.size(), moving);
    const float farthest2 = *std::max_element(moving.farthest2.begin(), moving.farthest2.end());
    const int count = std::accumulate(moving.count.begin(), moving.count.end(), 0);
    const double farthest_px = std::sqrt(static_cast<double>(farthest2));
    if (farthest_px < kLeastMotion_px) return 1;
    // Even, so that one is half way, where two blended frames are farthest from the truth.
    const int wanted = 2 * static_cast<int>(std::ceil(farthest_px / (2.0 * kInBetweenStep_px)));
    const int affordable = kMostPixelsBetween / std::max(count, 1);
    return std::min({wanted, kMostParts, std::max(affordable, 2)});
}

}  // namespace

/// Makes the in-betweens of two frames one after the other.
class InBetweenMaker::Warper {
  public:
    void begin(const Frame& from, const Frame& to) {
        from_ = &from;
        to_ = &to;
        const bool goes_on = second_of_ && from.colour_object() == second_of_;
        first_colour_ = goes_on ? std::move(second_colour_) : from.rgb();
        second_colour_ = to.rgb();
        second_of_ = to.colour_object();
        warp_.begin(*from.motion, first(), second());
    }

    Frame at(float share) {
        warp_.warp_to(share);
        auto depth = depths_.take();
        copy_form(first(), *depth);
        blend_levels(first().levels.data(), second().levels.data(), share, depth->levels.data(),
                     depth->levels.size());
        auto unseen = blended_unseen(share);
        auto colour = blended_colour(share);
        move(share, *depth, unseen.get(), colour.get());
        Frame frame = *from_;
        frame.motion.reset();
        frame.in_betweens.reset();
        frame.unseen = std::move(unseen);
        frame.colour = std::move(colour);
        frame.video.reset();
        lay(std::move(depth), frame);
        return frame;
    }

  private:
    [[nodiscard]] const DepthImage& first() const { return *from_->drawn(); }
    [[nodiscard]] const DepthImage& second() const { return *to_->drawn(); }

    /// Copies size and scale, not the levels.
    static void copy_form(const DepthImage& from, DepthImage& to) {
        to.columns = from.columns;
        to.rows = from.rows;
        to.highest_level = from.highest_level;
        to.levels.resize(from.levels.size());
    }

    /// Sets the depth that is felt, made of the drawn image.
    void lay(std::shared_ptr<DepthImage> depth, Frame& frame) {
        if (!from_->undilated) {
            frame.depth = std::move(depth);
            return;
        }
        frame.depth =
            std::make_shared<const DepthImage>(finger_.dilated(*depth, from_->cleaning.finger));
        frame.undilated = std::move(depth);
    }

    [[nodiscard]] std::shared_ptr<std::vector<std::uint8_t>> blended_unseen(float share) const {
        const auto& nearer = share < 0.5F ? from_->unseen : to_->unseen;
        if (nearer) return std::make_shared<std::vector<std::uint8_t>>(*nearer);
        if (!from_->unseen && !to_->unseen) return nullptr;
        return std::make_shared<std::vector<std::uint8_t>>(first().levels.size());
    }

    [[nodiscard]] std::shared_ptr<ColourImage> blended_colour(float share) {
        if (!from_->has_colour()) return nullptr;
        auto colour = colours_.take();
        colour->columns = first_colour_->columns;
        colour->rows = first_colour_->rows;
        colour->rgb.resize(first_colour_->rgb.size());
        if (!to_->has_colour() || second_colour_->rgb.size() != colour->rgb.size()) {
            colour->rgb = first_colour_->rgb;
            return colour;
        }
        blend_bytes(first_colour_->rgb.data(), second_colour_->rgb.data(),
                    static_cast<int>(std::lround(share * 256.0F)), colour->rgb.data(),
                    colour->rgb.size());
        return colour;
    }

    void move(float share, DepthImage& depth, std::vector<std::uint8_t>* unseen,
              ColourImage* colour) {
        const bool alike = colour != nullptr && colour->columns == first().columns &&
                           colour->rows == first().rows && same_colour_size();
        const PixelBox& box = warp_.box();
        for (int j = box.top; j < box.bottom; ++j)
            for (int i = box.left; i < box.right;) {
                i = take_movers(share, i, j);
                if (movers_.count == 0) continue;
                find_taps(first(), movers_, j, -share, before_);
                find_taps(second(), movers_, j, 1.0F - share, after_);
                for (std::size_t k = 0; k < movers_.count; ++k)
                    depth.levels[depth.index(movers_.column[k], j)] =
                        after_.value[k] + movers_.first[k] * (before_.value[k] - after_.value[k]);
                if (unseen != nullptr) mix_unseen(j, *unseen);
                if (alike) mix_colours(colour->rgb.data() + 3 * depth.index(0, j));
            }
        if (colour != nullptr && !alike && same_colour_size()) move_colour(share, *colour);
    }

    /// Takes up to kAtOnce moving pixels of a row from column i on. Returns where to continue.
    int take_movers(float share, int i, int j) {
        std::size_t count = 0;
        for (; i < warp_.box().right && count < kAtOnce; ++i) {
            if (!warp_.moves(i, j)) continue;
            const MotionWarp::Pixel pixel = warp_.at(i, j);
            movers_.column[count] = i;
            movers_.right[count] = pixel.way.right;
            movers_.down[count] = pixel.way.down;
            movers_.level[count] = pixel.level;
            movers_.first[count] = part_of_first(pixel, share);
            ++count;
        }
        movers_.count = count;
        return i;
    }

    static float part_of_first(const MotionWarp::Pixel& pixel, float share) {
        if (pixel.visibility == MotionWarp::Visibility::first) return 1.0F;
        return pixel.visibility == MotionWarp::Visibility::second ? 0.0F : 1.0F - share;
    }

    [[nodiscard]] bool same_colour_size() const {
        return to_->has_colour() && second_colour_->columns == first_colour_->columns &&
               second_colour_->rows == first_colour_->rows;
    }

    void mix_colours(std::uint8_t* row) {
        read_colours(*first_colour_, before_, movers_.count, colours_before_);
        read_colours(*second_colour_, after_, movers_.count, colours_after_);
        for (int channel = 0; channel < 3; ++channel) {
            mix_channel({colours_before_, before_}, {colours_after_, after_}, movers_.first,
                        channel, mixed_.data());
            for (std::size_t k = 0; k < movers_.count; ++k)
                row[3 * movers_.column[k] + channel] = static_cast<std::uint8_t>(mixed_[k]);
        }
    }

    void mix_unseen(int j, std::vector<std::uint8_t>& unseen) const {
        const auto at = [this](const auto& bytes, const Taps& taps, std::size_t k) {
            if (!bytes) return 0.0F;
            const std::uint8_t* const here = bytes->data() + taps.at[k];
            const std::uint8_t* const below = here + first().columns;
            return taps.share[0][k] * here[0] + taps.share[1][k] * here[1] +
                   taps.share[2][k] * below[0] + taps.share[3][k] * below[1];
        };
        for (std::size_t k = 0; k < movers_.count; ++k)
            unseen[first().index(movers_.column[k], j)] =
                movers_.first[k] * at(from_->unseen, before_, k) +
                            (1.0F - movers_.first[k]) * at(to_->unseen, after_, k) >
                        0.5F
                    ? 1
                    : 0;
    }

    static std::array<float, 3> colour_at(const ColourImage& image, float x, float y) {
        x = std::clamp(x, 0.0F, static_cast<float>(image.columns - 1));
        y = std::clamp(y, 0.0F, static_cast<float>(image.rows - 1));
        const int i = std::min(static_cast<int>(x), image.columns - 2);
        const int j = std::min(static_cast<int>(y), image.rows - 2);
        const float u = x - static_cast<float>(i);
        const float v = y - static_cast<float>(j);
        const std::uint8_t* const first =
            image.rgb.data() + 3 * (std::ptrdiff_t{j} * image.columns + i);
        const std::uint8_t* const below = first + 3 * std::ptrdiff_t{image.columns};
        std::array<float, 3> rgb{};
        for (std::size_t k = 0; k < 3; ++k)
            rgb[k] = (1.0F - v) * ((1.0F - u) * first[k] + u * first[k + 3]) +
                     v * ((1.0F - u) * below[k] + u * below[k + 3]);
        return rgb;
    }

    /// For colour of another size than the depth.
    void move_colour(float share, ColourImage& colour) const {
        const float right =
            static_cast<float>(colour.columns) / static_cast<float>(first().columns);
        const float down = static_cast<float>(colour.rows) / static_cast<float>(first().rows);
        const auto under = [](int at, float scale, int count) {
            return std::min(static_cast<int>((static_cast<float>(at) + 0.5F) / scale), count - 1);
        };
        const PixelBox& box = warp_.box();
        for (int y = 0; y < colour.rows; ++y) {
            const int j = under(y, down, first().rows);
            if (j < box.top || j >= box.bottom) continue;
            for (int x = 0; x < colour.columns; ++x) {
                const int i = under(x, right, first().columns);
                if (i < box.left || i >= box.right) continue;
                if (!warp_.moves(i, j)) continue;
                const MotionWarp::Pixel pixel = warp_.at(i, j);
                const float of_first = part_of_first(pixel, share);
                const auto at = [&](const ColourImage& image, float times) {
                    return colour_at(image, static_cast<float>(x) + times * right * pixel.way.right,
                                     static_cast<float>(y) + times * down * pixel.way.down);
                };
                const auto before = at(*first_colour_, -share);
                const auto after = at(*second_colour_, 1.0F - share);
                std::uint8_t* const rgb =
                    colour.rgb.data() + 3 * (std::ptrdiff_t{y} * colour.columns + x);
                for (std::size_t k = 0; k < 3; ++k)
                    rgb[k] = static_cast<std::uint8_t>(of_first * before[k] +
                                                       (1.0F - of_first) * after[k] + kHalf);
            }
        }
    }

    const Frame* from_{nullptr};
    const Frame* to_{nullptr};
    std::shared_ptr<const ColourImage> first_colour_{}, second_colour_{};
    std::shared_ptr<const void> second_of_{};  ///< what that was converted from
    MotionWarp warp_{};
    ObjectPool<DepthImage> depths_{};
    ObjectPool<ColourImage> colours_{};
    Movers movers_{};
    Taps before_{}, after_{};
    Colours colours_before_{}, colours_after_{};
    Places mixed_{};
    FingertipDilation finger_{};
};

InBetweenMaker::InBetweenMaker() : warper_(std::make_unique<Warper>()) {}
InBetweenMaker::~InBetweenMaker() = default;
InBetweenMaker::InBetweenMaker(InBetweenMaker&&) noexcept = default;
InBetweenMaker& InBetweenMaker::operator=(InBetweenMaker&&) noexcept = default;

std::shared_ptr<const std::vector<Frame>> InBetweenMaker::make(const Frame& from, const Frame& to) {
    if (!from.motion) return nullptr;
    const int parts = parts_of(*from.motion);
    if (parts < 2) return nullptr;
    warper_->begin(from, to);
    auto between = std::make_shared<std::vector<Frame>>();
    between->reserve(static_cast<std::size_t>(parts - 1));
    for (int k = 1; k < parts; ++k)
        between->push_back(warper_->at(static_cast<float>(k) / static_cast<float>(parts)));
    return between;
}

}  // namespace dibhr
