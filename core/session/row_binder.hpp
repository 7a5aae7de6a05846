// Binds the cells of a row, each in its shortest form that gives the same bits again.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "core/session/database.hpp"
#include "core/session/same_bits.hpp"

namespace dibhr {

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
        const double finite = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
        const auto whole = std::abs(finite) < kShortest ? static_cast<std::int64_t>(finite) : 0;
        if (same_bits(static_cast<double>(whole), finite)) {
            integer(whole);
        } else {
            statement_.bind(++parameter_, finite);
        }
    }

    /// A time as whole nanoseconds, of which a unit has `nanoseconds`.
    void time(double value, double nanoseconds) {
        constexpr double kMost = 9e15;  // beyond, a real has no whole nanoseconds
        const double count = std::round(value * nanoseconds);
        const auto whole = std::abs(count) < kMost ? static_cast<std::int64_t>(count) : 0;
        if (same_bits(static_cast<double>(whole) / nanoseconds, value)) {
            integer(whole);
        } else {
            statement_.bind(++parameter_, value);
        }
    }

    /// Nothing where it equals what the view takes instead.
    void real_unless(double value, double follows) {
        same_bits(value, follows) ? null() : real(value);
    }

  private:
    Statement& statement_;
    int parameter_{0};
};

}  // namespace dibhr
