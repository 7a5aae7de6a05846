// Names and channels of a pad's voice coils.
#include "core/sound/voice_coils.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("only the last two of four channels and more are given what is felt", "[sound]") {
    const int channels = GENERATE(1, 2, 3, 4, 6, 8);
    const std::vector<float> mono{0.5F, -0.25F, 1.0F, 0.0F, -1.0F};
    std::vector<float> frames(mono.size() * static_cast<std::size_t>(channels), 7.0F);
    spread_to_rear(mono, frames, channels);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const int channel = static_cast<int>(k) % channels;
        const bool coil = channels >= 4 && channel >= channels - 2;
        const float wanted = coil ? mono[k / static_cast<std::size_t>(channels)] : 0.0F;
        CHECK(frames[k] == wanted);
    }
}

TEST_CASE("a pad's voice coils are known by the name of its sound device and four channels",
          "[sound]") {
    const std::string by_server = "DualSense wireless controller (PS5) Analog Surround 4.0";
    CHECK(has_voice_coils(by_server, 4));
    CHECK(has_voice_coils("DualSense Wireless Controller, USB Audio", 0));
    CHECK(has_voice_coils("Wireless Controller Analog Surround 4.0", 4));
    // A DualShock 4, a pad whose channels the sound server has taken apart, and a sound card.
    CHECK_FALSE(has_voice_coils("Wireless Controller Analog Stereo", 2));
    CHECK_FALSE(has_voice_coils("DualSense wireless controller (PS5) Internal Speaker", 1));
    CHECK_FALSE(has_voice_coils("Built-in Audio Analog Surround 4.0", 4));
    CHECK_FALSE(has_voice_coils("", 4));
}
