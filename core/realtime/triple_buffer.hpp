// Newest value wins, wait-free at both ends: one writing thread, one reading thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace dibhr {

/// The writer fills `back()` and calls `publish()`; the reader takes `front()`, valid until its
/// next `front()`. What a slot owns is only ever freed by the writer, so a reader may be a haptic
/// thread.
template <typename T>
class TripleBuffer {
  public:
    /// Writer only: the slot to fill. It holds an old value.
    [[nodiscard]] T& back() noexcept { return slots_[back_]; }

    /// Writer only.
    void publish() noexcept {
        back_ =
            middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) &
            kIndex;
    }
    void publish(const T& value) {
        back() = value;
        publish();
    }

    /// Reader only: the newest published value.
    [[nodiscard]] const T& front() noexcept {
        if (fresh()) front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
        return slots_[front_];
    }

    /// Reader only: whether `front()` will return a new value.
    [[nodiscard]] bool fresh() const noexcept {
        return (middle_.load(std::memory_order_relaxed) & kFresh) != 0;
    }

  private:
    static constexpr std::uint8_t kFresh = 4;
    static constexpr std::uint8_t kIndex = 3;

    std::array<T, 3> slots_{};
    alignas(64) std::uint8_t back_{0};  // the writer's
    alignas(64) std::atomic<std::uint8_t> middle_{1};
    alignas(64) std::uint8_t front_{2};  // the reader's
};

}  // namespace dibhr
