// Preloaded into an unmodified program by falcon_host: simulated Falcons below its libusb.
// Environment, set by the host:
//   FALCON_UNITS     a line a unit: NODE SERIAL
//   FALCON_SOCKET    the host's commands come here
//   FALCON_COMMANDS  lines to perform before the program's main(): SERIAL COMMAND
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "tests/device/falcon/line_socket.hpp"
#include "tests/device/falcon/unit_commands.hpp"
#include "tests/device/falcon/usbfs_shim.hpp"

namespace dibhr::test::falcon {

namespace {

/// The units by serial; lives as long as the process, whose threads use it to the end.
class PreloadedUnits {
  public:
    explicit PreloadedUnits(const std::string& units) {
        std::istringstream lines(units);
        std::string node;
        std::string serial;
        while (lines >> node >> serial) {
            auto unit = std::make_shared<UsbfsUnit>(serial);
            serve_node(node, unit);
            units_[serial] = {std::move(unit), node};
        }
    }

    /// SERIAL COMMAND; besides those of perform(): `pull`, and `plug NODE`.
    std::string answer(const std::string& line) {
        std::istringstream words(line);
        std::string serial;
        std::string command;
        words >> serial;
        std::getline(words >> std::ws, command);
        const auto found = units_.find(serial);
        if (found == units_.end()) return "error: no unit has the serial number " + serial;
        auto& [unit, node] = found->second;
        constexpr std::size_t kPlugWord = 5;
        if (command == "pull") {
            unit->wire().unplug();
            withdraw_node(node);
            return "ok";
        }
        if (command.starts_with("plug ")) {
            node = command.substr(kPlugWord);
            unit->wire().plug();
            serve_node(node, unit);
            return "ok";
        }
        return perform(*unit, command);
    }

  private:
    struct Served {
        std::shared_ptr<UsbfsUnit> unit{};
        std::string node{};
    };

    std::map<std::string, Served> units_{};
};

/// Taken out of the environment: programs that this one starts have no Falcon.
std::string take_variable(const char* name) {
    const char* const value = std::getenv(name);
    std::string text = value == nullptr ? "" : value;
    unsetenv(name);
    return text;
}

[[gnu::constructor]] void start() {
    const std::string units = take_variable("FALCON_UNITS");
    const std::string socket = take_variable("FALCON_SOCKET");
    std::istringstream commands(take_variable("FALCON_COMMANDS"));
    if (units.empty()) return;
    // Signals are for the program's own threads.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
        auto* const preloaded = new PreloadedUnits(units);
        for (std::string line; std::getline(commands, line);) {
            const std::string answer = preloaded->answer(line);
            if (answer != "ok") std::cerr << "falcon_preload: " << line << ": " << answer << '\n';
        }
        // Serves to the very end of the process, past every destructor.
        static_cast<void>(new LineServer(
            socket, [preloaded](const std::string& line) { return preloaded->answer(line); }));
    } catch (const std::exception& problem) {
        std::cerr << "falcon_preload: " << problem.what() << '\n';
        std::exit(EXIT_FAILURE);
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

}  // namespace dibhr::test::falcon
