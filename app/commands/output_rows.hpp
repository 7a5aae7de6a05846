// The rows of a computed stream of touches, one line an update: a contract that scripts depend on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/haptics/primitive.hpp"
#include "core/haptics/touch.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

inline constexpr std::string_view kOutputHeader =
    "t,gx,gy,gz,px,py,pz,fx,fy,fz,cx,cy,cz,contact,primitive,i,j,moves,ns\n";

/// One update. Grid space [px], forces [N] in the axes of grid space.
struct OutputRow {
    double t_s{0.0};
    Vec3 goal{0.0};
    Vec3 proxy{0.0};
    Vec3 spring_newton{0.0};  ///< before the safety stage
    Vec3 sent_newton{0.0};    ///< after it
    bool contact{false};
    PrimitiveKind primitive{PrimitiveKind::none};
    int i{-1};
    int j{-1};
    int moves{0};
    std::int64_t update_ns{0};
};

[[nodiscard]] OutputRow row_of(double t_s, const Touch& touch, std::int64_t update_ns);

/// Appends a real with 17 significant digits, so that it reads back to the same bits.
void append_real(std::string& text, double value);

/// Appends one line.
void append_row(std::string& text, const OutputRow& row);

}  // namespace dibhr
