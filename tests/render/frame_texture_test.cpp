// A video's planes look on the relief as the same picture in red, green and blue does, whether a
// graphics processor converts them or the processor.
#include "render/frame_texture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "render/relief_pass.hpp"
#include "tests/render/hidden_window.hpp"
#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

struct Samples {
    std::array<std::vector<std::uint8_t>, 3> bytes{};
};

/// Smooth planes of BT.601 in limited range: `halved` chroma, `paired` in one plane, in words of 10
/// bits where `words`. The memory lives in `samples`.
VideoPicture smooth_planes(int columns, int rows, bool halved, bool paired, bool words,
                           Samples& samples) {
    VideoPicture picture;
    picture.plane_count = paired ? 2 : 3;
    picture.sample_bytes = words ? 2 : 1;
    picture.columns = columns;
    picture.rows = rows;
    const auto put = [words](std::vector<std::uint8_t>& to, int value) {
        const int code = words ? 4 * value : value;
        to.push_back(static_cast<std::uint8_t>(code & 0xff));
        if (words) to.push_back(static_cast<std::uint8_t>(code >> 8));
    };
    const int across = halved ? (columns + 1) / 2 : columns;
    const int down = halved ? (rows + 1) / 2 : rows;
    const auto rows_of = [](std::vector<std::uint8_t>& bytes, int wide, int high) {
        return SamplePlane{bytes.data(), bytes.size() / static_cast<std::size_t>(high), wide, high};
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) put(samples.bytes[0], 70 + 90 * i / columns);
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            put(samples.bytes[1], 105 + 40 * j / down);
            put(samples.bytes[paired ? 1 : 2], 150 - 35 * i / across);
        }
    picture.planes[0] = rows_of(samples.bytes[0], columns, rows);
    picture.planes[1] = rows_of(samples.bytes[1], across, down);
    if (!paired) picture.planes[2] = rows_of(samples.bytes[2], across, down);
    const float codes = words ? 65535.0F / 4.0F : 255.0F;  // in steps of 8 bits
    const float luma = codes / 219.0F;
    const float chroma = codes / 224.0F;
    const auto row = [&](float blue, float red) {
        return std::array<float, 4>{luma, blue * chroma, red * chroma,
                                    -(16.0F / 219.0F) - (blue + red) * (128.0F / 224.0F)};
    };
    picture.rgb_of_samples = {row(0.0F, 1.402F), row(-0.344136F, -0.714136F), row(1.772F, 0.0F)};
    return picture;
}

glm::mat4 clip_from_world(const Camera& camera, glm::ivec2 size) {
    return glm::mat4(camera.clip_from_view(static_cast<double>(size.x) / size.y) *
                     camera.view_from_world());
}

ColourImage drawn(ReliefPass& relief, const Frame& frame, const Camera& camera, glm::ivec2 size) {
    SceneContent content = still(frame);
    content.relief_style.light = 0.0;
    const Offscreen target(size, 0);
    glViewport(0, 0, size.x, size.y);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    relief.draw(content, clip_from_world(camera, size));
    glDisable(GL_DEPTH_TEST);
    return read_framebuffer(size);
}

ColourImage drawn(const Frame& frame, const Camera& camera, glm::ivec2 size,
                  const GlLimits& limits) {
    ReliefPass relief(limits);
    return drawn(relief, frame, camera, size);
}

/// The same picture in red, green and blue, upright.
std::shared_ptr<const ColourImage> upright(const VideoPicture& picture) {
    return colour_image(picture.columns, picture.rows, [&](int i, int j) {
        const auto rgb = rgb_at(picture, i, j);
        return Rgb{rgb[0], rgb[1], rgb[2]};
    });
}

}  // namespace

TEST_CASE("planes look as the same picture in red green and blue") {
    HiddenWindow window;
    const bool halved = GENERATE(false, true);
    const bool paired = GENERATE(false, true);
    const bool words = GENERATE(false, true);
    const bool software = GENERATE(false, true);
    const int turns = GENERATE(0, 1, 2, 3);
    const bool odd = GENERATE(false, true);
    CAPTURE(halved, paired, words, software, turns, odd);
    Samples samples;
    VideoPicture planes =
        smooth_planes(odd ? 63 : 64, odd ? 47 : 48, halved, paired, words, samples);
    planes.quarter_turns = turns;
    if (turns % 2 != 0) std::swap(planes.columns, planes.rows);
    GlLimits limits = read_limits();
    limits.software = software;
    const auto depth = depth_image(40, 30, [](int, int) { return 0.0; });
    const Frame plain = frame(depth, upright(planes));
    Frame shared = frame(depth);
    shared.video = std::make_shared<const VideoPicture>(planes);
    CHECK(textures_of(shared, limits) == (software ? 1 : planes.plane_count));
    const Camera camera = straight(40, 30);
    const glm::ivec2 size(200, 150);
    const ColourImage expected = drawn(plain, camera, size, limits);
    const ColourImage seen = drawn(shared, camera, size, limits);
    int most = 0;
    int brightest = 0;
    for (std::size_t k = 0; k < seen.rgb.size(); ++k) {
        most = std::max(most, std::abs(int{seen.rgb[k]} - int{expected.rgb[k]}));
        brightest = std::max(brightest, int{seen.rgb[k]});
    }
    CHECK(brightest > 100);
    CHECK(most <= 3);
    CHECK(window.errors().empty());
}

TEST_CASE("a texture follows a change of size and of the form of samples") {
    HiddenWindow window;
    GlLimits limits = read_limits();
    limits.software = GENERATE(false, true);
    CAPTURE(limits.software);
    ReliefPass relief(limits);
    const auto depth = depth_image(40, 30, [](int, int) { return 0.0; });
    const Camera camera = straight(40, 30);
    const glm::ivec2 size(80, 60);
    std::vector<Samples> memory(4);
    const std::vector<VideoPicture> forms{smooth_planes(64, 48, true, false, false, memory[0]),
                                          smooth_planes(32, 48, true, false, false, memory[1]),
                                          smooth_planes(32, 48, false, true, false, memory[2]),
                                          smooth_planes(32, 48, false, true, true, memory[3])};
    for (const VideoPicture& form : forms) {
        Frame shared = frame(depth);
        shared.video = std::make_shared<const VideoPicture>(form);
        const ColourImage seen = drawn(relief, shared, camera, size);
        const ColourImage fresh = drawn(shared, camera, size, limits);
        CHECK(pixel(seen, {40, 30}) == pixel(fresh, {40, 30}));
    }
    CHECK(window.errors().empty());
}
