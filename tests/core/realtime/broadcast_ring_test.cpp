// The ring with many listeners: each gets every value for which it is in time.
#include "core/realtime/broadcast_ring.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

struct Copied {
    std::uint64_t number{0};
    std::array<std::uint64_t, 4> copies{};
};

using Ring = BroadcastRing<Copied, 64>;

Copied copied(std::uint64_t n) {
    Copied value;
    value.number = n;
    value.copies.fill(n);
    return value;
}

std::vector<std::uint64_t> all_of(Ring::Listener& listener) {
    std::vector<std::uint64_t> numbers;
    for (Copied value; listener.pop(value);) numbers.push_back(value.number);
    return numbers;
}

}  // namespace

TEST_CASE("every listener hears each value that comes after it, in order", "[ring]") {
    Ring ring;
    Ring::Listener early(ring);
    CHECK(all_of(early).empty());
    ring.push(copied(1));
    Ring::Listener late(ring);
    ring.push(copied(2));
    ring.push(copied(3));
    CHECK(all_of(early) == std::vector<std::uint64_t>{1, 2, 3});
    CHECK(all_of(late) == std::vector<std::uint64_t>{2, 3});
    ring.push(copied(4));
    CHECK(all_of(late) == std::vector<std::uint64_t>{4});
    CHECK(all_of(early) == std::vector<std::uint64_t>{4});
}

TEST_CASE("a listener that was away goes on with newer values and counts what it missed",
          "[ring]") {
    Ring ring;
    Ring::Listener away(ring);
    for (std::uint64_t n = 1; n <= 1000; ++n) ring.push(copied(n));
    const auto heard = all_of(away);
    REQUIRE(heard.size() >= 32);
    CHECK(heard.back() == 1000);
    CHECK(away.missed() + heard.size() == 1000);
}

TEST_CASE("a producer waits for no listener, and no value comes torn, twice or before another",
          "[ring]") {
    constexpr std::uint64_t kCount = 100'000;
    Ring ring;
    std::array<std::uint64_t, 3> wrong{};
    std::atomic<int> ready{0};
    std::vector<std::thread> listeners;
    listeners.reserve(wrong.size());
    for (std::uint64_t& found : wrong) {
        listeners.emplace_back([&ring, &found, &ready] {
            Ring::Listener listener(ring);
            ++ready;
            std::uint64_t last = 0;
            std::uint64_t received = 0;
            while (last != kCount) {
                Copied value;
                if (!listener.pop(value)) {
                    std::this_thread::yield();
                    continue;
                }
                const bool torn =
                    std::any_of(value.copies.begin(), value.copies.end(),
                                [&value](std::uint64_t copy) { return copy != value.number; });
                if (torn || value.number <= last) ++found;
                last = value.number;
                ++received;
            }
            if (received + listener.missed() != kCount) ++found;
        });
    }
    while (ready != 3) std::this_thread::yield();
    for (std::uint64_t n = 1; n <= kCount; ++n) {
        ring.push(copied(n));
        if (n % 100 == 0) std::this_thread::yield();
    }
    for (std::thread& listener : listeners) listener.join();
    CHECK(wrong == std::array<std::uint64_t, 3>{});
}
