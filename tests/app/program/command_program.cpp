// Runs the real program from a test and makes its input files.
#include "tests/app/program/command_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "tests/app/program/program_start.hpp"
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

/// A process that has loaded the program and forks it.
class LoadedProgram {
  public:
    LoadedProgram() {
        std::array<int, 2> ends{};
        REQUIRE(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0);
        process_ = ::fork();
        if (process_ == 0) {
            ::dup2(ends[1], kStartsDescriptor);
            ::fcntl(kStartsDescriptor, F_SETFD, 0);  // where the two are the same
            ::execl(LOADED_PROGRAM, LOADED_PROGRAM, nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        socket_ = ends[0];
    }
    ~LoadedProgram() {
        ::close(socket_);
        ::waitpid(process_, nullptr, 0);
    }
    LoadedProgram(const LoadedProgram&) = delete;
    LoadedProgram& operator=(const LoadedProgram&) = delete;

    /// A child of this process.
    [[nodiscard]] pid_t start(const ProgramStart& start) const {
        const std::string message = message_of(start);
        REQUIRE(message.size() < kLongestStart_bytes);
        pid_t started = -1;
        ::prctl(PR_SET_CHILD_SUBREAPER, 1);
        const ssize_t sent = ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL);
        const ssize_t got = ::recv(socket_, &started, sizeof started, 0);
        ::prctl(PR_SET_CHILD_SUBREAPER, 0);
        REQUIRE(sent == static_cast<ssize_t>(message.size()));
        REQUIRE(got == sizeof started);
        REQUIRE(started > 0);
        return started;
    }

  private:
    pid_t process_{-1};
    int socket_{-1};
};

/// This process's own, but that there is no display, that settings, data and cache are in the
/// folder, and that `others` has the last word.
std::vector<std::string> environment_in(const TemporaryFolder& folder,
                                        const std::vector<std::string>& others = {}) {
    std::vector<std::string> entries{"XDG_CONFIG_HOME=" + folder.path().string(),
                                     "XDG_DATA_HOME=" + folder.path().string(),
                                     "XDG_CACHE_HOME=" + (folder / "cache").string(),
                                     "XDG_STATE_HOME=" + (folder / "state").string()};
    entries.insert(entries.end(), others.begin(), others.end());
    const auto name_of = [](std::string_view entry) { return entry.substr(0, entry.find('=')); };
    std::set<std::string, std::less<>> given{"DISPLAY", "WAYLAND_DISPLAY"};
    for (const std::string& entry : entries) given.emplace(name_of(entry));
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (!given.contains(name_of(*entry))) entries.emplace_back(*entry);
    return entries;
}

/// By exec, through a host.
pid_t start_hosted(const ProgramStart& start) {
    std::vector<std::string> environment = start.environment;
    std::vector<std::string> words = start.words;
    const auto pointers_to = [](std::vector<std::string>& texts) {
        std::vector<char*> pointers;
        for (std::string& text : texts) pointers.push_back(text.data());
        pointers.push_back(nullptr);
        return pointers;
    };
    const std::vector<char*> entries = pointers_to(environment);
    const std::vector<char*> argv = pointers_to(words);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child > 0) return child;
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, start.output, O_WRONLY | O_CREAT);
    redirect(STDERR_FILENO, start.errors, O_WRONLY | O_CREAT);
    if (::chdir(start.folder.c_str()) == 0) ::execve(argv[0], argv.data(), entries.data());
    ::_exit(127);
}

/// Kills it when it does not end.
void wait_for_end(pid_t child) {
    constexpr int kPatience_ms = 120'000;  // only reached by a failure
    const auto descriptor = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
    if (descriptor < 0) return;  // an older kernel: whoever runs the tests ends them
    pollfd end{descriptor, POLLIN, 0};
    if (::poll(&end, 1, kPatience_ms) == 0) ::kill(child, SIGKILL);
    ::close(descriptor);
}

const LoadedProgram& loaded_program() {
    static const LoadedProgram loaded;
    return loaded;
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProgramResult run_dibhr(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& host) {
    const TemporaryFolder told;
    ProgramStart start{.folder = folder.path(),
                       .output = told / "output",
                       .errors = told / "errors",
                       .environment = environment_in(folder),
                       .words = host};
    start.words.emplace_back(DIBHR_PROGRAM);
    start.words.insert(start.words.end(), arguments.begin(), arguments.end());
    const pid_t child = host.empty() ? loaded_program().start(start) : start_hosted(start);
    wait_for_end(child);
    int status = 0;
    rusage usage{};
    REQUIRE(::wait4(child, &status, 0, &usage) == child);
    return {exit_code_of(status), read_text(start.output), read_text(start.errors),
            static_cast<std::size_t>(usage.ru_maxrss) * 1024,
            seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
}

std::string run_dibhr_at_terminal(const TemporaryFolder& folder,
                                  const std::vector<std::string>& arguments,
                                  const std::vector<std::string>& environment) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    REQUIRE(::grantpt(terminal) == 0);
    REQUIRE(::unlockpt(terminal) == 0);
    const std::string name = ::ptsname(terminal);
    const int other_end = ::open(name.c_str(), O_RDWR | O_NOCTTY);  // held while it may be read
    ProgramStart start{.folder = folder.path(),
                       .output = name,
                       .errors = name,
                       .environment = environment_in(folder, environment),
                       .words = {DIBHR_PROGRAM}};
    start.words.insert(start.words.end(), arguments.begin(), arguments.end());
    const pid_t child = loaded_program().start(start);
    std::string told;
    const auto take = [&told, terminal](int patience_ms) {
        std::array<char, 4096> bytes{};
        pollfd input{terminal, POLLIN, 0};
        if (::poll(&input, 1, patience_ms) <= 0) return false;
        const ssize_t got = ::read(terminal, bytes.data(), bytes.size());
        if (got > 0) told.append(bytes.data(), static_cast<std::size_t>(got));
        return got > 0;
    };
    while (::waitpid(child, nullptr, WNOHANG) == 0) take(5);
    while (take(0)) continue;
    ::close(other_end);
    ::close(terminal);
    return told;
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
