// A report's files in their folder: all of them, or none.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/output_file.hpp"

namespace dibhr {

/// Files of an earlier report are replaced, or removed when this one has none of that name, at
/// commit(). Without commit() nothing remains: the folder is as it was, or was never made. Other
/// files stay. Everything that writes throws InputError: what, which file, what to do next.
class ReportFiles {
  public:
    /// Makes the folder where it is missing, and tries whether it takes files.
    /// `names`: every name that a report may have.
    ReportFiles(const std::filesystem::path& folder, std::vector<std::string> names);
    ~ReportFiles();
    ReportFiles(const ReportFiles&) = delete;
    ReportFiles& operator=(const ReportFiles&) = delete;

    /// `name` is one of the names, and new.
    void add(const std::string& name, std::string_view bytes);
    [[nodiscard]] bool has(const std::string& name) const { return added_.contains(name); }
    void commit();

  private:
    void make_folder();

    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::vector<std::filesystem::path> made_{};  ///< folders, the outermost first
    std::vector<std::unique_ptr<OutputFile>> files_{};
    std::set<std::string> added_{};
};

}  // namespace dibhr
