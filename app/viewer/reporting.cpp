// A report of a session, made while the window goes on.
#include "app/viewer/reporting.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): glibc's needs _GNU_SOURCE

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kPolitely = 10;  // nice(2): the hand's and the window's threads come first

/// Starts a program whose stderr goes to that descriptor; 0: it could not be started.
pid_t started(std::vector<std::string> words, int error_descriptor) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, error_descriptor, STDERR_FILENO);
    // It may be ended, whatever this thread leaves to others.
    posix_spawnattr_t manner;
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_init(&manner);
    ::posix_spawnattr_setsigmask(&manner, &none);
    ::posix_spawnattr_setflags(&manner, POSIX_SPAWN_SETSIGMASK);
    pid_t child = 0;
    const int failed =
        ::posix_spawnp(&child, arguments[0], &files, &manner, arguments.data(), environ);
    ::posix_spawnattr_destroy(&manner);
    ::posix_spawn_file_actions_destroy(&files);
    return failed == 0 ? child : 0;
}

/// Until its other end is closed.
std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 512> piece{};
    for (ssize_t count = 1; count != 0;) {
        count = ::read(descriptor, piece.data(), piece.size());
        if (count < 0 && errno != EINTR) break;
        if (count > 0) text.append(piece.data(), static_cast<std::size_t>(count));
    }
    return text;
}

int ending_of(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
}

/// "dibhr: what went wrong": what, without the program's name.
std::string sentence_in(const std::string& errors) {
    constexpr std::string_view kName = "dibhr: ";
    const std::string line = one_line(errors.substr(0, errors.find('\n')));
    return line.starts_with(kName) ? line.substr(kName.size()) : line;
}

}  // namespace

bool Reporting::start(const fs::path& session) {
    if (page_.valid()) return false;
    fs::path folder = session;
    folder.replace_extension();
    folder += "-report";
    std::array<int, 2> errors{};
    if (::pipe2(errors.data(), O_CLOEXEC) != 0)
        throw InputError("no report can be made: too many files are open");
    const pid_t child = started(
        {"/proc/self/exe", "report", session.string(), "--out", folder.string()}, errors[1]);
    ::close(errors[1]);
    if (child == 0) {
        ::close(errors[0]);
        throw InputError(
            "no report can be made: this program cannot be started again; try dibhr "
            "report " +
            session.string());
    }
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(child), kPolitely);
    running_ = child;
    page_ = std::async(std::launch::async, [this, child, read_end = errors[0], folder] {
        const std::string said = read_all(read_end);
        ::close(read_end);
        const int status = ending_of(child);
        running_ = 0;
        if (status != 0)
            throw InputError(said.empty() ? "the report was not made: it was ended"
                                          : sentence_in(said));
        return folder / "report.html";
    });
    return true;
}

std::optional<fs::path> Reporting::take() {
    if (!page_.valid() || page_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return {};
    return page_.get();
}

/// Nothing of a report that is not done remains.
Reporting::~Reporting() {
    const pid_t child = running_;
    if (child > 0) ::kill(child, SIGTERM);
    if (page_.valid()) page_.wait();
}

void show_in_browser(const fs::path& page) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    // The shell ends at once, whenever the browser does.
    const pid_t shell =
        started({"sh", "-c", "command -v xdg-open > /dev/null && xdg-open \"$1\" 2> /dev/null &",
                 "sh", page.string()},
                nowhere);
    if (shell > 0) static_cast<void>(ending_of(shell));
    if (nowhere >= 0) ::close(nowhere);
}

}  // namespace dibhr
