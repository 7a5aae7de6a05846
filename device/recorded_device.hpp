// What `dibhr devices --record` and `--simulate` do with a device: its stages for 10 seconds.
#pragma once

#include <filesystem>

#include "device/force_device.hpp"

namespace dibhr {

/// Prints the sentence of every stage, while the device's library is recorded.
void record_device(ForceDevice& device, const std::filesystem::path& file, const PrintLine& print);

/// Prints the sentence of every stage of a device of this kind, whose library is a record.
void play_device(ForceDevice& device, const std::filesystem::path& record, const char* kind,
                 const PrintLine& print);

}  // namespace dibhr
