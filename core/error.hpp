// The family of errors a person is told about: what, which file or device, what to do next.
#pragma once

#include <stdexcept>

namespace dibhr {

/// Its text is one plain line, ready for stderr or a message box.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file, a picture or a setting that cannot be used.
class InputError : public Error {
  public:
    using Error::Error;
};

/// A device that cannot be used.
class DeviceError : public Error {
  public:
    using Error::Error;
};

}  // namespace dibhr
