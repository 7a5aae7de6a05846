// Mean and deviation of levels, added one by one; inside the room.
#pragma once

#include <algorithm>
#include <cmath>

namespace dibhr {

struct Mean {
    double sum{0.0};
    double squares{0.0};
    double count{0.0};

    void add(double level) {
        sum += level;
        squares += level * level;
        count += 1.0;
    }
    [[nodiscard]] double value() const { return sum / count; }
    [[nodiscard]] double deviation() const {
        return std::sqrt(std::max(squares / count - value() * value(), 0.0));
    }
};

}  // namespace dibhr
