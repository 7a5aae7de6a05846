// Reads a CSV table that people wrote: a line of column names, in any order, then rows; and
// writes one cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// Reads row by row, and keeps one row only. Space, quotation marks and carriage returns around a
/// cell, empty lines, a byte order mark and unused columns are ignored.
class CsvTable {
  public:
    /// Throws InputError when the file cannot be read: the reason, then `wanted`, what to give
    /// instead.
    CsvTable(const std::filesystem::path& file, const std::string& wanted);
    CsvTable(const CsvTable&) = delete;
    CsvTable& operator=(const CsvTable&) = delete;

    /// The column of the first of these names in the file. Throws InputError when the name is there
    /// twice.
    [[nodiscard]] std::optional<std::size_t> find(std::span<const std::string_view> names) const;

    /// Goes to the next row. False after the last one. Throws InputError when the file cannot be
    /// read on.
    [[nodiscard]] bool next();

    /// How much of the file has been read, 0 to 1; 0 where its size is not known (a pipe).
    [[nodiscard]] double share_read() const noexcept;

    /// A cell of the row. Throws InputError with file, line and column when it is no finite number.
    [[nodiscard]] double number(std::size_t column) const;

    /// Throws InputError with the file and the row's line; before the first row, that of the names.
    [[noreturn]] void refuse(const std::string& what) const;

  private:
    [[nodiscard]] bool read_line();
    [[noreturn]] void refuse_file(const std::string& what) const;

    std::string file_;
    std::string wanted_;
    std::ifstream stream_{};
    std::uintmax_t size_{0};  ///< 0: not known
    std::uintmax_t read_{0};  ///< bytes
    std::size_t line_{0};
    std::string text_{};  ///< of the line
    std::vector<std::string> names_{};
    std::vector<std::string_view> cells_{};  // of the text
};

/// A cell of a CSV file (RFC 4180), on one line, in quotation marks where needed. An apostrophe
/// before a text that a spreadsheet would take for a formula keeps it a text.
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace dibhr
