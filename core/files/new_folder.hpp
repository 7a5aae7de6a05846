// A folder that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// A folder that is filled beside the target and takes its name at commit(): it appears whole or
/// not at all. Every call throws InputError: what failed, which folder, what to do next.
class NewFolder {
  public:
    /// Refuses a target that is there, but for an empty folder.
    explicit NewFolder(const std::filesystem::path& target);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    /// What is filled until commit().
    [[nodiscard]] const std::filesystem::path& written() const noexcept { return temporary_; }
    void commit();

  private:
    [[noreturn]] void fail(int error) const;

    std::filesystem::path target_;
    std::filesystem::path temporary_{};  ///< empty after commit()
    int lock_{-1};
};

}  // namespace dibhr
