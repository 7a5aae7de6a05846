// The pages of a database and its write-ahead log, read without SQLite: a page that is damaged
// costs no more than its rows. SQLite's file format: sqlite.org/fileformat2.html.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/sqlite/database_log.hpp"

namespace dibhr {

/// Bytes of a row that are no text.
struct StoredBytes {
    std::string value{};
};
/// A value of a row; without one: NULL.
using StoredValue = std::variant<std::monostate, std::int64_t, double, std::string, StoredBytes>;

struct StoredRow {
    std::int64_t number{0};  ///< its rowid; 0 in an index
    std::vector<StoredValue> values{};
};

/// A page of a table's or an index's tree, of which every byte is accounted for: cells and free
/// blocks cover it without overlap, rows are in order, and each is as long as its values.
struct StoredPage {
    bool index{false};                      ///< of an index, or of a table WITHOUT ROWID
    bool older{false};                      ///< newer versions are damaged: rows may be missing
    std::vector<std::uint32_t> children{};  ///< none: a leaf
    std::vector<StoredRow> rows{};          ///< of a table: in leaves only
};

/// Reads pages by their numbers, which begin at 1. A page is the newest one of file and log that
/// is whole. One thread at a time; a file that cannot be read has no pages.
class DatabasePages {
  public:
    /// `page_bytes`: the size of a page where the file's head cannot be read. Rows with longer
    /// values than `longest_bytes` count as damaged.
    DatabasePages(const std::filesystem::path& file, bool with_log, std::size_t page_bytes,
                  std::size_t longest_bytes);

    /// Also of those that the file lacks, as it was cut.
    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    /// Whether versions are lost of which the pages are not known.
    [[nodiscard]] bool lacks_frames() const noexcept { return lacks_frames_; }
    /// Nothing: it is damaged, missing, or of no tree.
    [[nodiscard]] std::optional<StoredPage> page(std::uint32_t number);
    /// A number of the head, by its place; nothing: the head cannot be read.
    [[nodiscard]] std::optional<std::uint32_t> head_number(std::size_t at);

  private:
    using Bytes = std::vector<std::uint8_t>;
    class Parser;

    /// Keeps where the log has pages, also those behind the file's end.
    void keep(const LoggedPages& logged);
    /// The bytes of its versions, the newest first; false: there are no more.
    [[nodiscard]] bool read(std::uint32_t number, std::size_t version, Bytes& bytes);
    /// The rest of a long row, from that page on; false: it is not there.
    [[nodiscard]] bool append_rest(std::uint32_t first, std::size_t length, Bytes& to);

    std::size_t page_bytes_, longest_bytes_;
    std::ifstream file_, log_{};
    std::uint32_t count_{0};
    bool lacks_frames_{false};
    std::size_t rest_left_{0};  ///< bytes of long rows that may yet be read
    /// Where the log has versions of a page, from old to new.
    std::map<std::uint32_t, std::vector<std::uint64_t>> logged_{};
};

}  // namespace dibhr
