// A page of TOML that a person wrote, taken key by key: whatever does not fit is refused with its
// line and with what is allowed.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dibhr {

/// "FILE:LINE: `what`" as InputError.
[[noreturn]] void refuse_at(const std::filesystem::path& file, const toml::node& node,
                            const std::string& what);

/// The page as a table. Throws InputError.
[[nodiscard]] toml::table page_of(const std::string& text, const std::filesystem::path& file);

/// One table of it. Every question names a key, which then is known; done() refuses the others.
/// All of them throw InputError.
class PageTable {
  public:
    /// `called`: "a block", for messages.
    PageTable(const toml::table& table, std::filesystem::path file, std::string called)
        : table_(table), file_(std::move(file)), called_(std::move(called)) {}

    [[nodiscard]] const toml::node* node(const std::string& key);
    [[nodiscard]] std::optional<std::string> text(const std::string& key);
    [[nodiscard]] std::string needed_text(const std::string& key);
    /// Of one line and without control characters, as it is shown on a button or in a table.
    [[nodiscard]] std::optional<std::string> name(const std::string& key);
    [[nodiscard]] std::string needed_name(const std::string& key);
    [[nodiscard]] std::optional<double> number(const std::string& key, double lowest,
                                               double highest);
    /// In (bound, highest].
    [[nodiscard]] std::optional<double> number_above(const std::string& key, double bound,
                                                     double highest);
    [[nodiscard]] std::optional<int> whole(const std::string& key, int lowest, int highest);
    [[nodiscard]] bool yes(const std::string& key, bool otherwise);
    /// One of the words: its place among them.
    [[nodiscard]] std::optional<std::size_t> word(const std::string& key,
                                                  const std::vector<std::string>& words);
    /// Names, none of them twice; as numbers().
    [[nodiscard]] std::vector<std::string> texts(const std::string& key);
    [[nodiscard]] std::vector<double> numbers(const std::string& key, double lowest,
                                              double highest);
    [[nodiscard]] std::optional<PageTable> table(const std::string& key, const std::string& called);
    /// [[key]] or key = [{...}].
    [[nodiscard]] std::vector<PageTable> tables(const std::string& key, const std::string& called);

    [[nodiscard]] const toml::table& raw() const noexcept { return table_; }
    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
    /// Keys that nobody asked for are refused, with the nearest one that is known.
    void done() const;
    /// With this key's line, or the table's where it is not there.
    [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

  private:
    const toml::table& table_;
    std::filesystem::path file_;
    std::string called_;
    std::set<std::string> known_{};
};

}  // namespace dibhr
