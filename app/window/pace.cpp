// Waits between pictures.
#include "app/window/pace.hpp"

#include <algorithm>
#include <thread>

namespace dibhr {

void PicturePace::wait() {
    if (next_ == Clock::time_point{}) next_ = second_begin_ = Clock::now();
    next_ = std::max(next_ + shortest_, Clock::now());
    std::this_thread::sleep_until(next_);
    ++pictures_;
    const double age_s = std::chrono::duration<double>(Clock::now() - second_begin_).count();
    if (age_s < 1.0) return;
    pictures_per_s_ = pictures_ / age_s;
    pictures_ = 0;
    second_begin_ = Clock::now();
}

}  // namespace dibhr
