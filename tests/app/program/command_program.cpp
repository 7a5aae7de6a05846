// Runs the real program from a test and makes its input files.
#include "tests/app/program/command_program.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <iterator>

#include "core/video/media.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {
namespace fs = std::filesystem;
namespace {

int exit_code_of(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

void redirect(int stream, const fs::path& file, int flags) {
    const int opened = ::open(file.c_str(), flags, 0600);
    ::dup2(opened, stream);
    ::close(opened);
}

}  // namespace

ProgramResult run_dibhr(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& host) {
    const TemporaryFolder told;
    std::vector<std::string> words = host;
    words.emplace_back(DIBHR_PROGRAM);
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
        redirect(STDOUT_FILENO, told / "output", O_WRONLY | O_CREAT);
        redirect(STDERR_FILENO, told / "errors", O_WRONLY | O_CREAT);
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
        ::setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
        ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        if (::chdir(folder.path().c_str()) == 0) ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    REQUIRE(::wait4(child, &status, 0, &usage) == child);
    return {exit_code_of(status), read_text(told / "output"), read_text(told / "errors"),
            static_cast<std::size_t>(usage.ru_maxrss) * 1024};
}

void run_shell(const TemporaryFolder& folder, const std::string& command) {
    const std::string line = "cd '" + folder.path().string() + "' && " + command + " </dev/null";
    INFO(line);
    REQUIRE(exit_code_of(::system(line.c_str())) == 0);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

void write_depth_png(const fs::path& file, int columns, int rows, int first, int slope) {
    ColourImage picture{columns, rows, {}};
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const auto level = static_cast<std::uint8_t>(first + slope * i);
            picture.rgb.insert(picture.rgb.end(), 3, level);
        }
    }
    write_png(picture, file);
}

}  // namespace dibhr::test
