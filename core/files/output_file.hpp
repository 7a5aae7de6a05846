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

/// Thrown when the reader of standard output has closed it: the program ends without a message.
struct OutputClosed {};

/// Waits until all that was written to an open file is on the disk. False: it is not, errno has the
/// reason. True at once for a file without a disk (a pipe).
[[nodiscard]] bool flush_to_disk(int file) noexcept;

/// The same for what was made, renamed and removed in a folder; "" is the present one.
[[nodiscard]] bool flush_folder(const std::filesystem::path& folder) noexcept;

/// As create_directories(), and the folders survive a power cut. Returns those that were made, the
/// outermost first.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder,
                                                std::error_code& failed);

/// Writes to a file beside the target, which takes the target's place at commit(). Without commit()
/// nothing remains and an existing target stays as it was. After a power cut there is the old
/// target before commit(), the new one after it, also where a library wrote to written().
/// Unfinished files of killed programs beside the target are removed, with a warning. A target that
/// is no ordinary file (a pipe, /dev/null) is written directly.
class OutputFile {
  public:
    /// Throws InputError when the target cannot be written.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Throws InputError, e.g. when the disk is full, and OutputClosed when the reader has closed
    /// the pipe.
    void write(std::string_view bytes);

    /// Throws InputError when the target cannot be replaced.
    void commit();

    /// As commit(), but nothing is replaced: where a file of that name exists, the first free
    /// number is appended to it, "view-2.png". Returns the name. Throws InputError.
    std::filesystem::path commit_beside();

    /// The file that is written until commit(), for a library that opens files by name.
    [[nodiscard]] const std::filesystem::path& written() const noexcept {
        return temporary_.empty() ? target_ : temporary_;
    }

  private:
    void close();
    void finish_rename();
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path target_;
    std::filesystem::path temporary_{};  ///< empty when written directly
    int file_{-1};
    bool owned_{false};
};

/// Writes an OutputFile of these bytes and commits it. Throws as that does.
void write_file(const std::filesystem::path& target, std::string_view bytes);

/// A folder of output files. Files of an earlier run are replaced at commit(). Without commit() the
/// folder is as it was, or is not there. Other files stay. Every call that writes throws
/// InputError: what failed, which file, what to do next.
class OutputFolder {
  public:
    /// Makes the folder where it is missing, and checks that files can be written in it. `names`:
    /// files of an earlier run that are removed at commit(), unless this one has such a file.
    explicit OutputFolder(const std::filesystem::path& folder, std::vector<std::string> names = {});
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Does nothing for a name that was added before.
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
