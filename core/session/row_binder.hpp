// Binds the cells of a row, each in its shortest form that gives the same bits again.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "core/session/database.hpp"
#include "core/session/same_bits.hpp"

namespace dibhr {

/// A time in nanoseconds, of which its unit has `nanoseconds`, where the same bits come of them.
[[nodiscard]] inline std::optional<std::int64_t> whole_nanoseconds(double value,
                                                                   double nanoseconds) {
    constexpr double kMost = 9e15;  // beyond, a real has no whole nanoseconds
    const double count = std::round(value * nanoseconds);
    const auto whole = std::abs(count) < kMost ? static_cast<std::int64_t>(count) : 0;
    if (!same_bits(static_cast<double>(whole) / nanoseconds, value)) return std::nullopt;
    return whole;
}

/// What of it is recorded: a database has no such thing as "no number".
[[nodiscard]] inline double recordable(double value) noexcept {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

/// One value after the other. Columns without a type keep them as they are bound.
class RowBinder {
  public:
    explicit RowBinder(Statement& statement) : statement_(statement) {}

    void null() { statement_.bind_null(++parameter_); }
    void text(std::string_view value) { statement_.bind(++parameter_, value); }
    void integer(std::int64_t value) { statement_.bind(++parameter_, value); }
    void reference(std::int64_t row) { row == 0 ? null() : integer(row); }

    void real(double value) {
        constexpr double kShortest = 1e9;  // in five bytes instead of eight
        const auto whole = std::abs(value) < kShortest ? static_cast<std::int64_t>(value) : 0;
        if (same_bits(static_cast<double>(whole), value)) {
            integer(whole);
        } else {
            plain_real(value);
        }
    }

    /// Also a whole number as a real, where an integer means something else.
    void plain_real(double value) { statement_.bind(++parameter_, recordable(value)); }

    /// A time as whole nanoseconds, of which a unit has `nanoseconds`.
    void time(double value, double nanoseconds) {
        const auto whole = whole_nanoseconds(value, nanoseconds);
        whole ? integer(*whole) : plain_real(value);
    }

    /// Nothing where it equals what the view takes instead.
    void real_unless(double value, double follows) {
        same_bits(recordable(value), follows) ? null() : real(value);
    }
    void integer_unless(std::int64_t value, std::optional<std::int64_t> follows) {
        value == follows ? null() : integer(value);
    }

  private:
    Statement& statement_;
    int parameter_{0};
};

}  // namespace dibhr
