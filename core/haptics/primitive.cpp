// Names of primitives.
#include "core/haptics/primitive.hpp"

namespace dibhr {

const char* name_of(PrimitiveKind kind) noexcept {
    switch (kind) {
        case PrimitiveKind::triangle:
            return "triangle";
        case PrimitiveKind::edge:
            return "edge";
        case PrimitiveKind::vertex:
            return "vertex";
        case PrimitiveKind::none:
            break;
    }
    return "none";
}

}  // namespace dibhr
