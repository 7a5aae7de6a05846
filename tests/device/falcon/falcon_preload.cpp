// Preloaded into an unmodified program by falcon_host: what the program does with /dev/bus/usb is
// done by the host. FALCON_SOCKET, set by the host: where it listens.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "tests/device/falcon/usbfs_client.hpp"

namespace dibhr::test::falcon {

namespace {

[[gnu::constructor]] void start() {
    const char* const value = std::getenv("FALCON_SOCKET");
    if (value == nullptr) return;
    const std::string socket = value;
    unsetenv("FALCON_SOCKET");  // programs that this one starts have no Falcon
    try {
        // To the very end of the process, past every destructor.
        answer_with(*new UsbfsClient(socket));
    } catch (const std::exception& problem) {
        std::cerr << "falcon_preload: " << problem.what() << '\n';
        std::exit(EXIT_FAILURE);
    }
}

}  // namespace

}  // namespace dibhr::test::falcon
