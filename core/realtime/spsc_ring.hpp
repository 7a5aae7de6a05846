// Every value counts: single-producer single-consumer ring, wait-free, full = dropped and counted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace dibhr {

template <typename T, std::size_t N>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(N > 1 && (N & (N - 1)) == 0, "a power of two");

  public:
    /// Producer only. False when full: the value is dropped and counted.
    bool push(const T& value) noexcept {
        const auto w = write_.load(std::memory_order_relaxed);
        if (w - read_.load(std::memory_order_acquire) == N) {
            dropped_.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
        slots_[w & (N - 1)] = value;
        write_.store(w + 1, std::memory_order_release);
        return true;
    }

    /// Consumer only. False when empty.
    [[nodiscard]] bool pop(T& value) noexcept {
        const auto r = read_.load(std::memory_order_relaxed);
        if (write_.load(std::memory_order_acquire) == r) return false;
        value = slots_[r & (N - 1)];
        read_.store(r + 1, std::memory_order_release);
        return true;
    }

    /// Number of values in the ring: an upper bound for the producer, a lower one for the consumer.
    [[nodiscard]] std::uint64_t size() const noexcept {
        const auto r = read_.load(std::memory_order_acquire);
        return write_.load(std::memory_order_acquire) - r;
    }
    [[nodiscard]] static constexpr std::uint64_t room() noexcept { return N; }

    /// Any thread.
    [[nodiscard]] std::uint64_t dropped() const noexcept {
        return dropped_.load(std::memory_order_relaxed);
    }

  private:
    std::array<T, N> slots_{};
    alignas(64) std::atomic<std::uint64_t> write_{0};  // the producer's
    alignas(64) std::atomic<std::uint64_t> dropped_{0};
    alignas(64) std::atomic<std::uint64_t> read_{0};  // the consumer's
};

}  // namespace dibhr
