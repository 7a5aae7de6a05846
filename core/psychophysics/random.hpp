// Random numbers that are the same on every platform and in every version of the program: the order
// of a study and its simulated participants depend on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>

namespace dibhr {

/// PCG32 (O'Neill 2014, XSH-RR): 2^63 streams of period 2^64. The standard distributions differ
/// between libraries; here a seed always gives the same numbers (`normal` up to the last bit of the
/// C library's `log`).
class Random {
  public:
    /// The same seed and stream give the same draws. Those of neighbouring seeds and streams begin
    /// alike: draws_for() does not.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) noexcept
        : increment_(stream << 1U | 1U) {
        bits();
        state_ += seed;
        bits();
    }

    /// 32 even bits.
    std::uint32_t bits() noexcept {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005U + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        const auto turn = static_cast<std::uint32_t>(old >> 59U);
        return shifted >> turn | shifted << ((32U - turn) & 31U);
    }

    /// In [0, 1), of 53 bits.
    double uniform() noexcept {
        const std::uint64_t high = bits() >> 5U;
        const std::uint64_t low = bits() >> 6U;
        return static_cast<double>(high << 26U | low) * 0x1p-53;
    }

    /// One of 0 .. count - 1, each as likely as the next. `count` > 0.
    std::uint32_t below(std::uint32_t count) noexcept;

    /// True with this probability.
    bool chance(double probability) noexcept { return uniform() < probability; }

    /// Mean 0, standard deviation 1 (Marsaglia's polar method, its second value left out: a draw
    /// depends on nothing but the state).
    double normal() noexcept;

    /// The number of successes in `trials` with this probability each.
    int binomial(int trials, double probability) noexcept;

    /// Every order as likely as the next (Fisher and Yates).
    template <typename Value>
    void shuffle(std::span<Value> values) noexcept {
        for (std::size_t left = values.size(); left > 1; --left) {
            std::swap(values[left - 1], values[below(static_cast<std::uint32_t>(left))]);
        }
    }

  private:
    std::uint64_t state_{0};
    std::uint64_t increment_;
};

/// Independent draws for every list of numbers. Streams of neighbouring numbers begin alike, so the
/// numbers are mixed first (SplitMix64's finaliser).
[[nodiscard]] inline Random draws_for(std::uint64_t seed,
                                      std::initializer_list<std::uint64_t> which) noexcept {
    std::uint64_t stream = 0;
    for (const std::uint64_t one : which) {
        stream = (stream ^ one) + 0x9e3779b97f4a7c15U;
        stream = (stream ^ (stream >> 30U)) * 0xbf58476d1ce4e5b9U;
        stream = (stream ^ (stream >> 27U)) * 0x94d049bb133111ebU;
        stream ^= stream >> 31U;
    }
    return Random(seed, stream);
}

}  // namespace dibhr
