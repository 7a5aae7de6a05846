// As text.
#include "core/video/sources/reading_versions.hpp"

#include "core/video/formats/libraries.hpp"

namespace dibhr {

std::string reading_versions() {
    std::string text;
    for (const auto& [library, version] : library_versions())
        text.append(text.empty() ? "" : "; ").append(library).append(" ").append(version);
    return text;
}

}  // namespace dibhr
