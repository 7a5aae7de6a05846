// The newest values for any number of listeners. The producer never waits for them, however
// many and however slow they are.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace dibhr {

/// Keeps the last N values. Wait-free for the producer. A listener that is too late loses values;
/// other listeners do not.
template <typename T, std::size_t N>
class BroadcastRing {
    static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);
    static_assert(sizeof(T) % sizeof(std::uint64_t) == 0, "made of whole words");
    static_assert(N > 1 && (N & (N - 1)) == 0, "a power of two");

  public:
    /// Producer only.
    void push(const T& value) noexcept {
        const auto words = std::bit_cast<Words>(value);
        const auto w = written_.load(std::memory_order_relaxed);
        Slot& slot = slots_[w & (N - 1)];
        // A reader that sees a word of this value also sees all words before it.
        for (std::size_t k = 0; k < kWords; ++k) slot[k].store(words[k], std::memory_order_release);
        written_.store(w + 1, std::memory_order_release);
    }

    /// One reader, which belongs to one thread at a time. The ring outlives it.
    class Listener {
      public:
        /// Reads what is pushed from now on.
        explicit Listener(const BroadcastRing& ring) noexcept
            : ring_(&ring), next_(ring.written_.load(std::memory_order_acquire)) {}

        /// The next value; after a pause of more than N values, one of the newer half of those
        /// kept. False when there is none.
        [[nodiscard]] bool pop(T& value) noexcept {
            for (;;) {
                const auto written = ring_->written_.load(std::memory_order_acquire);
                if (written == next_) return false;
                if (written - next_ >= N) skip_to(written - N / 2);
                Words words{};
                const Slot& slot = ring_->slots_[next_ & (N - 1)];
                for (std::size_t k = 0; k < kWords; ++k)
                    words[k] = slot[k].load(std::memory_order_acquire);
                // The producer may have reused the slot once this value is N behind.
                if (ring_->written_.load(std::memory_order_relaxed) - next_ >= N) continue;
                ++next_;
                value = std::bit_cast<T>(words);
                return true;
            }
        }

        /// How many values were overwritten before they were popped.
        [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }

      private:
        void skip_to(std::uint64_t number) noexcept {
            missed_ += number - next_;
            next_ = number;
        }

        const BroadcastRing* ring_;
        std::uint64_t next_;
        std::uint64_t missed_{0};
    };

  private:
    static constexpr std::size_t kWords = sizeof(T) / sizeof(std::uint64_t);
    using Words = std::array<std::uint64_t, kWords>;
    using Slot = std::array<std::atomic<std::uint64_t>, kWords>;

    std::array<Slot, N> slots_{};
    alignas(64) std::atomic<std::uint64_t> written_{0};
};

}  // namespace dibhr
