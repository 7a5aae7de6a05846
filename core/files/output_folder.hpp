// A command's files in their folder: all of them, or none.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/output_file.hpp"

namespace dibhr {

/// Files of an earlier run are replaced at commit(). Without commit() nothing remains: the folder
/// is as it was, or was never made. Other files stay. Everything that writes throws InputError:
/// what, which file, what to do next.
class OutputFolder {
  public:
    /// Makes the folder where it is missing, and tries whether it takes files. `names`: files of
    /// an earlier run that go at commit() when this one has none of that name.
    explicit OutputFolder(const std::filesystem::path& folder, std::vector<std::string> names = {});
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// A name that was added before is left as it is.
    void add(const std::string& name, std::string_view bytes);
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
