// A stand-in of speech-dispatcher's library, which writes down what it is told to say.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

/// The calls so far, without their times: "open dibhr", "cancel ", "say Cup".
inline std::vector<std::string> calls_in(const std::filesystem::path& file) {
    std::vector<std::string> calls;
    if (!std::filesystem::exists(file)) return calls;
    for (const std::string& line : split(read_text(file), '\n'))
        if (!line.empty()) calls.push_back(line.substr(line.find(' ') + 1));
    return calls;
}

/// Runs the program with the stand-in as the system's library.
inline std::vector<std::string> with_stand_in(const TemporaryFolder& folder,
                                              const std::vector<std::string>& more = {}) {
    std::vector<std::string> host{"env", std::string("LD_LIBRARY_PATH=") + STAND_IN_SPEECH,
                                  "DIBHR_SPOKEN=" + (folder / "spoken").string()};
    host.insert(host.end(), more.begin(), more.end());
    return host;
}

}  // namespace dibhr::test
