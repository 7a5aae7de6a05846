// How the program is started by a process that has loaded it, as one message on a socket.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dibhr::test {

struct ProgramStart {
    std::filesystem::path folder{};  ///< its current one
    std::filesystem::path output{};  ///< where its streams go
    std::filesystem::path errors{};
    std::vector<std::string> environment{};  ///< all of it: "NAME=value"
    std::vector<std::string> words{};        ///< its name first
};

constexpr std::size_t kLongestStart_bytes = 128 * 1024;
constexpr int kStartsDescriptor = 3;  ///< of the socket, in the process that has loaded it

/// Each part ends with a zero; an empty one ends the environment.
inline std::string message_of(const ProgramStart& start) {
    std::string message;
    const auto add = [&message](const std::string& part) { message.append(part).push_back('\0'); };
    add(start.folder.string());
    add(start.output.string());
    add(start.errors.string());
    for (const std::string& entry : start.environment) add(entry);
    add({});
    for (const std::string& word : start.words) add(word);
    return message;
}

inline ProgramStart start_of(const std::string& message) {
    std::size_t at = 0;
    const auto next = [&] {
        std::string part = message.c_str() + at;
        at += part.size() + 1;
        return part;
    };
    ProgramStart start{.folder = next(), .output = next(), .errors = next()};
    for (std::string entry = next(); !entry.empty(); entry = next())
        start.environment.push_back(std::move(entry));
    while (at < message.size()) start.words.push_back(next());
    return start;
}

}  // namespace dibhr::test
