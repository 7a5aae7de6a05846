// The samples that a stream plays on SDL's sound devices, and on which channels.
#include "app/sound/sound_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// SDL's audio driver that writes files, each named like its device.
class DiskAudio {
  public:
    DiskAudio() {
        SDL_LogSetAllPriority(SDL_NUM_LOG_PRIORITIES);  // hides this driver's warning
        REQUIRE(SDL_AudioInit("disk") == 0);
    }
    ~DiskAudio() {
        SDL_AudioQuit();
        SDL_LogResetPriorities();
    }
    DiskAudio(const DiskAudio&) = delete;
    DiskAudio& operator=(const DiskAudio&) = delete;
};

/// Six channels, frame after frame.
std::vector<float> frames_in(const std::string& file) {
    const std::string bytes = read_text(file);
    std::vector<float> frames(bytes.size() / sizeof(float));
    std::memcpy(frames.data(), bytes.data(), frames.size() * sizeof(float));
    return frames;
}

float loudest_of_channel(const std::vector<float>& frames, std::size_t channel) {
    float most = 0.0F;
    for (std::size_t k = channel; k < frames.size(); k += 6)
        most = std::max(most, std::abs(frames[k]));
    return most;
}

}  // namespace

TEST_CASE("voice coils are given what is felt on the rear channels alone, and both the same",
          "[pads]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "coils.raw").string();
    const auto ring = std::make_unique<SoundRing>();
    TripleBuffer<SoundChoice> choices;
    choices.publish({});
    {
        const DiskAudio audio;
        const SoundStream stream(file.c_str(), *ring, choices);
        REQUIRE(stream.plays());
        int pushed = 0;
        const auto is_heard = [&] {
            for (int k = 0; k < 2; ++k) {  // of about two milliseconds
                const bool contact = pushed++ % 60 > 20;
                ring->push({{0.0, 0.0, contact ? 0.0 : 5.0}, contact ? 1.0 : 0.0, contact, true});
            }
            return pushed % 40 == 0 && loudest_of_channel(frames_in(file), 4) > 0.01F;
        };
        CHECK(eventually(is_heard));
    }
    const std::vector<float> frames = frames_in(file);
    REQUIRE(frames.size() % 6 == 0);
    for (std::size_t channel = 0; channel < 4; ++channel)
        CHECK(loudest_of_channel(frames, channel) == 0.0F);
    CHECK(loudest_of_channel(frames, 4) > 0.01F);
    bool same = true;
    for (std::size_t k = 0; k + 5 < frames.size(); k += 6)
        same = same && frames[k + 4] == frames[k + 5];
    CHECK(same);
}

TEST_CASE("no other sound device is taken for voice coils", "[pads]") {
    const DiskAudio audio;
    CHECK_FALSE(voice_coil_device().has_value());
}
