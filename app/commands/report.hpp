// `dibhr report`: what people touched in a recorded session, as pictures, a page and numbers.
#pragma once

#include <filesystem>

namespace dibhr {

struct ReportOptions {
    std::filesystem::path session{};
    std::filesystem::path out{};  ///< folder
};

/// Prints where the page of the report is; returns the exit code. Throws
/// InputError.
int run_report(const ReportOptions& options);

}  // namespace dibhr
