// The compiled part of the Python package; its public interface is in dibhr/*.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

#include "core/error.hpp"
#include "core/haptics/parameters.hpp"

namespace dibhr {

/// A thread called a renderer that another thread is using.
class BusyError : public Error {
  public:
    using Error::Error;
};

/// Python's keyword of an option: static_friction for "static-friction".
[[nodiscard]] pybind11::str keyword_of(std::string_view name);

void bind_touch(pybind11::module_& module);
void bind_session(pybind11::module_& module);

}  // namespace dibhr
