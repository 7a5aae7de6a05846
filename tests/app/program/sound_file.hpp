// What the window gives a sound device, written into a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dibhr::test {

/// Starts the viewer so that what it sounds like goes into sound.raw of its folder.
[[nodiscard]] std::vector<std::string> sounding_into_file();

[[nodiscard]] std::vector<float> samples_of(const std::filesystem::path& file);

/// Of the samples whether each tenth of a second holds a sound.
[[nodiscard]] std::vector<bool> heard_tenths(const std::vector<float>& samples);

}  // namespace dibhr::test
