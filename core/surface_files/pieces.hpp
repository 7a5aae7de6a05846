// Helpers of all forms of surface files: positions in millimetres, and buffered bytes; inside the
// room.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "core/surface_files/surface_file.hpp"

namespace dibhr {

/// The elevation of a VERTEX in a file [px]: always finite.
[[nodiscard]] inline double written_px(const DepthSurface& surface, int i, int j) noexcept {
    const double elevation = surface.elevation(i, j);
    return std::isfinite(elevation) ? elevation : 0.0;
}

/// Where a VERTEX is [mm]: x to the right, y up from the lowest row, z to the viewer.
[[nodiscard]] inline glm::vec3 place_mm(const ExportedSurface& exported, int i, int j) noexcept {
    const double pitch_mm = exported.pixel_pitch_mm;
    return {static_cast<float>(i * pitch_mm),
            static_cast<float>((exported.surface.rows() - 1 - j) * pitch_mm),
            static_cast<float>(written_px(exported.surface, i, j) * pitch_mm)};
}

/// Buffers bytes for a file; numbers are little-endian.
class Pieces {
  public:
    explicit Pieces(OutputFile& file) : file_(file) { bytes_.reserve(kPiece_bytes + kSlack_bytes); }

    void add(std::string_view text) {
        bytes_ += text;
        if (bytes_.size() >= kPiece_bytes) send();
    }
    void add(std::uint32_t number) {
        const std::array<char, 4> bytes{
            static_cast<char>(number & 0xFFU), static_cast<char>((number >> 8U) & 0xFFU),
            static_cast<char>((number >> 16U) & 0xFFU), static_cast<char>(number >> 24U)};
        add(std::string_view(bytes.data(), bytes.size()));
    }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    void add(glm::vec3 place) {
        add(place.x);
        add(place.y);
        add(place.z);
    }
    /// Writes the buffer to the file. Throws InputError.
    void send() {
        file_.write(bytes_);
        bytes_.clear();
    }

  private:
    static constexpr std::size_t kPiece_bytes = std::size_t{1} << 20;
    static constexpr std::size_t kSlack_bytes = 4096;

    OutputFile& file_;
    std::string bytes_{};
};

void write_pfm(const ExportedSurface& exported, OutputFile& file);
void write_relief_png(const ExportedSurface& exported, OutputFile& file);
void write_ply(const ExportedSurface& exported, OutputFile& file);
void write_stl(const ExportedSurface& exported, OutputFile& file);

}  // namespace dibhr
