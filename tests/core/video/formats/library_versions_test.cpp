// Which libraries decode.
#include "core/video/formats/libraries.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("every library that turns files into depth levels has a version of three numbers",
          "[video]") {
    const auto versions = library_versions();
    for (const char* library :
         {"libavcodec", "libavformat", "libheif", "libswscale", "libzip", "opencv", "openexr"}) {
        CAPTURE(library);
        const std::string& version = versions.at(library);
        CAPTURE(version);
        CHECK(std::count(version.begin(), version.end(), '.') >= 2);
        CHECK(std::isdigit(static_cast<unsigned char>(version.front())) != 0);
    }
}
