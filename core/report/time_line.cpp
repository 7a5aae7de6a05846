// What happened when, in pieces of the session.
#include "core/report/time_line.hpp"

#include <algorithm>

namespace dibhr {

namespace {

constexpr double kMostPieces = 4000.0;  // about four a pixel of the plots
constexpr double kShortestPiece_s = 0.001;

}  // namespace

TimeLine::TimeLine(double begin_s, double end_s) : begin_s_(begin_s) {
    const double duration_s = std::isfinite(end_s - begin_s) ? std::max(end_s - begin_s, 0.0) : 0.0;
    const double pieces = std::clamp(std::ceil(duration_s / kShortestPiece_s), 1.0, kMostPieces);
    piece_s_ = std::max(duration_s / pieces, kShortestPiece_s);
    pieces_.resize(static_cast<std::size_t>(pieces));
}

TimePiece& TimeLine::piece_at(double t_s) noexcept {
    const double number = std::floor((t_s - begin_s_) / piece_s_);
    const double last = static_cast<double>(pieces_.size() - 1);
    // A time that is no number belongs to the first piece.
    return pieces_[static_cast<std::size_t>(number > 0.0 ? std::min(number, last) : 0.0)];
}

}  // namespace dibhr
