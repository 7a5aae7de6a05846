// The program as it is shipped, loaded once and then forked whenever a test asks for it: to load
// its hundreds of libraries takes a third of a second of a processor.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/commands/program.hpp"
#include "core/files/module.hpp"
#include "tests/app/program/program_start.hpp"

namespace {

namespace fs = std::filesystem;
using dibhr::test::kLongestStart_bytes;
using dibhr::test::kStartsDescriptor;
using dibhr::test::ProgramStart;

void redirect(int stream, const fs::path& file, int flags) {
    const int opened = ::open(file.c_str(), flags | O_NOCTTY, 0600);
    ::dup2(opened, stream);
    ::close(opened);
}

/// What exec would have made of it.
[[noreturn]] void become(ProgramStart start) {
    ::close(kStartsDescriptor);
    ::clearenv();
    for (std::string& entry : start.environment) ::putenv(entry.data());
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, start.output, O_WRONLY | O_CREAT);
    redirect(STDERR_FILENO, start.errors, O_WRONLY | O_CREAT);
    if (::chdir(start.folder.c_str()) != 0) ::_exit(127);
    std::vector<char*> argv;
    for (std::string& word : start.words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::exit(dibhr::run_program(static_cast<int>(start.words.size()), argv.data()));
}

/// A child of the test, which takes orphans: its parent here ends at once. `started`: in memory
/// that these processes share.
pid_t start_program(const ProgramStart& start, pid_t& started) {
    const pid_t parent = ::fork();
    if (parent == 0) {
        const pid_t self = ::getpid();
        const pid_t program = ::fork();
        if (program != 0) {
            started = program;
            ::_exit(0);
        }
        while (::getppid() == self) ::sched_yield();
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // of the test
        become(start);
    }
    ::waitpid(parent, nullptr, 0);
    return started;
}

}  // namespace

int main() {
    void* const shared =
        ::mmap(nullptr, sizeof(pid_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return 1;
    // Else each program that opens a picture or a video would load them again.
    static_cast<void>(dibhr::symbol_in_module("dibhr_libav", "avformat_version"));
    static_cast<void>(dibhr::symbol_in_module("dibhr_picture_codecs", "dibhr_picture_codecs"));
    std::string message;
    for (;;) {
        message.resize(kLongestStart_bytes);
        const ssize_t got = ::recv(kStartsDescriptor, message.data(), message.size(), 0);
        if (got <= 0) return 0;
        message.resize(static_cast<std::size_t>(got));
        const pid_t program =
            start_program(dibhr::test::start_of(message), *static_cast<pid_t*>(shared));
        if (::send(kStartsDescriptor, &program, sizeof program, 0) != sizeof program) return 1;
    }
}
