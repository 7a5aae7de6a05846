// A folder for the files of a test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr::test {

/// A new folder, empty at first, with a name of its own however many tests run at once; removed
/// with all in it by the destructor, even when the test has taken the rights to it away.
class TemporaryFolder {
  public:
    TemporaryFolder();  ///< Throws std::system_error.
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }

  private:
    std::filesystem::path path_{};
};

/// Names of what is in a folder, sorted.
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace dibhr::test
