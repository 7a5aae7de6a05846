// The helper programs kdialog, zenity and qarma: each shows a dialog and prints the chosen files.
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/desktop/file_dialog.hpp"
#include "app/desktop/program.hpp"
#include "core/files/machine.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kTerminateTimeout = std::chrono::milliseconds(50);  // after SIGTERM
constexpr int kPollInterval_ms = 5;

/// Also for qarma, which takes the same options.
std::vector<std::string> zenity(const std::string& name, const FileQuestion& question) {
    std::vector<std::string> command{name,
                                     "--file-selection",
                                     "--multiple",
                                     "--separator=\n",
                                     "--title=" + question.title,
                                     "--filename=" + question.folder.string() + "/"};
    for (const FileFilter& filter : question.filters)
        command.push_back("--file-filter=" + filter.name + " | " + listed(filter.patterns, " "));
    return command;
}

std::vector<std::string> kdialog(const FileQuestion& question) {
    std::string filters;
    for (const FileFilter& filter : question.filters) {
        if (!filters.empty()) filters += '\n';
        filters += filter.name + " (" + listed(filter.patterns, " ") + ")";
    }
    std::vector<std::string> command{"kdialog", "--title", question.title, "--multiple",
                                     "--separate-output"};
    if (question.x11_window != 0) {
        command.emplace_back("--attach");
        command.push_back(std::to_string(question.x11_window));
    }
    command.insert(command.end(), {"--getopenfilename", question.folder.string(), filters});
    return command;
}

/// The desktop's own helper first.
std::vector<std::vector<std::string>> helpers_for(const FileQuestion& question) {
    const bool kde =
        environment_variable("XDG_CURRENT_DESKTOP").find("KDE") != std::string_view::npos;
    std::vector<std::vector<std::string>> helpers{zenity("zenity", question),
                                                  zenity("qarma", question)};
    helpers.insert(kde ? helpers.begin() : helpers.end(), kdialog(question));
    return helpers;
}

/// One path a line. A name may contain a line break, but no slash follows it.
std::vector<std::filesystem::path> paths_in(std::string printed) {
    constexpr std::string_view kNext = "\n/";
    if (printed.ends_with('\n')) printed.pop_back();
    std::vector<std::filesystem::path> files;
    while (!printed.empty()) {
        const std::size_t end = printed.find(kNext);
        files.emplace_back(printed.substr(0, end));
        printed.erase(0, end == std::string::npos ? end : end + 1);
    }
    return files;
}

/// A running helper program, ended at the latest by the destructor.
class HelperProcess {
  public:
    explicit HelperProcess(std::vector<std::string> command) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
        child_ = start_program(std::move(command), {.output = ends[1]});
        ::close(ends[1]);
        printed_end_ = ends[0];
    }
    ~HelperProcess() {
        if (printed_end_ >= 0) ::close(printed_end_);
        end();
    }
    HelperProcess(const HelperProcess&) = delete;
    HelperProcess& operator=(const HelperProcess&) = delete;

    [[nodiscard]] bool started() const { return child_ != 0; }

    /// Reads all its output; false: called off.
    [[nodiscard]] bool read_all(const Cancellation& cancellation, std::string& printed) const {
        std::array<pollfd, 2> events{pollfd{printed_end_, POLLIN, 0},
                                     pollfd{cancellation.descriptor(), POLLIN, 0}};
        while (true) {
            if (::poll(events.data(), events.size(), -1) < 0 && errno == EINTR) continue;
            if (cancellation.is_cancelled()) return false;
            std::array<char, 4096> piece{};
            const ssize_t count = ::read(printed_end_, piece.data(), piece.size());
            if (count == 0) return true;
            if (count > 0) printed.append(piece.data(), static_cast<std::size_t>(count));
        }
    }

    /// The status from waitpid(), when the helper has ended; nothing: called off.
    [[nodiscard]] std::optional<int> status(const Cancellation& cancellation) {
        while (!cancellation.is_cancelled()) {
            if (const auto ended = take_status()) return ended;
            pollfd event{cancellation.descriptor(), POLLIN, 0};
            ::poll(&event, 1, kPollInterval_ms);
        }
        return std::nullopt;
    }

  private:
    std::optional<int> take_status() {
        int status = 0;
        if (::waitpid(child_, &status, WNOHANG) != child_) return std::nullopt;
        child_ = 0;
        return status;
    }

    /// Ends the helper and all programs it has started.
    void end() {
        if (child_ == 0) return;
        ::kill(-child_, SIGTERM);
        const auto latest = Clock::now() + kTerminateTimeout;
        while (Clock::now() < latest) {
            if (take_status()) return;
            ::poll(nullptr, 0, kPollInterval_ms);
        }
        ::kill(-child_, SIGKILL);
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
        child_ = 0;
    }

    pid_t child_{0};
    int printed_end_{-1};
};

FileAnswer ask_one(const std::vector<std::string>& command, const Cancellation& cancellation,
                   const DialogTimeouts& timeouts) {
    const auto begin = Clock::now();
    HelperProcess helper(command);
    if (!helper.started()) return {};
    std::string printed;
    if (!helper.read_all(cancellation, printed)) return {FileAnswer::Outcome::cancelled};
    const auto status = helper.status(cancellation);
    if (!status) return {FileAnswer::Outcome::cancelled};
    if (!WIFEXITED(*status)) return {};
    if (WEXITSTATUS(*status) != 0) {  // 1: cancelled, or the helper cannot open the display
        const bool person = Clock::now() - begin >= timeouts.shortest_human_reply;
        return {person ? FileAnswer::Outcome::cancelled : FileAnswer::Outcome::unavailable};
    }
    FileAnswer answer{FileAnswer::Outcome::chosen, paths_in(printed)};
    if (answer.files.empty()) answer.outcome = FileAnswer::Outcome::cancelled;
    return answer;
}

}  // namespace

FileAnswer ask_helper(const FileQuestion& question, const Cancellation& cancellation,
                      const DialogTimeouts& timeouts) {
    for (const std::vector<std::string>& command : helpers_for(question)) {
        FileAnswer answer = ask_one(command, cancellation, timeouts);
        if (answer.outcome != FileAnswer::Outcome::unavailable) return answer;
    }
    return {};
}

}  // namespace dibhr
