// Samples that SDL's disk driver wrote.
#include "tests/app/program/sound_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "tests/support/text.hpp"

namespace dibhr::test {

namespace {

constexpr std::size_t kRate_hz = 48'000;

}  // namespace

std::vector<std::string> sounding_into_file() {
    return {"env", "SDL_AUDIODRIVER=disk", "SDL_DISKAUDIOFILE=sound.raw"};
}

std::vector<float> samples_of(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    std::vector<float> samples(bytes.size() / sizeof(float));
    std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
    return samples;
}

std::vector<bool> heard_tenths(const std::vector<float>& samples) {
    std::vector<bool> heard;
    for (std::size_t k = 0; k < samples.size(); k += kRate_hz / 10) {
        const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(k);
        const auto end =
            begin + std::min<std::ptrdiff_t>(kRate_hz / 10, std::distance(begin, samples.end()));
        heard.push_back(
            std::any_of(begin, end, [](float sample) { return std::abs(sample) > 1e-4F; }));
    }
    return heard;
}

}  // namespace dibhr::test
