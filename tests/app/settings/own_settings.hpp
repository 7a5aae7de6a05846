// One kind's settings among those of all force devices.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "app/settings/settings.hpp"

namespace dibhr::test {

template <typename Own>
[[nodiscard]] Own& own_settings(Settings& settings) {
    for (std::size_t k = 0; k < settings.devices.size(); ++k)
        if (auto* const own = dynamic_cast<Own*>(&settings.devices[k])) return *own;
    throw std::logic_error("no force device has these settings");
}

}  // namespace dibhr::test
