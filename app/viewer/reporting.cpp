// A report of a session, made while the window goes on.
#include "app/viewer/reporting.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <string_view>

#include "app/desktop/program.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kPolitely = 10;  // nice(2): the hand's and the window's threads come first

/// The first line of the errors, without "dibhr: ".
std::string sentence_in(const std::string& errors) {
    constexpr std::string_view kName = "dibhr: ";
    const std::string line = one_line(errors.substr(0, errors.find('\n')));
    return line.starts_with(kName) ? line.substr(kName.size()) : line;
}

}  // namespace

bool Reporting::start(const fs::path& session) {
    if (child_ != 0) return false;
    fs::path folder = session;
    folder.replace_extension();
    folder += "-report";
    std::array<int, 2> errors{};
    if (::pipe2(errors.data(), O_CLOEXEC | O_NONBLOCK) != 0)
        throw InputError("no report can be made: too many files are open");
    const pid_t child =
        start_program({"/proc/self/exe", "report", session.string(), "--out", folder.string()},
                      {.errors = errors[1]});
    ::close(errors[1]);
    if (child == 0) {
        ::close(errors[0]);
        throw InputError(
            "no report can be made: this program cannot be started again; try dibhr "
            "report " +
            session.string());
    }
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(child), kPolitely);
    child_ = child;
    errors_.clear();
    error_pipe_ = errors[0];
    page_ = folder / "report.html";
    return true;
}

void Reporting::read_errors() {
    std::array<char, 512> piece{};
    for (ssize_t count = 1; count > 0;) {
        count = ::read(error_pipe_, piece.data(), piece.size());
        if (count > 0) errors_.append(piece.data(), static_cast<std::size_t>(count));
    }
}

std::optional<fs::path> Reporting::take() {
    if (child_ == 0) return {};
    read_errors();  // else the child could block on a full pipe
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) != child_) return {};
    read_errors();
    ::close(error_pipe_);
    child_ = 0;
    if (status != 0)
        throw InputError(errors_.empty() ? "the report was not made: its program was ended"
                                         : sentence_in(errors_));
    return page_;
}

Reporting::~Reporting() {
    if (child_ != 0) ::close(error_pipe_);
}

void show_in_browser(const fs::path& page) {
    // The shell ends at once and leaves the browser running.
    const pid_t shell = start_program(
        {"sh", "-c", "command -v xdg-open > /dev/null && xdg-open \"$1\" 2> /dev/null &", "sh",
         page.string()},
        {});
    int status = 0;
    while (shell > 0 && ::waitpid(shell, &status, 0) < 0 && errno == EINTR) continue;
}

}  // namespace dibhr
