// Runs an unmodified program with simulated Falcons on its USB:
//
//     falcon_host [--serial S]... [--command 'COMMAND']... [--socket PATH] [--script FILE]
//                 [--preload LIBRARY] -- PROGRAM ARGUMENTS...
//
// COMMANDs are obeyed before the program begins, and later over the socket, one a line, answered in
// a line: those of unit_commands.hpp, and `unplug` and `replug [ADDRESS]`. They are for the first
// unit; "@SERIAL COMMAND" is for another one. FILE holds such lines too; there, `wait SECONDS` and
// `wait arrived` (the hand has gone all its way) are known as well; each answer goes to stderr, and
// the script begins with the program. The exit status is the program's.
//
// PROGRAM must be the program itself, not a script that starts it. It sees the simulated /sys only,
// but for /sys/devices/system; with OpenGL it has to draw in software (LIBGL_ALWAYS_SOFTWARE=1).
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tests/device/falcon/line_socket.hpp"
#include "tests/device/falcon/usb_testbed.hpp"

namespace {

using dibhr::test::falcon::ask_line;
using dibhr::test::falcon::LineServer;
using dibhr::test::falcon::UsbPlace;
using dibhr::test::falcon::UsbTestbed;

struct Arguments {
    std::vector<std::string> serials{};
    std::vector<std::string> commands{};
    std::string socket{};
    std::string script{};
    std::string preload{};
    std::vector<char*> program{};  // ends in a null, as execvp() wants it
};

Arguments parse(int count, char** words) {
    Arguments arguments;
    int i = 1;
    for (; i < count && std::string(words[i]) != "--"; i += 2) {
        const std::string option = words[i];
        if (i + 1 >= count) throw std::invalid_argument(option + " needs a value");
        const std::string value = words[i + 1];
        if (option == "--serial") {
            arguments.serials.push_back(value);
        } else if (option == "--command") {
            arguments.commands.push_back(value);
        } else if (option == "--socket") {
            arguments.socket = value;
        } else if (option == "--script") {
            arguments.script = value;
        } else if (option == "--preload") {
            arguments.preload = value;
        } else {
            throw std::invalid_argument("unknown option " + option);
        }
    }
    for (++i; i < count; ++i) arguments.program.push_back(words[i]);
    if (arguments.program.empty()) throw std::invalid_argument("which program? -- PROGRAM ...");
    arguments.program.push_back(nullptr);
    if (arguments.serials.empty()) arguments.serials.emplace_back("SIM00001");
    return arguments;
}

/// The bus outside of the program, and the way to the units inside of it.
class Host {
  public:
    explicit Host(const std::vector<std::string>& serials) {
        for (const std::string& serial : serials) {
            units_.push_back(
                {serial, {static_cast<int>(units_.size()) + 1, ++last_address_}, true});
            testbed_.add(units_.back().place, serial);
        }
    }

    [[nodiscard]] std::string folder() const { return testbed_.folder(); }
    [[nodiscard]] std::string inner_socket() const { return folder() + "/falcon.socket"; }
    [[nodiscard]] std::string units() const {
        std::string lines;
        for (const Unit& unit : units_) lines += unit.place.node() + " " + unit.serial + "\n";
        return lines;
    }
    /// "SERIAL COMMAND" of "COMMAND" or "@SERIAL COMMAND".
    [[nodiscard]] std::string addressed(const std::string& command) const {
        if (command.starts_with("@")) return command.substr(1);
        return units_.front().serial + " " + command;
    }

    void program_has_ended() noexcept { program_ended_ = true; }

    std::string answer(const std::string& command) {
        const std::lock_guard lock(mutex_);
        std::istringstream words(addressed(command));
        std::string serial;
        std::string word;
        words >> serial >> word;
        for (Unit& unit : units_) {
            if (unit.serial != serial) continue;
            if (word == "unplug") return unplug(unit);
            int address = 0;
            if (word == "replug") return plug(unit, words >> address ? address : 0);
        }
        return ask(addressed(command));
    }

  private:
    struct Unit {
        std::string serial;
        UsbPlace place;
        bool plugged;
    };

    /// The program may not have come so far yet, or have ended.
    std::string ask(const std::string& line) const {
        return ask_line(inner_socket(), line, [this] { return !program_ended_; });
    }

