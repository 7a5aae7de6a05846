// The program `dibhr`: runs the command line and turns how it ended into an exit code.
#include <malloc.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"

namespace {

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kBadUsage = 2;

/// errno holds why writing to standard output failed. A reader that went away had enough.
int exit_code_of_failed_printing() {
    if (errno == EPIPE) return kSuccess;
    const std::string reason = std::strerror(errno);
    dibhr::print_error_line("standard output: cannot be written (" + reason +
                            "); make room for it or send it elsewhere");
    return kFailure;
}

int exit_code_of(const std::vector<std::string>& arguments) {
    try {
        const int exit_code = dibhr::run_command_line(arguments);
        std::cout.flush();
        return exit_code;
    } catch (const dibhr::OutputClosed&) {
        return kSuccess;
    } catch (const std::ios::failure&) {
        return exit_code_of_failed_printing();
    } catch (const dibhr::UsageError& error) {
        dibhr::print_error_line(error.what());
        return kBadUsage;
    } catch (const std::bad_alloc&) {
        dibhr::print_error_line(
            "not enough memory: close other programs, raise the limit (ulimit -v), or take a "
            "smaller video");
        return kFailure;
    } catch (const std::system_error& error) {
        dibhr::print_error_line(std::string("the system refused a thread or a file (") +
                                error.what() + "): close other programs or raise its limits");
        return kFailure;
    } catch (const std::exception& error) {
        dibhr::print_error_line(error.what());
        return kFailure;
    }
}

}  // namespace

int main(int argc, char** argv) {
    // One heap for all threads: what one gives back, the others take, and the system can have it.
    mallopt(M_ARENA_MAX, 1);
    // A closed pipe is an ordinary end, not a signal.
    std::signal(SIGPIPE, SIG_IGN);
    std::cout.exceptions(std::ios::badbit);
    // An error line must not flush, and so throw for, what could not be printed.
    std::cerr.tie(nullptr);
    const int exit_code = exit_code_of({argv + 1, argv + argc});
    // What could not be printed has been told; the last flush at exit has nobody to tell.
    std::cout.exceptions(std::ios::goodbit);
    return exit_code;
}
