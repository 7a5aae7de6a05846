// Turns how a command ended into an exit code.
#include "app/commands/program.hpp"

#include <cerrno>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

#include "app/desktop/realtime_kit.hpp"
#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/terminal.hpp"
#include "core/files/write_failure.hpp"
#include "core/realtime/memory.hpp"
#include "core/realtime/priority_broker.hpp"

namespace dibhr {

namespace {

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kBadUsage = 2;

/// errno holds why writing to standard output failed. EPIPE: the reader ended, no failure.
int exit_code_of_failed_printing() {
    if (errno == EPIPE) return kSuccess;
    print_error_line("standard output: " + write_failure(errno));
    return kFailure;
}

int exit_code_of(const Arguments& arguments, const PictureHook& after_picture) {
    try {
        const int exit_code = run_command_line(arguments, after_picture);
        std::cout.flush();
        return exit_code;
    } catch (const OutputClosed&) {
        return kSuccess;
    } catch (const std::ios::failure&) {
        return exit_code_of_failed_printing();
    } catch (const UsageError& error) {
        print_error_line(error.what());
        return kBadUsage;
    } catch (const std::bad_alloc&) {
        print_error_line(
            "not enough memory: close other programs, raise the limit (ulimit -v), or take a "
            "smaller video");
        return kFailure;
    } catch (const std::system_error& error) {
        print_error_line(std::string("the system refused a thread or a file (") + error.what() +
                         "): close other programs or raise its limits");
        return kFailure;
    } catch (const std::exception& error) {
        print_error_line(error.what());
        return kFailure;
    }
}

/// For threads whom the system's limits refuse real-time priority.
Grant later_priority(pid_t thread, const std::stop_token& stop) {
    return ask_realtime_kit(thread, shipped_limits_file().string(), stop);
}

}  // namespace

int run_program(int argc, char** argv, const PictureHook& after_picture) {
    prepare_heap();
    // A closed pipe is an ordinary end, not a signal.
    std::signal(SIGPIPE, SIG_IGN);
    // A parent's SIG_IGN is inherited; the kernel would then keep no exit status of children.
    std::signal(SIGCHLD, SIG_DFL);
    const PlainOutput plain(std::cout);
    std::cout.exceptions(std::ios::badbit);
    // Printing an error must not flush std::cout, which would throw for the failed output.
    std::cerr.tie(nullptr);
    const PriorityBroker priorities(later_priority);
    const int exit_code = exit_code_of({argv + 1, argv + argc}, after_picture);
    // The failure has been reported; the last flush, at exit, must not throw.
    std::cout.exceptions(std::ios::goodbit);
    return exit_code;
}

}  // namespace dibhr
