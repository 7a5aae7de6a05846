// The versions of the libraries that decode media: another version may give other levels.
#pragma once

#include <string>

namespace dibhr {

/// "libavcodec 59.37.100; ...", in the order of their names.
[[nodiscard]] std::string reading_versions();

}  // namespace dibhr
