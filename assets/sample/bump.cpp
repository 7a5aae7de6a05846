// Bump maps that tile without a seam: every wave and every cell repeats after kBumpSide pixels.
#include "assets/sample/bump.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/sample/sdf.hpp"

namespace dibhr::sample {
namespace {

/// Stretches to the whole of 0..255.
std::vector<std::uint8_t> stretched(const std::vector<float>& height) {
    const auto ends = std::minmax_element(height.begin(), height.end());
    const float low = *ends.first;
    const float scale = 255.0F / (*ends.second - low);
    std::vector<std::uint8_t> bytes(height.size());
    std::transform(height.begin(), height.end(), bytes.begin(), [&](float x) {
        return static_cast<std::uint8_t>(std::lround((x - low) * scale));
    });
    return bytes;
}

std::vector<std::uint8_t> filled(float (*height_at)(int column, int row)) {
    std::vector<float> height;
    for (int row = 0; row < kBumpSide; ++row)
        for (int column = 0; column < kBumpSide; ++column) height.push_back(height_at(column, row));
    return stretched(height);
}

int wrapped(int cell, int cells) noexcept {
    return (cell % cells + cells) % cells;
}

float linen_at(int column, int row) {
    constexpr int kThread = 8;  // pixels from thread to thread
    constexpr int kThreads = kBumpSide / kThread;
    const int warp = column / kThread, weft = row / kThread;
    const auto across = [](int pixel) {
        return (static_cast<float>(pixel % kThread) + 0.5F) / kThread - 0.5F;
    };
    // Two tabby phases: where one thread lies over, the other dives under.
    const float over = (warp + weft) % 2 == 0 ? 1.0F : -1.0F;
    const float warp_height =
        std::cos(std::numbers::pi_v<float> * across(column)) * (0.80F + 0.30F * lattice(warp, 77)) +
        0.35F * over * std::cos(std::numbers::pi_v<float> * across(row));
    const float weft_height = std::cos(std::numbers::pi_v<float> * across(row)) *
                                  (0.80F + 0.30F * lattice(weft % kThreads, 78)) -
                              0.35F * over * std::cos(std::numbers::pi_v<float> * across(column));
    return smooth_max(warp_height, weft_height, 0.15F);
}

/// Bumps of about `size` pixels, one in each cell of a repeating lattice, at this pixel.
float bumps_at(int column, int row, int size) {
    const int cells = kBumpSide / size;
    const int i = column / size, j = row / size;
    float height = 0.0F;
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const int u = wrapped(i + di, cells), v = wrapped(j + dj, cells);
            const float x = static_cast<float>((i + di) * size) +
                            lattice(u + size, v) * static_cast<float>(size);
            const float y = static_cast<float>((j + dj) * size) +
                            lattice(u, v + size) * static_cast<float>(size);
            const float away =
                glm::length(Vec2{static_cast<float>(column) - x, static_cast<float>(row) - y});
            height += lattice(u + 7, v + 3) * hill(away, 0.42F * static_cast<float>(size));
        }
    return height;
}

float grain_at(int column, int row) {
    return bumps_at(column, row, 4) + 0.9F * bumps_at(column, row, 8) +
           0.5F * bumps_at(column, row, 16);
}

}  // namespace

std::vector<std::uint8_t> linen() {
    return filled(linen_at);
}

std::vector<std::uint8_t> grain() {
    return filled(grain_at);
}

}  // namespace dibhr::sample
