// Where the files are that a session names.
#pragma once

#include <array>
#include <filesystem>

#include "core/session/tick_record.hpp"

namespace dibhr {

/// Where a file that was touched may be: in its recorded place, which in an archive is relative to
/// the session; and beside the session.
[[nodiscard]] std::array<std::filesystem::path, 2> places_of(const SessionMedia& media,
                                                             const std::filesystem::path& session);

}  // namespace dibhr
