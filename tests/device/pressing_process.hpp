// A program that presses with a device, in a process of its own, seen from outside: when it began
// to end, how it ended, and the guardians it leaves.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "device/hand/guardian.hpp"
#include "tests/device/last_moment.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

class PressingProcess {
  public:
    static constexpr std::chrono::seconds kPatience{60};

    PressingProcess() { REQUIRE(last_ != nullptr); }
    ~PressingProcess() {
        ::munmap(last_, sizeof *last_);
        if (child_ <= 0) return;
        for (const pid_t guardian : guardians()) ::kill(guardian, SIGKILL);
        if (program_ > 0) ::kill(program_, SIGKILL);
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    PressingProcess(const PressingProcess&) = delete;
    PressingProcess& operator=(const PressingProcess&) = delete;

    /// `words` begin with a program's file; somewhere among them is file("moment").
    void begin(std::vector<std::string> words) {
        child_ = ::fork();
        REQUIRE(child_ >= 0);
        if (child_ == 0) become(words);
    }

    [[nodiscard]] std::filesystem::path file(const std::string& name) const {
        return folder_ / name;
    }

    /// Once `it_presses`, and just before it goes its way; then when that was [s].
    double end_begins(const std::function<bool()>& it_presses) {
        REQUIRE(eventually(it_presses, kPatience));
        go_on();
        REQUIRE(eventually([this] { return last_->program != 0; }, kPatience));
        program_ = last_->program;
        return last_->t_s;
    }
    [[nodiscard]] pid_t program() const noexcept { return program_; }
    /// One that presses until then.
    void go_on() noexcept { ++last_->goes_on; }

    /// Its exit code, or 128 and its signal.
    int ended() {
        int status = 0;
        REQUIRE(
            eventually([&] { return ::waitpid(child_, &status, WNOHANG) == child_; }, kPatience));
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    [[nodiscard]] std::string errors() const { return read_text(file("errors")); }

    /// Those whose program was started with this one's folder in its environment.
    [[nodiscard]] std::vector<pid_t> guardians() const {
        std::vector<pid_t> found;
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            const std::string name = entry.path().filename().string();
            if (name.find_first_not_of("0123456789") != std::string::npos) continue;
            if (told_of(entry.path() / "comm") != std::string(Guardian::kProcessName) + "\n")
                continue;
            if (told_of(entry.path() / "environ").find(folder_.path().string()) ==
                std::string::npos)
                continue;
            found.push_back(std::stoi(name));
        }
        return found;
    }
    /// The one that has it from the beginning, and shows its name a moment later.
    [[nodiscard]] pid_t guardian() const {
        std::vector<pid_t> found;
        REQUIRE(eventually([&] { return !(found = guardians()).empty(); }, kPatience));
        REQUIRE(found.size() == 1);
        const std::string process = "/proc/" + std::to_string(found.front());
        CHECK(told_of(process + "/cmdline").starts_with(Guardian::kProcessName));
        return found.front();
    }
    [[nodiscard]] bool its_guardian_ends() const {
        return eventually([this] { return guardians().empty(); }, kPatience);
    }

  private:
    /// Nothing of a process that ends meanwhile, whose file can be opened and not be read.
    static std::string told_of(const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }
    [[noreturn]] void become(std::vector<std::string>& words) const {
        const int errors = ::open(file("errors").c_str(), O_WRONLY | O_CREAT, 0600);
        ::dup2(errors, STDOUT_FILENO);
        ::dup2(errors, STDERR_FILENO);
        ::setenv("PRESSING", folder_.path().c_str(), 1);
        // A sanitizer is to let it die, and to bear libraries before its own.
        constexpr const char* kBear = "handle_segv=0:handle_sigbus=0:handle_abort=0";
        ::setenv("TSAN_OPTIONS", kBear, 1);
        ::setenv("ASAN_OPTIONS",
                 (std::string(kBear) + ":verify_asan_link_order=0:quarantine_size_mb=16").c_str(),
                 1);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        ::execv(arguments.front(), arguments.data());
        ::_exit(127);
    }

    TemporaryFolder folder_{};
    LastMoment* last_{last_moment_in(file("moment").c_str())};
    pid_t child_{-1};
    pid_t program_{-1};
};

/// Ways in which a program may die, and its exit status in each.
struct WayToDie {
    const char* name;
    int code;
};
inline constexpr WayToDie kWaysToDie[]{
    {"kill", 128 + SIGKILL},         {"kill-group", 128 + SIGKILL},
    {"segmentation", 128 + SIGSEGV}, {"bus-error", 128 + SIGBUS},
    {"abort", 128 + SIGABRT},        {"exception", 128 + SIGABRT},
    {"file-size", 128 + SIGXFSZ},    {"exit", 3}};

}  // namespace dibhr::test
