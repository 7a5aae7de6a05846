// Loops over rows of levels.
#pragma once

#include <cstddef>

namespace dibhr::fingertip {

struct LevelRange {
    float highest;
    bool touchable;  ///< every level is a number, and at most `most` from 0
};

/// Of at least one level.
[[nodiscard]] LevelRange range_of(const float* levels, std::size_t count, float most);

/// Levels that rounding has raised too far are cut to `most`.
void copy_up_to(float most, const float* from, std::size_t count, float* to);
/// Raises `to` to the others, each cut to `most`.
void raise_up_to(float most, const float* others, std::size_t count, float* to);

/// Raises all to the others minus the fall.
void raise_all(const float* others, float fall, std::size_t count, float* all);

/// std::lerp of two rows; `share` is at least 0 and below 1.
void lerp_rows(const float* a, const float* b, float share, std::size_t count, float* between);

}  // namespace dibhr::fingertip
