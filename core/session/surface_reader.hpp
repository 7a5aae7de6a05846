// The surface that a session holds: what ticks felt, without the video.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/session_reader.hpp"
#include "core/session/tile_code.hpp"

namespace dibhr {

/// A surface as it is stored; where no tile is stored, levels are 0, seen, and do not move.
struct StoredSurface {
    FeltSurface felt{};
    TileGrid tiles{};
    /// For each image and tile: 1 where its levels are stored.
    std::vector<std::shared_ptr<const std::vector<std::uint8_t>>> stored{};
    std::vector<std::uint8_t> stored_motion{};  ///< likewise; none: there is no motion

    /// Whether all that was read, moved into the image, is stored in the images of that blend.
    [[nodiscard]] bool holds(const SurfaceRead& read, double blend) const noexcept;
};

/// Reads the newest images once. One thread at a time; throws InputError for a damaged file.
class SurfaceReader {
  public:
    /// `session` must outlive it.
    explicit SurfaceReader(const SessionReader& session);

    /// Whether the session holds any surface.
    [[nodiscard]] bool any() const noexcept { return any_; }
    /// That of a pair, by its number; nothing: it is not stored.
    [[nodiscard]] std::optional<StoredSurface> surface(std::int64_t pair);
    /// The bump map that was read from that file; null: not stored.
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const std::filesystem::path& file);
    /// So many pictures, and their bytes in the file.
    struct PreviewExtent {
        std::int64_t count{0}, bytes{0};
    };
    [[nodiscard]] PreviewExtent preview_extent() const;
    /// The picture of that media whose time is nearest: a JPEG file; empty: none is stored.
    [[nodiscard]] const std::string& preview(std::uint32_t media, double media_s);

  private:
    struct Preview {
        std::uint32_t media{0};
        double media_s{0.0};
        std::int64_t pair{0};
    };
    [[nodiscard]] bool has_previews() const;  ///< false: the file is of before they were stored
    void read_previews();
    /// An image of numbers; 0 where nothing is stored.
    struct Grid {
        int columns{0}, rows{0};
        std::vector<float> values{};
        std::vector<std::uint8_t> stored{};  ///< by tiles
    };
    struct Levels {
        std::shared_ptr<const DepthImage> image{};
        std::shared_ptr<const std::vector<std::uint8_t>> stored{};

        [[nodiscard]] std::size_t size() const noexcept { return image->levels.size(); }
    };
    struct Marks {
        std::shared_ptr<const std::vector<std::uint8_t>> marks{};

        [[nodiscard]] std::size_t size() const noexcept { return marks->size(); }
    };
    /// The things read last, by their numbers.
    template <typename Thing>
    using Kept = std::deque<std::pair<std::int64_t, Thing>>;

    template <typename Thing, typename Read>
    Thing kept(Kept<Thing>& all, std::int64_t id, Read&& read);
    [[nodiscard]] Levels levels(std::int64_t id, double highest);
    [[nodiscard]] std::shared_ptr<const std::vector<std::uint8_t>> marks(std::int64_t id);
    void read_motion(std::int64_t right, std::int64_t down, StoredSurface& surface);
    [[nodiscard]] Grid grid(std::int64_t id);
    void lay(const std::string& bytes, std::size_t place, Grid& grid);
    [[noreturn]] void refuse(const std::string& what) const;

    const SessionReader& session_;
    bool any_{false};
    TileUnpacker unpacker_{};
    Kept<Levels> levels_{};
    Kept<Marks> marks_{};
    std::optional<std::vector<Preview>> previews_{};  // of all, once one was asked for
    std::int64_t preview_pair_{0};                    // of the picture last read; 0: none
    std::string preview_{};
};

}  // namespace dibhr
