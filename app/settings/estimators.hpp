// The depth estimators that the user has entered in the settings file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// A line of the table [estimators]: midas = "python run.py --input_path {frames} ...", or with the
/// meaning of its numbers: depth-pro = { command = "...", unit = "m" }.
struct Estimator {
    std::string name{};
    std::string command{};
    DepthStatement meaning{};

    bool operator==(const Estimator&) const = default;
};

/// The estimator of that name; null: there is none.
[[nodiscard]] const Estimator* estimator_named(std::span<const Estimator> estimators,
                                               const std::string& name);

/// The estimator as a line of the settings file. Its name must be a bare TOML key.
[[nodiscard]] std::string toml_of(const Estimator& estimator);

/// A sentence that says how to add an estimator.
[[nodiscard]] std::string estimator_hint();

/// The cache of estimated depth: $XDG_CACHE_HOME/dibhr/depth, or ~/.cache/dibhr/depth.
[[nodiscard]] std::filesystem::path depth_cache_path();

}  // namespace dibhr
