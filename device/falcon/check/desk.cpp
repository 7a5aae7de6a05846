// The Falcon gets packets without force while the person thinks.
#include "device/falcon/check/desk.hpp"

#include <chrono>
#include <thread>

namespace dibhr::falcon {

namespace {

constexpr std::chrono::milliseconds kPause{10};  // the program never falls silent

}  // namespace

void CheckDesk::keep_talking() {
    if (falcon.answering()) {
        (void)falcon.exchange(no_force(Led::blue), kPause);
    } else {
        std::this_thread::sleep_for(kPause);
    }
}

}  // namespace dibhr::falcon
