// A session in pictures: where it was touched, forces and speeds over time, histograms.
#pragma once

#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/plot/axes.hpp"
#include "core/plot/canvas.hpp"
#include "core/report/session_numbers.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// The background of a heat map.
struct HeatMapGround {
    ColourImage picture{};  ///< of any size; empty: plain ground
    int columns{0};         ///< of the depth image
    int rows{0};
    double pitch_mm{kPaperPitch_mm};
};

/// The standard deviation of the Gaussian that spreads the touch of a pixel over its neighbours, in
/// an image of so many columns [px]: about a finger's breadth of what is seen.
[[nodiscard]] double heat_map_sigma_px(int columns);

/// A heat map's colour for a share in [0, 1], from pale to dark. Lightness falls all along, so that
/// the order survives colour blindness and a black-and-white print.
[[nodiscard]] Ink heat_ink(double share);

/// Ticks for few decades: 1, 2 and 5 times powers of ten in a positive span, ascending.
[[nodiscard]] std::vector<double> close_ticks(ValueSpan span);

/// Contact time per pixel, spread by the Gaussian, over the picture, with scales in seconds and
/// millimetres. The longest of the episodes are numbered as in `episodes`; those of other media are
/// not shown. There must be a touched pixel in the ground.
[[nodiscard]] Canvas plot_heat_map(const TouchedPlaces& places, const HeatMapGround& ground,
                                   const std::vector<Episode>& episodes, std::uint32_t media,
                                   const std::string& subtitle);

/// Text and marks of the plots over time and the histograms.
struct PlotContext {
    std::string subtitle{};
    double begin_s{0.0};  ///< the first tick, on the marks' clock
    std::vector<SessionMark> marks{};
};

/// Whether the session is so long that a touch is narrower than a line. Its plots then show the
/// range of the values, pale, and their mean over pieces of a few seconds.
[[nodiscard]] bool shows_means(const TimeLine& line);

/// Spring force and force sent, with the times in contact, the video's time and the marks.
[[nodiscard]] Canvas plot_force_over_time(const SessionNumbers& numbers,
                                          const PlotContext& context);
/// Likewise the speeds of goal and proxy; there must be some.
[[nodiscard]] Canvas plot_speed_over_time(const SessionNumbers& numbers,
                                          const PlotContext& context);

/// There must be a contact of some time.
[[nodiscard]] Canvas plot_force_histogram(const SessionNumbers& numbers,
                                          const PlotContext& context);
/// There must be a contact.
[[nodiscard]] Canvas plot_contact_histogram(const SessionNumbers& numbers,
                                            const PlotContext& context);
/// There must be speeds.
[[nodiscard]] Canvas plot_speed_histogram(const SessionNumbers& numbers,
                                          const PlotContext& context);

}  // namespace dibhr
