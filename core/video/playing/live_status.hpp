// The status of a live source for the window and its messages.
#pragma once

#include <cstdint>
#include <string>

#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

struct LiveStatus {
    std::string from{};  ///< the name of the source of depth
    /// Mean delay from the arrival of a picture until the surface shows it fully [s]: one interval,
    /// the cleaning, and the jitter of arrival.
    double behind_s{0.0};
    std::int64_t dropped{0};         ///< pictures that came too soon after others to be shown
    double arrives_per_s{0.0};       ///< mean rate; 0: not known yet
    bool motion_paused{false};       ///< requested, but there is no time: nothing is carried
    bool in_betweens_paused{false};  ///< likewise: frames are blended
    bool signal{true};
    double silent_s{0.0};         ///< how long the signal has been lost
    bool force_off{false};        ///< because the surface moved when the signal was lost
    bool format_changed{false};   ///< the pictures changed size or kind: open the source again
    std::string trouble{};        ///< why it cannot be reached; empty: no data arrives
    bool permanent_error{false};  ///< the trouble is permanent: waiting does not help
    std::uint32_t opened{0};      ///< number given when it was opened
    std::uint32_t media{0};       ///< number that all frames carry; 0: no frames yet
    DepthNoise noise{};           ///< measured in the first pictures
};

/// "Signal from 'udp://...'", "No signal from ...", or that it changed its form.
[[nodiscard]] std::string signal_in_words(const LiveStatus& live);

/// One line to show: "52 ms behind", "No signal from 'udp://...' for 3 s: waiting".
[[nodiscard]] std::string in_words(const LiveStatus& live);

}  // namespace dibhr
