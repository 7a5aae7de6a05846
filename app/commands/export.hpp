// `dibhr export`: every tick of a session, one row.
#pragma once

#include <filesystem>

namespace dibhr {

struct ExportOptions {
    std::filesystem::path session{};
    std::filesystem::path csv{"-"};  ///< "-": standard output
};

/// The output rows' columns first, then what else a tick holds, by the names of the session's view
/// `tick`. The file appears whole or not at all. The exit code; throws InputError.
int run_export(const ExportOptions& options);

}  // namespace dibhr
