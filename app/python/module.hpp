// The compiled part of the Python package; what people call is in dibhr/*.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

#include "core/error.hpp"
#include "core/haptics/parameters.hpp"

namespace dibhr {

/// What one thread uses was asked for by another one.
class BusyError : public Error {
  public:
    using Error::Error;
};

/// "static-friction" is the keyword static_friction.
[[nodiscard]] pybind11::str keyword_of(std::string_view name);

void bind_touch(pybind11::module_& module);
void bind_session(pybind11::module_& module);

}  // namespace dibhr
