// The pages of an archive that say what it is.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/archive/archive.hpp"

namespace dibhr {

/// Writes dataset_description.json, README.md and the table of participants. `participants`: names
/// by labels. Throws InputError.
void write_pages(const std::filesystem::path& archive, const ArchiveRequest& request,
                 const ArchiveSummary& summary,
                 const std::map<std::string, std::string>& participants);

}  // namespace dibhr
