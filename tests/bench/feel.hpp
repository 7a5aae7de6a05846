// Measures of how a recording feels: fingers at rest and sliding over its frames as the program
// cleans and blends them.  Spring 0.5 N/mm, friction 0.4, goal 12 px below the surface smoothed
// over 250 ms (rest) or 10 ms (slide). Relief 255 px and pitch 101.6/720 mm at any size of picture,
// so that figures of several recordings and of several ways of cleaning can be compared; `fitted`
// takes those that the viewer fits to the picture.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "core/video/frames/cleaning_options.hpp"
#include "core/video/sources/media.hpp"
#include "tests/bench/blemishes.hpp"
#include "tests/bench/finger_run.hpp"

namespace dibhr::bench {

struct FeelOptions {
    CleaningOptions cleaning{};
    bool fitted{false};  ///< relief and pitch
    int spots{12};       ///< of each way to touch
    std::uint32_t seed{1};
};

/// The ways to touch.
enum class Way {
    rest_quiet,     ///< where the data changes less from frame to frame than in half of the pixels
    rest_anywhere,  ///< at any pixel, with data or without
    slide,          ///< back and forth where it is no steeper than 0.8
};
inline constexpr std::array kWays{Way::rest_quiet, Way::rest_anywhere, Way::slide};

[[nodiscard]] constexpr const char* name_of(Way way) noexcept {
    switch (way) {
        case Way::rest_quiet:
            return "rest-quiet";
        case Way::rest_anywhere:
            return "rest-anywhere";
        case Way::slide:
            break;
    }
    return "slide";
}

struct Feel {
    std::array<FeelNumbers, kWays.size()> of{};
    /// The milliseconds of slides in which no cliff is near (is_near_cliff), and the others.
    FeelNumbers slide_smooth{};
    FeelNumbers slide_cliffs{};
    Blemishes blemishes{};  ///< of some of the cleaned frames
    int columns{0};
    int rows{0};
    std::int64_t frames{0};
    double seconds{0.0};     ///< of the recording
    std::string cleaning{};  ///< as text: its cleaning

    [[nodiscard]] const FeelNumbers& operator[](Way way) const {
        return of[static_cast<std::size_t>(way)];
    }
};

/// Each finger touches for 3 s, or until the recording ends. Fingers begin at up to twelve moments
/// of the recording, at random places (std::mt19937): the same seed gives the same places, whatever
/// the cleaning. Where few pixels change or none is flat enough there are fewer fingers, or none.
/// Throws InputError.
[[nodiscard]] Feel feel_of(std::unique_ptr<Media> media, const FeelOptions& options);

}  // namespace dibhr::bench
