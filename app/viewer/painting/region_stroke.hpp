// A brush stroke over the label pictures of named regions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/haptics/vec.hpp"
#include "core/video/guide/regions.hpp"

namespace dibhr {

/// From a press to its release: what it passes belongs to one region, in all label pictures.
class RegionStroke {
  public:
    /// `before` null: there are no regions; then the label picture is as large as the image of
    /// columns x rows. `region`: that of the same name gets its text, or else it is a new one;
    /// without a name the stroke erases. Throws InputError where there are too many.
    RegionStroke(const Regions* before, const Region& region, double radius_px, int columns,
                 int rows);

    /// Moves the brush to `place` of the image in a straight line, painting on the way. False: the
    /// brush was there already.
    bool go_to(const Vec3& place);

    /// The regions after the stroke so far.
    [[nodiscard]] const Regions& regions() const noexcept { return regions_; }
    /// Whether they differ from those before; null: there were none.
    [[nodiscard]] bool has_changed(const Regions* before) const;

  private:
    void dab(double x, double y);

    Regions regions_{};
    std::uint8_t label_{0};
    double radius_px_;  // of the image
    int columns_, rows_;
    std::optional<Vec3> last_{};
};

/// The regions without those that are nowhere; null: none is left.
[[nodiscard]] std::shared_ptr<const Regions> without_bare(const Regions& regions);

}  // namespace dibhr
