// Work on a disk whose power is cut, and what the disk may have when the power is back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// What of the steps that no flush has followed yet is lost. `all`: everything; `contents`: files
/// have their last names, and zeros where nothing was flushed; `some`: of each name and each page
/// of a file the old or the new one, by chance.
enum class Lost { all, contents, some };

/// Names with their bytes, of all files of a folder.
using FileTree = std::map<std::string, std::string>;

class PowerCut {
  public:
    /// `disk` is the folder that is on the disk: `prepare` fills it, `work` writes there, in a
    /// process of its own.
    using Work = std::function<void(const std::filesystem::path& disk)>;
    PowerCut(Work work, Work prepare);
    /// Work of dibhr's own; of an argument "@NAME" the file is on the disk.
    static Work program(std::vector<std::string> arguments);

    [[nodiscard]] std::filesystem::path disk() const { return folder_ / "disk"; }
    /// Begins with a prepared disk and cuts its power before that step; without a number, never.
    /// Whether the work had ended by then.
    bool run(int at = -1);
    /// The work once more, on the disk as it is. Whether it ended well.
    bool run_again();
    /// Of work that came to its end.
    [[nodiscard]] int steps() const;
    /// How many lines were said.
    [[nodiscard]] int lines() const;
    /// Makes the disk what the last run may have left there. `chance`: of `some`.
    void come_back(Lost lost, unsigned chance);
    [[nodiscard]] FileTree files() const;

  private:
    struct Entry {
        std::uint64_t inode{0};
        bool folder{false};
    };
    struct Image {
        std::map<std::uint64_t, std::map<std::string, Entry>> names{};
        std::map<std::uint64_t, std::string> bytes{};
    };

    bool start(const std::string& at);
    [[nodiscard]] Image flushed() const;
    void lay(std::uint64_t inode, const std::filesystem::path& place, Lost lost,
             std::function<bool()> const& is_kept) const;
    [[nodiscard]] std::string content(std::uint64_t inode, Lost lost,
                                      std::function<bool()> const& is_kept) const;

    TemporaryFolder folder_{};
    Work work_;
    Work prepare_;
    std::uint64_t root_{0};
    Image written_{}, flushed_{};
};

}  // namespace dibhr::test
