// That a place holds colour alone.
#pragma once

#include "core/error.hpp"

namespace dibhr {

/// There is colour, and no depth in it or beside it.
class DepthMissing : public InputError {
  public:
    using InputError::InputError;
};

}  // namespace dibhr
