// A temporary folder of the program's own.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// A new folder in the system's folder for temporary files; the destructor removes it with all in
/// it.
class ScratchFolder {
  public:
    /// `purpose`: what is done in it, for the message. Throws InputError when it cannot be made.
    explicit ScratchFolder(const std::string& purpose);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace dibhr
