// An output file that appears whole or not at all ("-" is standard output), and a folder of them.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace dibhr {

/// Whoever read standard output has enough: the program ends quietly.
struct OutputClosed {};

/// Waits until the disk has all that was written to an open file; false, and why in errno: it has
/// not. What has no disk (a pipe) has nothing to wait for.
[[nodiscard]] bool flushed(int file) noexcept;

/// The same of a folder, "" is the present one: what was made, renamed and removed in it.
[[nodiscard]] bool flushed_folder(const std::filesystem::path& folder) noexcept;

/// As create_directories(), but a power cut leaves them. Gives those that were made, the outermost
/// first.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder,
                                                std::error_code& failed);

/// What is written goes to a file beside the target, which takes the target's place at commit().
/// Without commit() nothing remains and an existing target stays as it was. After commit() a power
/// cut leaves the new one, before it the old one, however a library wrote to written(). What a
/// program that was killed left beside the target is removed, and that is told. A target that is no
/// ordinary file (a pipe, /dev/null) is written directly.
class OutputFile {
  public:
    /// Throws InputError when the target cannot be written.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Throws InputError, e.g. when the disk is full, and OutputClosed when the reading end is
    /// gone.
    void write(std::string_view bytes);

    /// Throws InputError when the target cannot be replaced.
    void commit();

    /// As commit(), but nothing is replaced: where a file of that name exists, the first free
    /// number is appended to it, "view-2.png". Gives the name. Throws InputError.
    std::filesystem::path commit_beside();

    /// Where it is written until commit(), for a library that opens files by name.
    [[nodiscard]] const std::filesystem::path& written() const noexcept {
        return temporary_.empty() ? target_ : temporary_;
    }

  private:
    void close();
    void take_name();
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path target_;
    std::filesystem::path temporary_{};  ///< empty when written directly
    int file_{-1};
    bool owned_{false};
};

/// Writes an OutputFile of these bytes and commits it. Throws as that does.
void write_file(const std::filesystem::path& target, std::string_view bytes);

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
    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::vector<std::filesystem::path> made_{};  ///< folders, the outermost first
    std::vector<std::unique_ptr<OutputFile>> files_{};
    std::set<std::string> added_{};
};

}  // namespace dibhr
