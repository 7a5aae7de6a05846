// A textured thing that moves before a textured wall, known at every time and place: what cameras
// see of it, and where each of its points goes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/video/frames/frame_window.hpp"

namespace dibhr::test {

/// What a camera adds, to each frame anew.
struct CameraNoise {
    double brightness{0.0};  ///< standard deviation [levels of 255]
    double elevation_px{0.0};
    std::uint32_t seed{1};
    double exposure{0.0};  ///< how far it swings, twice a second [share of the brightness]
};

/// Brightness around 0 that is random from one pixel to the next, and over tens of them [levels].
[[nodiscard]] double texture(double x, double y, int seed);

/// Formulas, in pixels and seconds; elevations of a highest level of 255 px.
class MovingScene {
  public:
    enum class Shape : std::uint8_t { plane, sphere, hand, disc };
    /// Of the thing. Shaded: brighter towards one side of its rim.
    enum class Look : std::uint8_t { textured, plain, shaded };
    /// Of the whole; a turn and growth are of the shape's rim: for ever, or (swelling) only at
    /// first, and then as much faster as it is larger.
    enum class Goes : std::uint8_t { along, round, apart, swelling };
    struct What {
        Shape shape{Shape::hand};
        Goes goes{Goes::along};
        double speed_px_per_s{0.0};
        int columns{640};
        int rows{480};
        Look look{Look::textured};
        double diameter_px{0.0};  ///< of a disc
    };
    struct Point {
        double x{0.0}, y{0.0};
    };
    struct Seen {
        double elevation_px;
        int object;  ///< 0: the wall
    };

    explicit MovingScene(const What& what);

    [[nodiscard]] Seen at(double t_s, Point place) const;
    /// Where the point that is seen at `place` at `t_s` is at `later_s`.
    [[nodiscard]] Point gone(double t_s, Point place, double later_s) const;

    /// The same of every pixel.
    [[nodiscard]] std::shared_ptr<const MotionField> motion(double from_s, double to_s) const;

    /// As a camera without lens has it: a pixel's brightness is the mean over it, its depth that of
    /// its middle.
    [[nodiscard]] Frame frame(double t_s, const CameraNoise& noise = {}) const;
    /// Its depth alone; `off_px`: how far off a pixel's is.
    [[nodiscard]] Frame uncoloured(double t_s,
                                   const std::function<double(int i, int j)>& off_px = {}) const;

    [[nodiscard]] const What& what() const { return what_; }
    [[nodiscard]] double size_px() const;  ///< from its middle to its rim

  private:
    [[nodiscard]] Point middle(double t_s) const;
    [[nodiscard]] double grown(double t_s) const;
    [[nodiscard]] Point on_thing(double t_s, Point place) const;
    [[nodiscard]] Point off_thing(double t_s, Point on) const;
    [[nodiscard]] Seen at(Point on, Point place) const;
    [[nodiscard]] double brightness(double t_s, int i, int j) const;  ///< [0, 255]
    [[nodiscard]] double brightness_on(Point on) const;

    What what_;
    std::vector<double> wall_{};  ///< its brightness, which stays: four places of each pixel
};

/// Frames of a scene in a row, the first at 0 s, without or after a video codec's own loss: the
/// colour is coded by ffmpeg's H.264 (CRF 23, 4:2:0), where `coded`.
[[nodiscard]] std::vector<Frame> film(const MovingScene& scene, int count, double frames_per_s,
                                      const CameraNoise& noise, bool coded);

}  // namespace dibhr::test
