// A record of what OpenHaptics' library was asked and answered.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "device/openhaptics/library.hpp"

namespace dibhr::openhaptics {

/// For ConnectionOptions::around: the library, and a line of the record for each of its calls. What
/// the servo thread reads again and again has a line when it changes. The file is whole when that
/// is destroyed. Throws InputError when it cannot be written.
[[nodiscard]] std::function<HdLibrary(const HdLibrary&)> recording_in(
    const std::filesystem::path& file, const std::string& library);

/// The file exists and begins as a record does.
[[nodiscard]] bool is_record(const std::filesystem::path& file);

/// A library with a servo thread of its own, which answers what the record has at this time, and
/// after its end what it has at its end. The time begins with the first opening.
[[nodiscard]] LoadedLibrary play_record(const std::filesystem::path& file);

}  // namespace dibhr::openhaptics
