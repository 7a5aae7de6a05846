// The triple buffer: newest value wins, whole, wait-free, freed by the writer alone.
#include "core/realtime/triple_buffer.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>

#include "tests/support/catch.hpp"

namespace {

using dibhr::TripleBuffer;

/// Larger than a cache line, so that a torn one would show.
struct Sample {
    std::array<std::uint64_t, 32> words{};

    void fill(std::uint64_t value) { words.fill(value); }
    [[nodiscard]] bool whole() const {
        for (const auto word : words) {
            if (word != words[0]) return false;
        }
        return true;
    }
};

/// Checks that it is destroyed on the right thread.
class Owned {
  public:
    Owned(std::thread::id owner, std::atomic<int>& freed_elsewhere)
        : owner_(owner), freed_elsewhere_(freed_elsewhere) {}
    ~Owned() {
        if (std::this_thread::get_id() != owner_) ++freed_elsewhere_;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;

  private:
    std::thread::id owner_;
    std::atomic<int>& freed_elsewhere_;
};

}  // namespace

TEST_CASE("a triple buffer gives its initial value until something is published",
          "[triple buffer]") {
    TripleBuffer<int> buffer;
    CHECK_FALSE(buffer.fresh());
    CHECK(buffer.front() == 0);
    buffer.back() = 5;
    CHECK(buffer.front() == 0);
    buffer.publish();
    CHECK(buffer.fresh());
    CHECK(buffer.front() == 5);
    CHECK_FALSE(buffer.fresh());
    CHECK(buffer.front() == 5);
}

TEST_CASE("the reader skips to the newest of several published values", "[triple buffer]") {
    TripleBuffer<int> buffer;
    for (int k = 1; k <= 10; ++k) buffer.publish(k);
    CHECK(buffer.front() == 10);
    CHECK_FALSE(buffer.fresh());
}

TEST_CASE("what the reader holds does not change while the writer goes on", "[triple buffer]") {
    TripleBuffer<int> buffer;
    buffer.publish(1);
    const int& held = buffer.front();
    for (int k = 2; k <= 10; ++k) {
        buffer.publish(k);
        CHECK(held == 1);
    }
}

TEST_CASE("between two threads nothing is torn, nothing goes back, and the last value arrives",
          "[triple buffer]") {
    constexpr std::uint64_t kLast = 50000;
    TripleBuffer<Sample> buffer;
    std::thread writer([&] {
        for (std::uint64_t k = 1; k <= kLast; ++k) {
            buffer.back().fill(k);
            buffer.publish();
            if (k % 512 == 0) std::this_thread::yield();
        }
    });
    std::uint64_t newest = 0;
    int torn = 0;
    int went_back = 0;
    while (newest < kLast) {
        const Sample& sample = buffer.front();
        if (!sample.whole()) ++torn;
        if (sample.words[0] < newest) ++went_back;
        newest = sample.words[0];
        if (!buffer.fresh()) std::this_thread::yield();
    }
    writer.join();
    CHECK(torn == 0);
    CHECK(went_back == 0);
    CHECK(buffer.front().words[31] == kLast);
}

TEST_CASE("what a slot owns is freed on the writer's thread only", "[triple buffer]") {
    constexpr int kCount = 5000;
    std::atomic<int> freed_elsewhere{0};
    std::atomic<bool> reading{true};
    std::atomic<int> taken{0};
    std::thread writer([&] {
        const auto self = std::this_thread::get_id();
        TripleBuffer<std::shared_ptr<Owned>> buffer;
        std::thread reader([&] {
            const Owned* last = nullptr;
            while (reading) {
                const Owned* now = buffer.front().get();
                if (now != last) ++taken;
                last = now;
                std::this_thread::yield();
            }
        });
        for (int k = 0; k < kCount || taken == 0; ++k) {
            buffer.publish(std::make_shared<Owned>(self, freed_elsewhere));
            if (k % 64 == 0) std::this_thread::yield();
        }
        reading = false;
        reader.join();
    });
    writer.join();
    CHECK(taken > 0);
    CHECK(freed_elsewhere == 0);
}
