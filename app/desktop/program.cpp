// posix_spawn, without this program's signal mask, process group and stdin.
#include "app/desktop/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <csignal>

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): glibc's needs _GNU_SOURCE

namespace dibhr {

namespace {

void add_output(posix_spawn_file_actions_t& files, int from, int stream) {
    if (from >= 0) {
        ::posix_spawn_file_actions_adddup2(&files, from, stream);
    } else {
        ::posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    }
}

}  // namespace

pid_t start_program(std::vector<std::string> command, const ProgramOutput& printed) {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    add_output(files, printed.output, STDOUT_FILENO);
    add_output(files, printed.errors, STDERR_FILENO);
    // No signal blocked, so that SIGTERM ends it, whatever this thread blocks.
    posix_spawnattr_t manner;
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_init(&manner);
    ::posix_spawnattr_setsigmask(&manner, &none);
    ::posix_spawnattr_setpgroup(&manner, 0);
    ::posix_spawnattr_setflags(&manner, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int failed =
        ::posix_spawnp(&child, arguments[0], &files, &manner, arguments.data(), environ);
    ::posix_spawnattr_destroy(&manner);
    ::posix_spawn_file_actions_destroy(&files);
    return failed == 0 ? child : 0;
}

}  // namespace dibhr
