// Small protocols for tests.
#pragma once

#include <string>
#include <vector>

#include "core/study/study_run.hpp"

namespace dibhr::test {

inline AllowedNames allowed_names() {
    return {.materials = std::vector<std::string>{"ice", "bark"}};
}

/// A page of conditions a, b, c and so on, with what is added to it.
inline std::string page_of_conditions(int count, const std::string& rest) {
    std::string page = "title = \"T\"\nseed = 5\n";
    for (int k = 0; k < count; ++k)
        page += "[[condition]]\nname = \"" + std::string(1, static_cast<char>('a' + k)) + "\"\n";
    return page + rest;
}

inline Protocol protocol(const std::string& page) {
    return protocol_of(page, "study.toml", allowed_names());
}

/// All trials, answered by `answer(trial)`.
template <typename Answer>
std::vector<AnsweredTrial> all_trials(const Protocol& protocol, int number, const Answer& answer) {
    std::vector<AnsweredTrial> all;
    while (auto trial = next_trial(protocol, number, all)) {
        const StudyAnswer given = answer(*trial);
        all.push_back({.trial = *trial, .answer = given, .right = is_right(*trial, given)});
    }
    return all;
}

inline std::vector<AnsweredTrial> all_trials(const Protocol& protocol, int number) {
    return all_trials(protocol, number, [](const Trial&) { return StudyAnswer{.choice = 0}; });
}

}  // namespace dibhr::test
