// Runs an unmodified program with simulated Falcons on its USB; see kUsage.
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <list>
#include <map>
#include <memory>
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
#include "tests/device/falcon/usbfs_files.hpp"
#include "tests/device/falcon/usbfs_host.hpp"

namespace {

using dibhr::test::falcon::CommandPacket;
using dibhr::test::falcon::FalconModel;
using dibhr::test::falcon::KernelWork;
using dibhr::test::falcon::kUnitCommands;
using dibhr::test::falcon::LineServer;
using dibhr::test::falcon::UsbfsFiles;
using dibhr::test::falcon::UsbfsHost;
using dibhr::test::falcon::UsbfsUnit;
using dibhr::test::falcon::UsbPlace;
using dibhr::test::falcon::UsbTestbed;

constexpr const char* kUsage = R"(Runs a program as it is, with simulated Novint Falcons on its USB.

Usage: falcon_host [OPTION VALUE]... -- PROGRAM [ARGUMENT]...

  --serial S         a unit of this serial number; again for another unit (default SIM00001)
  --command COMMAND  performed before the program begins; again for more
  --script FILE      commands, one a line, from the program's beginning on; answers on stderr
  --socket PATH      takes commands while the program runs, one a line, and answers each in one
  --packets FILE     every command that arrives at the first unit, a CSV row each, written at once:
                     t_s (CLOCK_MONOTONIC), motor1, motor2, motor3 (counts), led (2 green, 4 blue,
                     8 red), homing. That motors let go by themselves (hold) is no command
  --preload LIBRARY  the way to it (default libfalcon_preload.so beside falcon_host)
  --help             this text

Commands, for the first unit; "@SERIAL COMMAND" is for another one. X is to the right, Y up, Z
out of the base towards the person: 80 mm is pushed in, 115 the middle, 172 pulled out.
)";

constexpr const char* kMoreUsage =
    R"(  unplug                the cable is pulled
  replug [ADDRESS]      and put back, at this USB address or the next
  wait SECONDS          in a script only
  wait arrived          in a script only: until the hand has gone all its way

Examples, in the build folder:
  LIBGL_ALWAYS_SOFTWARE=1 ./falcon_host --command firmware --command home -- ./dibhr
  ./falcon_host --serial A --serial B --command '@B refuse 13' -- ./dibhr devices

The exit status is the program's; 2: bad usage. The units outlive the program: falcon_host ends
when the program has ended and no process has a unit open any more, at most 20 s later. PROGRAM
has to be the program itself, not a script that starts it. Of /sys it sees no more than the
simulated bus and /sys/devices/system, so with OpenGL it has to draw in software.
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
    std::string packets{};
    std::string preload{};
    std::vector<char*> program{};  // ends in a null, as execvp() wants it
};

Arguments parse(int count, char** words) {
    Arguments arguments;
    std::map<std::string, std::vector<std::string>> values{{"--serial", {}},  {"--command", {}},
                                                           {"--socket", {}},  {"--script", {}},
                                                           {"--packets", {}}, {"--preload", {}}};
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
    arguments.packets = last_of("--packets");
    arguments.preload = last_of("--preload");
    return arguments;
}

/// A file of every command that a unit gets, written by a thread of its own: a slow disk is not to
/// stop the bus.
class PacketFile {
  public:
    explicit PacketFile(const std::string& path) : file_(path) {
        if (!file_) throw std::runtime_error(path + ": cannot be written; choose another file");
        rows_ = "t_s,motor1,motor2,motor3,led,homing\n";
        thread_ = std::jthread([this](const std::stop_token& stop) { write(stop); });
    }
    void add(const CommandPacket& packet) {
        const std::chrono::duration<double> seconds = packet.at;
        const auto& motors = packet.motors;
        std::array<char, 80> row{};
        std::snprintf(row.data(), row.size(), "%.6f,%d,%d,%d,%u,%d\n", seconds.count(), motors[0],
                      motors[1], motors[2], packet.lamp, packet.homing ? 1 : 0);
        {
            const std::lock_guard lock(mutex_);
            rows_ += row.data();
        }
        more_.notify_one();
    }

  private:
    void write(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (more_.wait(lock, stop, [this] { return !rows_.empty(); })) {
            const std::string rows = std::exchange(rows_, {});
            lock.unlock();
            file_ << rows << std::flush;
            lock.lock();
        }
    }

