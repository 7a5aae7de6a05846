// What is told of something live while it is shown.
#pragma once

#include <cstdint>
#include <string>

#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

struct LiveStatus {
    std::string from{};  ///< the name of what sends the depth
    /// From a picture's coming until the surface is wholly what it shows, as of late [s]: the time
    /// from frame to frame, what cleaning takes, and as much as pictures come unevenly.
    double behind_s{0.0};
    std::int64_t dropped{0};       ///< pictures that came too soon after others to be shown
    double arrives_per_s{0.0};     ///< as of late; 0: not known yet
    bool motion_rests{false};      ///< wanted, but there is no time to find it: nothing is carried
    bool in_betweens_rest{false};  ///< likewise: frames fade into each other
    bool signal{true};
    double silent_s{0.0};     ///< since when it is lost
    bool force_off{false};    ///< because it moved when it was lost
    bool other_form{false};   ///< it now sends pictures of another form: open it again
    std::string trouble{};    ///< why it cannot be reached; empty: it is silent
    std::uint32_t opened{0};  ///< number it was opened by
    std::uint32_t media{0};   ///< number that all frames carry; 0: there are none
    DepthNoise noise{};       ///< as measured in its first pictures
};

/// "Signal from 'udp://...'", "No signal from ...", or that it changed its form.
[[nodiscard]] std::string signal_in_words(const LiveStatus& live);

/// In one line, for a person: "52 ms behind", "No signal from 'udp://...' for 3 s: waiting".
[[nodiscard]] std::string in_words(const LiveStatus& live);

}  // namespace dibhr
