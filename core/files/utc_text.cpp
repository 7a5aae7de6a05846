// The wall time as text.
#include "core/files/utc_text.hpp"

#include <array>
#include <ctime>

namespace dibhr {

std::string utc_text(double utc_s) {
    const auto moment = static_cast<std::time_t>(utc_s);
    std::tm utc{};
    gmtime_r(&moment, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text.data();
}

}  // namespace dibhr
