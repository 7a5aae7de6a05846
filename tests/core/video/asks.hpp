// Whether an opening asks which meaning is right.
#pragma once

namespace dibhr::test {

/// Whether the description of a media offers alternatives. One that has no such member never does.
template <typename Description>
[[nodiscard]] bool asks([[maybe_unused]] const Description& media) {
    if constexpr (requires { media.alternatives.empty(); })
        return !media.alternatives.empty();
    else
        return false;
}

}  // namespace dibhr::test
