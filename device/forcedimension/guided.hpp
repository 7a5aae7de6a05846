// What `dibhr devices` does with an arm: initialises it after the user agreed, records what its
// library answers, and plays such a record.
#pragma once

#include <filesystem>

#include "device/force_device.hpp"
#include "device/forcedimension/status.hpp"

namespace dibhr::forcedimension {

/// Tells the user to keep hands clear, asks, and initialises the arm. Ctrl+C stops the arm. Throws
/// DeviceError when no arm can be used.
void initialise_arm(const ConnectionOptions& options, const PrintLine& print,
                    CheckConsole& console);

/// Records 10 seconds without force, from the search on. Throws DeviceError when there is no
/// library, InputError when the file cannot be written.
void record_arm(const ConnectionOptions& options, const std::filesystem::path& file,
                const PrintLine& print);

/// Plays a record as a device, and prints every stage. Throws DeviceError for a damaged record.
void play_arm(const std::filesystem::path& record, const PrintLine& print);

}  // namespace dibhr::forcedimension
