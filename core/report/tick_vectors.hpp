// A recorded tick's places and forces as vectors.
#pragma once

#include <glm/geometric.hpp>

#include "core/haptics/vec.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

[[nodiscard]] inline Vec3 vector_of(const double (&values)[3]) noexcept {
    return {values[0], values[1], values[2]};
}

/// Length of a force [N]; infinite when it was no number.
[[nodiscard]] inline double length_of(const double (&newton)[3]) noexcept {
    return glm::length(vector_of(newton));
}

/// Whether the tick touched a surface at a place that can be told.
[[nodiscard]] inline bool touches(const TickRecord& tick) noexcept {
    return tick.contact && tick.surface && is_finite(vector_of(tick.proxy));
}

}  // namespace dibhr
