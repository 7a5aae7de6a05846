// The libraries that turn files into depth levels, as they are in this run of the program.
#pragma once

#include <map>
#include <string>

namespace dibhr {

/// Versions by name: "libavcodec", "libavformat", "libswscale" ("59.37.100"), "opencv" ("4.6.0").
/// Of the libraries that are loaded, not of those that the program was compiled against.
[[nodiscard]] std::map<std::string, std::string> library_versions();

}  // namespace dibhr
