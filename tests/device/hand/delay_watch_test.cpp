// How long a device takes to answer lately.
#include "device/hand/delay_watch.hpp"

#include <chrono>

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// Exchanges one after the other, each of which takes so long, for a time.
struct Exchanges {
    DelayWatch watch{};
    DelayWatch::Time now{};

    int come(microseconds each, milliseconds span) {
        for (const auto end = now + span; now < end;) {
            watch.add(now, now + each);
            now += each + microseconds(500);
        }
        return watch.within_ms();
    }
};

}  // namespace

TEST_CASE("answers that come later count at once, ones that come sooner after a second",
          "[device]") {
    Exchanges exchanges;
    CHECK(exchanges.come(microseconds(900), milliseconds(1000)) == 1);
    CHECK(exchanges.come(microseconds(1500), milliseconds(300)) == 2);
    CHECK(exchanges.come(microseconds(3900), milliseconds(1000)) == 4);
    CHECK(exchanges.come(microseconds(8000), milliseconds(400)) > 5);
    CHECK(exchanges.watch.mean_ms() > 5.0);
    const int worst = exchanges.watch.within_ms();
    CHECK(exchanges.come(microseconds(500), milliseconds(900)) == worst);
    CHECK(exchanges.come(microseconds(500), milliseconds(3000)) == 1);
}

TEST_CASE("answers at the edge of a millisecond do not change it to and fro", "[device]") {
    Exchanges exchanges;
    (void)exchanges.come(microseconds(4500), milliseconds(1000));
    CHECK(exchanges.come(microseconds(3500), milliseconds(5000)) == 5);
}

TEST_CASE("one answer that comes late among prompt ones counts for two milliseconds at most",
          "[device]") {
    Exchanges exchanges;
    (void)exchanges.come(microseconds(500), milliseconds(500));
    const auto late =
        GENERATE(microseconds(15'000), microseconds(100'000), microseconds(1'000'000));
    CHECK(exchanges.come(late, milliseconds(1)) <= 2);
}
