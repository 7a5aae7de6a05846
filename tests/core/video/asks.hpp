// Whether an opening asks which meaning is right.
#pragma once

#include "core/video/sources/media.hpp"

namespace dibhr::test {

/// Whether the description of a media offers alternatives.
[[nodiscard]] inline bool asks(const MediaDescription& media) {
    return !media.conclusion.alternatives.empty();
}

}  // namespace dibhr::test
