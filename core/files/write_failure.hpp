// Why something cannot be written, and what to do then.
#pragma once

#include <string>

namespace dibhr {

/// What to do about an error of errno: "choose a folder that you may write to". Fits files, folders
/// and streams.
[[nodiscard]] std::string step_after_failed_writing(int error);

/// "cannot be written (Permission denied); choose a folder that you may write to"; `what` failed.
[[nodiscard]] std::string write_failure(int error, const std::string& what = "cannot be written");

}  // namespace dibhr
