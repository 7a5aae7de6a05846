// What can be read of a damaged session. The file stays as it is.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "core/sqlite/database.hpp"

namespace dibhr {

/// The session's tables with the rows of every page that is whole, in a database of their own that
/// goes with this object. No row was made up, and no surface is among them of which a part that
/// would not be missed is lost.
struct RescuedTables {
    std::unique_ptr<Database> database{};
    std::set<std::string> incomplete{};  ///< names of tables that lack rows, or may
};

/// `with_log`: the log beside the file belongs to it. Where the first page is damaged, the file is
/// taken for one of this schema. Errors go to `refuse`.
[[nodiscard]] RescuedTables rescued_tables(const std::filesystem::path& file, bool with_log,
                                           const Database::ErrorHandler& refuse);

/// What is missing: "312 of 6000 ticks cannot be read (from 3.2 s to 3.4 s)". `database` has the
/// tables of this schema; `incomplete` are those of RescuedTables.
[[nodiscard]] std::string loss_text(const Database& database,
                                    const std::set<std::string>& incomplete);

}  // namespace dibhr
