// What the window, its recorder, a study and an estimation write while the power is cut.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "core/estimate/depth_estimate.hpp"
#include "core/study/study_file.hpp"

namespace dibhr::test {

inline constexpr int kCutTicks = 3000;
inline constexpr int kCutTrials = 4;

inline StudyIdentity cut_identity() {
    return {.participant = "P07",
            .number = 7,
            .program = "dibhr 0",
            .protocol_name = "study.toml",
            .protocol_text = "title = \"T\"",
            .protocol_sha256 = "abc",
            .seed = 5};
}

inline AnsweredTrial cut_trial(int number) {
    return {.trial = {.number = number,
                      .form = TrialForm::rating,
                      .intervals = {{"a", {.numbers = {{"friction", 0.1}}}, 0.1}}},
            .answer = {.number = 4.0, .reaction_s = 0.5},
            .utc_s = 1.7e9};
}

/// By what is written, in a folder: "settings", "history", "maps", "material", "pictures",
/// "session", "study", "cache".
[[nodiscard]] const std::map<std::string, std::function<void(const std::filesystem::path&)>>&
cut_work();

/// Of the colour and by the estimator that the test has put there.
inline EstimateRequest cut_request(const std::filesystem::path& folder) {
    return {.colour = folder / "colour.mkv",
            .command = "'" + (folder / "estimator").string() + "' {frames} {output}",
            .cache = folder / "cache"};
}

}  // namespace dibhr::test
