// Reads a page of TOML that a person wrote, key by key. Errors name the line and the allowed
// values.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dibhr {

/// "FILE:LINE: `what`" as InputError.
[[noreturn]] void refuse_at(const std::filesystem::path& file, const toml::node& node,
                            const std::string& what);

/// The page as a table. Throws InputError.
[[nodiscard]] toml::table page_of(const std::string& text, const std::filesystem::path& file);

/// One table of the page. Reading a key marks it as known; refuse_unknown_keys() refuses all
/// others. All functions throw InputError.
class PageTable {
  public:
    /// `label`: "a block", for messages.
    PageTable(const toml::table& table, std::filesystem::path file, std::string label)
        : table_(table), file_(std::move(file)), label_(std::move(label)) {}

    [[nodiscard]] const toml::node* node(const std::string& key);
    [[nodiscard]] std::optional<std::string> text(const std::string& key);
    [[nodiscard]] std::string required_text(const std::string& key);
    /// A text of one line without control characters, to be shown on a button or in a table.
    [[nodiscard]] std::optional<std::string> name(const std::string& key);
    [[nodiscard]] std::string required_name(const std::string& key);
    [[nodiscard]] std::optional<double> number(const std::string& key, double lowest,
                                               double highest);
    /// In (bound, highest].
    [[nodiscard]] std::optional<double> number_above(const std::string& key, double bound,
                                                     double highest);
    [[nodiscard]] std::optional<int> integer(const std::string& key, int lowest, int highest);
    [[nodiscard]] bool boolean(const std::string& key, bool otherwise);
    /// The index of the value in `words`.
    [[nodiscard]] std::optional<std::size_t> choice_index(const std::string& key,
                                                          const std::vector<std::string>& words);
    /// A list without duplicates, of names; numbers(): of numbers.
    [[nodiscard]] std::vector<std::string> texts(const std::string& key);
    [[nodiscard]] std::vector<double> numbers(const std::string& key, double lowest,
                                              double highest);
    [[nodiscard]] std::optional<PageTable> table(const std::string& key, const std::string& label);
    /// [[key]] or key = [{...}].
    [[nodiscard]] std::vector<PageTable> tables(const std::string& key, const std::string& label);

    [[nodiscard]] const toml::table& raw() const noexcept { return table_; }
    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
    /// Refuses keys that were not read, and names the nearest known one.
    void refuse_unknown_keys() const;
    /// Throws with this key's line. Where the key is missing: with the table's, or with that of a
    /// key of nearly the same name, which is named instead.
    [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

  private:
    [[nodiscard]] std::string unknown_in_words(std::string_view key) const;

    const toml::table& table_;
    std::filesystem::path file_;
    std::string label_;
    std::set<std::string> known_{};
};

}  // namespace dibhr
