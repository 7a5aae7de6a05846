// The depth estimators that a person has installed, as the settings file has them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// A line of the table [estimators]: midas = "python run.py --input_path {frames} ...", or with
/// what its numbers mean: depth-pro = { command = "...", unit = "m" }.
struct Estimator {
    std::string name{};
    std::string command{};
    DepthStatement meaning{};

    bool operator==(const Estimator&) const = default;
};

/// The one of that name; null: there is none.
[[nodiscard]] const Estimator* estimator_called(std::span<const Estimator> estimators,
                                                const std::string& name);

/// As the settings file has it: a line. A name that is no bare key is none of its.
[[nodiscard]] std::string toml_of(const Estimator& estimator);

/// How a person gets one, as a sentence.
[[nodiscard]] std::string how_to_have_an_estimator();

/// Where estimated depth is kept: $XDG_CACHE_HOME/dibhr/depth, or ~/.cache/dibhr/depth.
[[nodiscard]] std::filesystem::path depth_cache_path();

}  // namespace dibhr
