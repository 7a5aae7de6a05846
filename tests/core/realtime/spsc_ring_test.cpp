// The ring: every value in order, and a count of those that found no room.
#include "core/realtime/spsc_ring.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>

#include "tests/support/catch.hpp"

namespace {

using dibhr::SpscRing;

struct Numbered {
    std::uint64_t number{0};
    std::array<std::uint64_t, 8> copies{};
};

Numbered numbered(std::uint64_t n) {
    Numbered value;
    value.number = n;
    value.copies.fill(n);
    return value;
}

bool whole(const Numbered& value) {
    for (const auto copy : value.copies) {
        if (copy != value.number) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("an empty ring gives nothing", "[ring]") {
    SpscRing<int, 4> ring;
    int value = 7;
    CHECK_FALSE(ring.pop(value));
    CHECK(value == 7);
}

TEST_CASE("a ring holds as many values as its size, in order, again and again", "[ring]") {
    SpscRing<int, 8> ring;
    for (int round = 0; round < 5; ++round) {
        for (int k = 0; k < 8; ++k) REQUIRE(ring.push(10 * round + k));
        for (int k = 0; k < 8; ++k) {
            int value = -1;
            REQUIRE(ring.pop(value));
            CHECK(value == 10 * round + k);
        }
    }
    CHECK(ring.dropped() == 0);
}

TEST_CASE("a full ring drops the new value, counts it, and keeps the old ones", "[ring]") {
    SpscRing<int, 4> ring;
    for (int k = 0; k < 4; ++k) REQUIRE(ring.push(k));
    CHECK_FALSE(ring.push(4));
    CHECK_FALSE(ring.push(5));
    CHECK(ring.dropped() == 2);
    int value = -1;
    REQUIRE(ring.pop(value));
    CHECK(value == 0);
    CHECK(ring.push(6));
    CHECK(ring.dropped() == 2);
}

TEST_CASE("between two threads the ring keeps order, tears nothing, and loses only what it counts",
          "[ring]") {
    constexpr std::uint64_t kCount = 100000;
    SpscRing<Numbered, 64> ring;
    std::thread producer([&] {
        for (std::uint64_t n = 1; n <= kCount; ++n) {
            ring.push(numbered(n));
            if (n % 48 == 0) std::this_thread::yield();
        }
        while (!ring.push(numbered(kCount + 1))) std::this_thread::yield();
    });
    std::uint64_t last = 0;
    std::uint64_t received = 0;
    int torn = 0;
    int disordered = 0;
    while (last != kCount + 1) {
        Numbered value;
        if (!ring.pop(value)) {
            std::this_thread::yield();
            continue;
        }
        ++received;
        if (!whole(value)) ++torn;
        if (value.number <= last) ++disordered;
        last = value.number;
    }
    producer.join();
    CHECK(torn == 0);
    CHECK(disordered == 0);
    // The closing value may have been refused, and counted, several times before it went in.
    CHECK(received + ring.dropped() >= kCount + 1);
    CHECK(received <= kCount + 1);
}

TEST_CASE("a consumer that keeps up receives every value", "[ring]") {
    constexpr std::uint64_t kCount = 50000;
    SpscRing<Numbered, 64> ring;
    std::thread producer([&] {
        for (std::uint64_t n = 1; n <= kCount; ++n) {
            while (!ring.push(numbered(n))) std::this_thread::yield();
        }
    });
    std::uint64_t expected = 1;
    std::uint64_t wrong = 0;
    while (expected <= kCount) {
        Numbered value;
        if (!ring.pop(value)) {
            std::this_thread::yield();
            continue;
        }
        if (value.number != expected) ++wrong;
        ++expected;
    }
    producer.join();
    CHECK(wrong == 0);
}

TEST_CASE("a ring says how many values wait in it", "[ring]") {
    SpscRing<Numbered, 4> ring;
    CHECK(ring.size() == 0);
    for (std::uint64_t n = 1; n <= 6; ++n) {
        (void)ring.push(numbered(n));
        CHECK(ring.size() == std::min<std::uint64_t>(n, ring.room()));
    }
    Numbered value;
    REQUIRE(ring.pop(value));
    CHECK(ring.size() == 3);
    CHECK(ring.dropped() == 2);
}
