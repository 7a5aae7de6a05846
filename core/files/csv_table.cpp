// Splits the text of a CSV file and reads its numbers.
#include "core/files/csv_table.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

std::string_view trimmed(std::string_view cell) {
    constexpr std::string_view kAround = " \t\r\"";
    const auto first = cell.find_first_not_of(kAround);
    if (first == std::string_view::npos) return {};
    return cell.substr(first, cell.find_last_not_of(kAround) - first + 1);
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, const std::string& wanted)
    : file_(file.string()), wanted_(wanted) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) refuse_file("is a folder");
    if (std::filesystem::is_character_file(file, ignored)) refuse_file("is a device");
    stream_.open(file, std::ios::binary);
    if (!stream_) refuse_file(std::string("cannot be opened (") + std::strerror(errno) + ")");
    if (std::filesystem::is_regular_file(file, ignored)) {
        const std::uintmax_t size = std::filesystem::file_size(file, ignored);
        if (!ignored) size_ = size;
    }
    static_cast<void>(read_line());
    line_ = 1;  // also of an empty file
    names_.assign(cells_.begin(), cells_.end());
}

bool CsvTable::read_line() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    cells_.clear();
    const bool is_read = static_cast<bool>(std::getline(stream_, text_));
    if (stream_.bad()) refuse_file("cannot be read");
    if (!is_read) return false;
    read_ += text_.size() + 1;
    std::string_view line = text_;
    if (line_ == 0 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
    ++line_;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        cells_.push_back(trimmed(line.substr(begin, comma - begin)));
        begin = comma + 1;
    }
    return true;
}

double CsvTable::share_read() const noexcept {
    if (size_ == 0) return 0.0;
    return std::min(1.0, static_cast<double>(read_) / static_cast<double>(size_));
}

std::optional<std::size_t> CsvTable::find(std::span<const std::string_view> names) const {
    for (const std::string_view name : names) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) continue;
        if (std::find(found + 1, names_.end(), name) != names_.end()) {
            refuse("column " + std::string(name) + " stands twice; keep one of them");
        }
        return static_cast<std::size_t>(found - names_.begin());
    }
    return std::nullopt;
}

bool CsvTable::next() {
    while (read_line()) {
        if (cells_.size() > 1 || !cells_.front().empty()) return true;
    }
    return false;
}

double CsvTable::number(std::size_t column) const {
    const std::string_view cell = column < cells_.size() ? cells_[column] : std::string_view{};
    const std::string which = "column " + names_[column] + ": ";
    if (cell.empty()) refuse(which + "no value; give a number");
    double value = 0.0;
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error == std::errc::result_out_of_range) {
        refuse(which + in_quotes(cell) + " is out of range; give a smaller number");
    }
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
        refuse(which + in_quotes(cell) + " is not a finite number; give one such as 12.5");
    }
    return value;
}

void CsvTable::refuse_file(const std::string& what) const {
    throw InputError(file_ + ": " + what + "; " + wanted_);
}

void CsvTable::refuse(const std::string& what) const {
    throw InputError(file_ + ":" + std::to_string(line_) + ": " + what);
}

std::string csv_cell(std::string_view text) {
    // The wide signs are those of East Asian keyboards.
    constexpr std::array<std::string_view, 8> kFormula{"=",      "+",      "-",      "@",
                                                       "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};
    std::string cell = one_line(text);
    const std::size_t begin = std::min(cell.find_first_not_of(" \"'"), cell.size());
    const std::string_view said = std::string_view(cell).substr(begin);
    const bool formula =
        std::ranges::any_of(kFormula, [said](auto sign) { return said.starts_with(sign); });
    if (formula && !number_of_text(cell)) cell.insert(0, 1, '\'');
    if (cell.find_first_of(",;\"") == std::string::npos) return cell;
    std::string quoted = "\"";
    for (const char each : cell) quoted.append(each == '"' ? 2 : 1, each);
    return quoted + '"';
}

}  // namespace dibhr