    std::string unplug(Unit& unit) {
        if (!unit.plugged) return "error: it is not plugged";
        std::string answer = ask(unit.serial + " pull");
        testbed_.remove(unit.place);
        unit.plugged = false;
        return answer;
    }

    std::string plug(Unit& unit, int address) {
        if (unit.plugged) return "error: it is plugged";
        unit.place.address = address > 0 ? address : last_address_ + 1;
        last_address_ = unit.place.address;
        // The unit is there before udev says so.
        std::string answer = ask(unit.serial + " plug " + unit.place.node());
        testbed_.add(unit.place, unit.serial);
        unit.plugged = true;
        return answer;
    }

    std::mutex mutex_{};
    UsbTestbed testbed_{};
    std::vector<Unit> units_{};
    int last_address_{1};
    std::atomic<bool> program_ended_{false};
};

/// Sleeps; false when asked to stop.
bool pause(std::chrono::duration<double> time, const std::stop_token& stop) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any never;
    never.wait_for(lock, stop, time, [] { return false; });
    return !stop.stop_requested();
}

void run_script(const std::stop_token& stop, const std::string& path, Host& host) {
    constexpr std::string_view kWait = "wait ";
    std::ifstream script(path);
    for (std::string line; std::getline(script, line) && !stop.stop_requested();) {
        if (line.empty() || line.starts_with("#")) continue;
        if (line == "wait arrived") {
            while (host.answer("state").find(" arrived 0 ") != std::string::npos) {
                if (!pause(std::chrono::milliseconds(10), stop)) return;
            }
        } else if (line.starts_with(kWait)) {
            const double seconds = std::stod(line.substr(kWait.size()));
            if (!pause(std::chrono::duration<double>(seconds), stop)) return;
        } else {
            std::cerr << "falcon_host: " + line + ": " + host.answer(line) + "\n";
        }
    }
}

void become_program(const Arguments& arguments, const Host& host) {
    std::string commands;
    for (const std::string& command : arguments.commands) {
        commands += host.addressed(command) + "\n";
    }
    std::string libraries = "libumockdev-preload.so.0";
    libraries.insert(0, arguments.preload + ":");
    if (const char* const before = std::getenv("LD_PRELOAD")) {
        libraries += std::string(":") + before;
    }
    setenv("LD_PRELOAD", libraries.c_str(), 1);
    setenv("UMOCKDEV_DIR", host.folder().c_str(), 1);
    setenv("FALCON_UNITS", host.units().c_str(), 1);
    setenv("FALCON_SOCKET", host.inner_socket().c_str(), 1);
    setenv("FALCON_COMMANDS", commands.c_str(), 1);
    execvp(arguments.program.front(), arguments.program.data());
    std::perror(arguments.program.front());
    _exit(127);
}

/// The program's exit status; signals that would end this process are for the program.
int wait_for(pid_t program, const sigset_t& signals) {
    for (;;) {
        int signal = 0;
        sigwait(&signals, &signal);
        if (signal != SIGCHLD) kill(program, signal);
        int status = 0;
        if (waitpid(program, &status, WNOHANG) != program) continue;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
}

int run(Arguments arguments) {
    if (arguments.preload.empty()) {
        const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
        arguments.preload = here / "libfalcon_preload.so";
    }
    sigset_t signals;
    sigset_t before;
    sigemptyset(&signals);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &before);  // before any thread begins: for all of them
    Host host(arguments.serials);
    const pid_t program = fork();
    if (program < 0) throw std::runtime_error("cannot start another process");
    if (program == 0) {
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        become_program(arguments, host);
    }
    std::optional<LineServer> server;
    if (!arguments.socket.empty()) {
        server.emplace(arguments.socket,
                       [&host](const std::string& line) { return host.answer(line); });
    }
    std::jthread script;
    if (!arguments.script.empty()) {
        script = std::jthread(
            [&](const std::stop_token& stop) { run_script(stop, arguments.script, host); });
    }
    const int status = wait_for(program, signals);
    host.program_has_ended();
    return status;
}

}  // namespace

int main(int count, char** words) {
    try {
        return run(parse(count, words));
    } catch (const std::exception& problem) {
        std::cerr << "falcon_host: " << problem.what() << '\n';
        return EXIT_FAILURE;
    }
}
