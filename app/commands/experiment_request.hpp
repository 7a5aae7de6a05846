// The command line of `dibhr experiment`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/commands/experiment.hpp"

namespace dibhr {

/// What the options were, before they are checked against each other.
struct ExperimentRequest {
    ExperimentOptions options{};
    std::string json{};
    std::string plots{};
    std::string session{};
    std::string trace{};
    bool mu_given{false};
    bool depth_given{false};
};

/// Path, outputs, hand, friction, depth and algorithms. `request` must outlive the parsing of
/// `app`.
void add_experiment_options(CLI::App& app, ExperimentRequest& request);

/// Throws UsageError for options that do not go together.
[[nodiscard]] ExperimentOptions experiment_options(const ExperimentRequest& request);

}  // namespace dibhr
