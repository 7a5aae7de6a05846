// How what is seen moves in the picture plane while one depth image becomes the next: which way a
// material point that is touched goes.
#pragma once

#include <cstddef>
#include <vector>

namespace dibhr {

/// Where each pixel of a depth image has gone when the next one is there. Plain data of the depth
/// image's size, row-major.
struct MotionField {
    /// To the right and down [px]; both 0: it stays, or nothing is known of it.
    struct Way {
        float right{0.0F};
        float down{0.0F};

        bool operator==(const Way&) const = default;
    };

    int columns{0};
    int rows{0};
    std::vector<Way> ways{};

    [[nodiscard]] bool empty() const noexcept { return ways.empty(); }
    [[nodiscard]] const Way& at(int i, int j) const {
        return ways[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(i)];
    }
};

}  // namespace dibhr
