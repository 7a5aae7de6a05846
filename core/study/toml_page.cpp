// Takes values out of a page of TOML.
#include "core/study/toml_page.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"

namespace dibhr {

namespace {

std::string range_text(double lowest, double highest) {
    return "from " + short_text(lowest) + " to " + short_text(highest);
}

bool is_blank(const std::string& text) {
    return text.find_first_not_of(" \t\r\n") == std::string::npos;
}

}  // namespace

void refuse_at(const std::filesystem::path& file, const toml::node& node, const std::string& what) {
    throw InputError(one_line(file.string() + ":" +
                              std::to_string(std::max(1U, node.source().begin.line)) + ": " +
                              what));
}

toml::table page_of(const std::string& text, const std::filesystem::path& file) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        std::ostringstream words;
        words << file.string() << ":" << error.source().begin.line << ": cannot be understood ("
              << error.description() << "); a line is NAME = VALUE, [TABLE] or [[TABLE]]";
        throw InputError(one_line(words.str()));
    }
}

const toml::node* PageTable::node(const std::string& key) {
    known_.insert(key);
    return table_.get(key);
}

std::optional<std::string> PageTable::text(const std::string& key) {
    const toml::node* const found = node(key);
    if (found == nullptr) return std::nullopt;
    auto value = found->value_exact<std::string>();
    if (!value) refuse(key, key + " is not a text in quotes");
    if (is_blank(*value)) refuse(key, key + " is blank: write a text between the quotes");
    return value;
}

std::string PageTable::required_text(const std::string& key) {
    if (auto value = text(key)) return *value;
    refuse(key, label_ + " has no " + key + ": add " + key + " = \"...\"");
}

std::optional<std::string> PageTable::name(const std::string& key) {
    auto value = text(key);
    if (value && one_line(*value) != *value)
        refuse(key, key + " is not one line without control characters: take them out");
    return value;
}

std::string PageTable::required_name(const std::string& key) {
    static_cast<void>(name(key));
    return required_text(key);
}

std::optional<double> PageTable::number(const std::string& key, double lowest, double highest) {
    const toml::node* const found = node(key);
    if (found == nullptr) return std::nullopt;
    const auto value = found->is_number() ? found->value<double>() : std::nullopt;
    if (!value || !(*value >= lowest && *value <= highest))
        refuse(key, key + " is not a number " + range_text(lowest, highest));
    return value;
}

std::optional<double> PageTable::number_above(const std::string& key, double bound,
                                              double highest) {
    const toml::node* const found = node(key);
    if (found == nullptr) return std::nullopt;
    const auto value = found->is_number() ? found->value<double>() : std::nullopt;
    if (!value || !(*value > bound && *value <= highest))
        refuse(key, key + " is not a number above " + short_text(bound) + ", up to " +
                        short_text(highest));
    return value;
}

std::optional<int> PageTable::integer(const std::string& key, int lowest, int highest) {
    const toml::node* const found = node(key);
    if (found == nullptr) return std::nullopt;
    const auto value = found->value_exact<std::int64_t>();
    if (!value || *value < lowest || *value > highest)
        refuse(key, key + " is not a whole number from " + std::to_string(lowest) + " to " +
                        std::to_string(highest));
    return static_cast<int>(*value);
}

bool PageTable::boolean(const std::string& key, bool otherwise) {
    const toml::node* const found = node(key);
    if (found == nullptr) return otherwise;
    const auto value = found->value_exact<bool>();
    if (!value) refuse(key, key + " is not true or false");
    return *value;
}

std::optional<std::size_t> PageTable::choice_index(const std::string& key,
                                                   const std::vector<std::string>& words) {
    const auto value = text(key);
    if (!value) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), *value);
    if (found == words.end())
        refuse(key, key + " must be one of " + listed(words) + ", and not " + in_quotes(*value) +
                        did_you_mean(*value, words));
    return static_cast<std::size_t>(found - words.begin());
}

std::vector<std::string> PageTable::texts(const std::string& key) {
    const toml::node* const found = node(key);
    if (found == nullptr) return {};
    std::vector<std::string> values;
    const toml::array* const list = found->as_array();
    if (list == nullptr || list->empty()) refuse(key, key + " is not a list [\"...\", \"...\"]");
    for (const toml::node& entry : *list) {
        const auto value = entry.value_exact<std::string>();
        if (!value || is_blank(*value) || one_line(*value) != *value)
            refuse_at(file_, entry, "an entry of " + key + " is not a line of text in quotes");
        if (std::find(values.begin(), values.end(), *value) != values.end())
            refuse_at(file_, entry, key + " has " + in_quotes(*value) + " twice: leave one out");
        values.push_back(*value);
    }
    return values;
}

std::vector<double> PageTable::numbers(const std::string& key, double lowest, double highest) {
    const toml::node* const found = node(key);
    if (found == nullptr) return {};
    std::vector<double> values;
    const toml::array* const list = found->as_array();
    if (list == nullptr || list->empty()) refuse(key, key + " is not a list of numbers [1, 2]");
    for (const toml::node& entry : *list) {
        const auto value = entry.is_number() ? entry.value<double>() : std::nullopt;
        if (!value || !(*value >= lowest && *value <= highest))
            refuse_at(file_, entry,
                      "an entry of " + key + " is not a number " + range_text(lowest, highest));
        if (std::find(values.begin(), values.end(), *value) != values.end())
            refuse_at(file_, entry, key + " has " + short_text(*value) + " twice: leave one out");
        values.push_back(*value);
    }
    return values;
}

std::optional<PageTable> PageTable::table(const std::string& key, const std::string& label) {
    const toml::node* const found = node(key);
    if (found == nullptr) return std::nullopt;
    if (!found->is_table()) refuse(key, key + " is not a table [" + key + "]");
    return PageTable(*found->as_table(), file_, label);
}

std::vector<PageTable> PageTable::tables(const std::string& key, const std::string& label) {
    const toml::node* const found = node(key);
    if (found == nullptr) return {};
    std::vector<PageTable> all;
    const toml::array* const list = found->as_array();
    if (list == nullptr) refuse(key, key + " is not a list of tables [[" + key + "]]");
    for (const toml::node& entry : *list) {
        if (!entry.is_table()) refuse_at(file_, entry, "an entry of " + key + " is not a table");
        all.emplace_back(*entry.as_table(), file_, label);
    }
    return all;
}

std::string PageTable::unknown_in_words(std::string_view key) const {
    return in_quotes(std::string(key)) + " is not known in " + label_;
}

void PageTable::refuse_unknown_keys() const {
    const std::vector<std::string> names(known_.begin(), known_.end());
    for (const auto& [key, value] : table_) {
        const std::string name(key.str());
        if (known_.contains(name)) continue;
        const std::string nearest = did_you_mean(name, names);
        refuse_at(
            file_, value,
            unknown_in_words(name) + (nearest.empty() ? ": known are " + listed(names) : nearest));
    }
}

void PageTable::refuse(const std::string& key, const std::string& what) const {
    if (const toml::node* const found = table_.get(key)) refuse_at(file_, *found, what);
    for (const auto& [other, value] : table_) {
        const std::string nearest = did_you_mean(std::string(other.str()), {key});
        if (!nearest.empty()) refuse_at(file_, value, unknown_in_words(other.str()) + nearest);
    }
    refuse_at(file_, table_, what);
}

}  // namespace dibhr
