// A record of what OpenHaptics' library was asked and answered.
#pragma once

#include <filesystem>
#include <memory>

#include "device/call_record.hpp"
#include "device/openhaptics/library.hpp"

namespace dibhr::openhaptics {

/// Throws InputError when the file cannot be written.
[[nodiscard]] std::shared_ptr<CallRecorder> make_recorder(const std::filesystem::path& file,
                                                          const std::string& library);

/// The library, and a line of the record for each of its calls. What the servo thread reads again
/// and again has a line when it changes.
[[nodiscard]] HdLibrary recorded(const HdLibrary& library,
                                 const std::shared_ptr<CallRecorder>& recorder);

/// The file exists and begins as a record does.
[[nodiscard]] bool is_record(const std::filesystem::path& file);

/// A library with a servo thread of its own, which answers what the record has at this time, and
/// after its end what it has at its end. The time begins with the first opening.
[[nodiscard]] LoadedLibrary play_record(const std::filesystem::path& file);

}  // namespace dibhr::openhaptics
