// The double loop over friction and depth.
#include "core/experiment/sweep.hpp"

#include <cstddef>

namespace dibhr {

namespace {

SweepPoint point_of(const PathRun& path, const AlgorithmRun& run) {
    SweepPoint point;
    point.path = path.name;
    point.mu = path.mu;
    point.depth_px = path.depth_px;
    point.algorithm = run.algorithm;
    point.variation = run.variation;
    point.error = run.error.value_or(ExactError{});
    point.median_us = run.time_us.median;
    point.moves_per_update = run.moves_per_update;
    point.bounds_met = run.bounds_met;
    return point;
}

bool same_cell(const SweepPoint& a, const SweepPoint& b) {
    return a.path == b.path && a.mu == b.mu && a.depth_px == b.depth_px;
}

}  // namespace

std::vector<SweepPoint> run_sweep(const SweepRange& range, std::span<const Algorithm> algorithms,
                                  const Progress& progress) {
    const DepthClip plane = paper_plane();
    const std::size_t cells = 2 * range.mus.size() * range.depths_px.size();
    std::vector<SweepPoint> points;
    std::size_t done = 0;
    for (const auto make_path : {&linear_path, &circle_path}) {
        for (const double mu : range.mus) {
            for (const double depth_px : range.depths_px) {
                PathRun path = make_path(mu, depth_px, range.updates);
                run_algorithms(path, plane, algorithms, Timing::quick);
                for (const AlgorithmRun& run : path.runs) points.push_back(point_of(path, run));
                ++done;
                if (progress) progress(static_cast<double>(done) / static_cast<double>(cells));
            }
        }
    }
    return points;
}

std::vector<SweepPoint> not_rougher_than_dibhr(std::span<const SweepPoint> points) {
    // Two forces that both stand still are equally smooth: no difference below round-off counts.
    constexpr double kRoundOff_deg = 1e-9;
    std::vector<SweepPoint> found;
    for (const SweepPoint& ours : points) {
        if (ours.algorithm != Algorithm::dibhr) continue;
        for (const SweepPoint& other : points) {
            if (other.algorithm == Algorithm::dibhr || !same_cell(ours, other)) continue;
            const double rougher_deg = other.variation.mean_without_reversals_deg -
                                       ours.variation.mean_without_reversals_deg;
            if (rougher_deg <= kRoundOff_deg) found.push_back(other);
        }
    }
    return found;
}

}  // namespace dibhr
