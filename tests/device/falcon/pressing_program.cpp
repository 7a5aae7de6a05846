// A program that presses with a Falcon until its life ends in the way that its first argument
// names. Its second argument, a file, becomes the LastMoment just before.
#include <cstdlib>

#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/pressing_life.hpp"

int main(int count, char** words) {
    if (count != 3) return EXIT_FAILURE;
    dibhr::test::falcon::TickingFalcon loop{dibhr::falcon::ConnectionOptions{}};
    return dibhr::test::Life(words[2], loop).end(words[1]) ? EXIT_SUCCESS : EXIT_FAILURE;
}
