// Runs an unmodified program with simulated Falcons on its USB; kUsage tells how.
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
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/device/falcon/line_socket.hpp"
#include "tests/device/falcon/unit_commands.hpp"
#include "tests/device/falcon/usb_testbed.hpp"

namespace {

using dibhr::test::falcon::ask_line;
using dibhr::test::falcon::kUnitCommands;
using dibhr::test::falcon::LineServer;
using dibhr::test::falcon::UsbPlace;
using dibhr::test::falcon::UsbTestbed;

constexpr const char* kUsage = R"(Runs a program as it is, with simulated Novint Falcons on its USB.

Usage: falcon_host [OPTION VALUE]... -- PROGRAM [ARGUMENT]...

  --serial S         a unit of this serial number; again for another unit (default SIM00001)
  --command COMMAND  performed before the program begins; again for more
  --script FILE      commands, one a line, from the program's beginning on; answers on stderr
  --socket PATH      takes commands while the program runs, one a line, and answers each in one
  --preload LIBRARY  the unit itself (default libfalcon_preload.so beside falcon_host)
  --help             this text

Commands, for the first unit; "@SERIAL COMMAND" is for another one. X is to the right, Y up, Z
out of the base towards the person: 80 mm is pushed in, 115 the middle, 172 pulled out.
)";

constexpr const char* kMoreUsage =
    R"(  unplug                the cable is pulled (not before the program begins)
  replug [ADDRESS]      and put back, at this USB address or the next
  wait SECONDS          in a script only
  wait arrived          in a script only: until the hand has gone all its way

Examples, in the build folder:
  LIBGL_ALWAYS_SOFTWARE=1 ./falcon_host --command firmware --command home -- ./dibhr
  ./falcon_host --serial A --serial B --command '@B refuse 13' -- ./dibhr devices

The exit status is the program's; 2: bad usage. PROGRAM has to be the program itself, not a
script that starts it. Of /sys it sees no more than the simulated bus and /sys/devices/system, so
with OpenGL it has to draw in software.
)";

/// The command line is wrong.
class UsageError : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

struct Arguments {
    bool help{false};
    std::vector<std::string> serials{};
    std::vector<std::string> commands{};
    std::string socket{};
    std::string script{};
    std::string preload{};
    std::vector<char*> program{};  // ends in a null, as execvp() wants it
};

Arguments parse(int count, char** words) {
    Arguments arguments;
    std::map<std::string, std::vector<std::string>> values{
        {"--serial", {}}, {"--command", {}}, {"--socket", {}}, {"--script", {}}, {"--preload", {}}};
    int i = 1;
    for (; i < count && std::string(words[i]) != "--"; i += 2) {
        const std::string option = words[i];
        if (option == "--help" || option == "-h") {
            arguments.help = true;
            return arguments;
        }
        const auto known = values.find(option);
        if (known == values.end()) {
            throw UsageError("no option is called " + option + "; the program comes after --");
        }
        if (i + 1 >= count) throw UsageError(option + " needs a value");
        known->second.emplace_back(words[i + 1]);
    }
    for (++i; i < count; ++i) arguments.program.push_back(words[i]);
    if (arguments.program.empty()) throw UsageError("name the program to run after --");
    arguments.program.push_back(nullptr);
    const auto last_of = [&values](const char* option) {
        const auto& given = values.at(option);
        return given.empty() ? std::string() : given.back();
    };
    arguments.serials = values.at("--serial");
    if (arguments.serials.empty()) arguments.serials.emplace_back("SIM00001");
    arguments.commands = values.at("--command");
    arguments.socket = last_of("--socket");
    arguments.script = last_of("--script");
    arguments.preload = last_of("--preload");
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

using Script = std::vector<std::string>;

/// Its lines, without comments; none of no file.
Script read_script(const std::string& path) {
    Script lines;
    if (path.empty()) return lines;
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read; give a file of commands");
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && !line.starts_with("#")) lines.push_back(line);
    }
    return lines;
}

/// Of "wait SECONDS"; nothing of any other line.
std::optional<double> seconds_to_wait(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    double seconds = 0.0;
    if (words >> word >> seconds && word == "wait") return seconds;
    return std::nullopt;
}

void run_script(const std::stop_token& stop, const Script& script, Host& host) {
    for (const std::string& line : script) {
        if (stop.stop_requested()) return;
        if (line == "wait arrived") {
            while (host.answer("state").find(" arrived 0 ") != std::string::npos) {
                if (!pause(std::chrono::milliseconds(10), stop)) return;
            }
        } else if (const auto seconds = seconds_to_wait(line)) {
            if (!pause(std::chrono::duration<double>(*seconds), stop)) return;
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
    const Script script = read_script(arguments.script);
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
    const std::jthread scripted(
        [&](const std::stop_token& stop) { run_script(stop, script, host); });
    const int status = wait_for(program, signals);
    host.program_has_ended();
    return status;
}

}  // namespace

int main(int count, char** words) {
    constexpr int kBadUsage = 2;
    try {
        const Arguments arguments = parse(count, words);
        if (!arguments.help) return run(arguments);
        std::cout << kUsage << kUnitCommands << kMoreUsage;
        return EXIT_SUCCESS;
    } catch (const UsageError& problem) {
        std::cerr << kUsage << kUnitCommands << kMoreUsage << "\nfalcon_host: " << problem.what()
                  << '\n';
        return kBadUsage;
    } catch (const std::exception& problem) {
        std::cerr << "falcon_host: " << problem.what() << '\n';
        return EXIT_FAILURE;
    }
}
