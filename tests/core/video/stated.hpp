// What the findings of a source, or of a picture that was read, state about depth.
#pragma once

#include "core/video/depth/findings.hpp"

namespace dibhr::test {

template <typename Read>
[[nodiscard]] DepthStatement stated_by(const Read& read) {
    return sure_facts({}, read.findings);
}

}  // namespace dibhr::test