    std::ofstream file_;
    std::mutex mutex_{};
    std::condition_variable_any more_{};
    std::string rows_{};  // not written yet
    std::jthread thread_{};
};

/// The bus with its units, and the kernel that a program reaches them by.
class Host {
  public:
    Host(const std::vector<std::string>& serials, const std::string& packets) {
        if (!packets.empty()) packets_.emplace(packets);
        for (const std::string& serial : serials) {
            Unit& unit = units_.emplace_back(std::make_shared<UsbfsUnit>(serial),
                                             UsbPlace{static_cast<int>(units_.size()) + 1, 0});
            plug(unit, 0);
        }
        if (!packets_) return;
        units_.front().usbfs->wire().with([this](FalconModel& model) {
            model.board().watch([this](const CommandPacket& packet) { packets_->add(packet); });
        });
    }

    [[nodiscard]] std::string folder() const { return testbed_.folder(); }
    /// Where the program's system calls come in.
    [[nodiscard]] std::string socket() const { return folder() + "/usbfs.socket"; }
    [[nodiscard]] bool in_use() { return files_.any_open(); }

    /// To "COMMAND", for the first unit, or "@SERIAL COMMAND".
    std::string answer(const std::string& line) {
        const std::lock_guard lock(mutex_);
        std::istringstream words(line);
        std::string serial = units_.front().usbfs->serial();
        if (line.starts_with("@")) words.ignore(1) >> serial;
        std::string command;
        std::getline(words >> std::ws, command);
        for (Unit& unit : units_) {
            if (unit.usbfs->serial() == serial) return perform(unit, command);
        }
        return "error: no unit has the serial number " + serial;
    }

  private:
    struct Unit {
        Unit(std::shared_ptr<UsbfsUnit> made, UsbPlace at) : usbfs(std::move(made)), place(at) {}
        std::shared_ptr<UsbfsUnit> usbfs;
        UsbPlace place;
        bool plugged{false};
    };

    std::string perform(Unit& unit, const std::string& command) {
        std::istringstream words(command);
        std::string word;
        words >> word;
        int address = 0;
        if (word == "unplug") return unplug(unit);
        if (word == "replug") return plug(unit, words >> address ? address : 0);
        return dibhr::test::falcon::perform(*unit.usbfs, command);
    }

    std::string unplug(Unit& unit) {
        if (!unit.plugged) return "error: it is not plugged";
        unit.usbfs->wire().unplug();
        files_.withdraw(unit.place.node());
        testbed_.remove(unit.place);
        unit.plugged = false;
        return "ok";
    }

    std::string plug(Unit& unit, int address) {
        if (unit.plugged) return "error: it is plugged";
        unit.place.address = address > 0 ? address : last_address_ + 1;
        last_address_ = unit.place.address;
        unit.usbfs->wire().plug();
        files_.serve(unit.place.node(), unit.usbfs);  // before udev says so
        testbed_.add(unit.place, unit.usbfs->serial());
        unit.plugged = true;
        return "ok";
    }

    std::mutex mutex_{};
    std::optional<PacketFile> packets_{};  // written while the first unit's bus stands still
    UsbTestbed testbed_{};
    std::list<Unit> units_{};
    UsbfsFiles files_{};
    int last_address_{1};
    UsbfsHost usbfs_{socket(), files_};
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
    std::string libraries = "libumockdev-preload.so.0";
    libraries.insert(0, arguments.preload + ":");
    if (const char* const before = std::getenv("LD_PRELOAD")) {
        libraries += std::string(":") + before;
    }
    setenv("LD_PRELOAD", libraries.c_str(), 1);
    setenv("UMOCKDEV_DIR", host.folder().c_str(), 1);
    setenv("FALCON_SOCKET", host.socket().c_str(), 1);
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
    std::optional<Host> host_of_units;
    {
        const KernelWork above_the_program;
        host_of_units.emplace(arguments.serials, arguments.packets);
    }
    Host& host = *host_of_units;
    for (const std::string& command : arguments.commands) {
        const std::string answer = host.answer(command);
        if (answer != "ok") std::cerr << "falcon_host: " + command + ": " + answer + "\n";
    }
    const pid_t program = fork();
    if (program < 0) throw std::runtime_error("cannot start another process");
    if (program == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a killed host leaves no program behind
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
    // Its guardian process may still send packets.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (host.in_use() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
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
