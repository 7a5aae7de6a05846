// Reads and writes the regions of a recording: label pictures and a table of names, beside its
// depth.
#pragma once

#include <filesystem>
#include <memory>

#include "core/video/guide/regions.hpp"

namespace dibhr {

/// The regions of NAME_regions.toml, with the label pictures NAME_regions.png, beside a recording
/// whose depth has columns x rows; null: there is no such table. Throws InputError: which file, and
/// what to do.
[[nodiscard]] std::shared_ptr<const Regions> read_regions(const std::filesystem::path& depth,
                                                          int columns, int rows);

/// Writes both files beside the depth, each whole or not at all; where the table cannot be written
/// the picture is the old one again. Null: removes them. Throws InputError; also for a picture
/// without a table, which is not replaced.
void write_regions(const Regions* regions, const std::filesystem::path& depth);

}  // namespace dibhr
