// A program that presses with an Inverse3 until its life ends in the way that its first argument
// names. Its second argument, a file, becomes the LastMoment just before; the third is the port of
// the service.
#include <cstdint>
#include <cstdlib>

#include "device/inverse3/inverse3_device.hpp"
#include "tests/device/pressing_life.hpp"
#include "tests/device/ticking_device.hpp"

int main(int count, char** words) {
    using namespace dibhr;
    if (count != 4) return EXIT_FAILURE;
    const auto port = static_cast<std::uint16_t>(std::atoi(words[3]));
    inverse3::ConnectionOptions options;
    options.port = options.older_port = port;
    test::TickingDevice<inverse3::Inverse3Device> loop(options);
    return test::Life(words[2], loop).end(words[1]) ? EXIT_SUCCESS : EXIT_FAILURE;
}
