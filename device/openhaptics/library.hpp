// Loads 3D Systems' HD library, and keeps what a call of it does to the program in bounds.
#pragma once

#include <memory>
#include <string>

#include "device/openhaptics/hd.hpp"

namespace dibhr::openhaptics {

struct LoadedLibrary {
    HdLibrary functions{};
    bool loaded{false};     ///< `functions` can be called
    std::string file{};     ///< of the library
    std::string trouble{};  ///< why the installed one cannot be used, and the next step
};

/// Loads the library, which then stays loaded. `chosen`: a file or a folder; empty: where
/// OpenHaptics installs it. Not loaded, and without a trouble: none is installed.
[[nodiscard]] LoadedLibrary load_hd_library(const std::string& chosen);

/// Around a call that opens a device. While it exists, the calling thread's decimal point is a
/// point, and what the program prints to standard output is kept from it, for a second at most. At
/// its end that text goes to standard error.
class OpeningCall {
  public:
    /// `printed`: the text of the last call. The same text is not printed again, because a library
    /// prints the same whenever it opens a device.
    explicit OpeningCall(std::string& printed);
    ~OpeningCall();
    OpeningCall(const OpeningCall&) = delete;
    OpeningCall& operator=(const OpeningCall&) = delete;

  private:
    class Output;
    class DecimalPoint;
    std::unique_ptr<DecimalPoint> point_;
    std::unique_ptr<Output> output_;
};

}  // namespace dibhr::openhaptics
