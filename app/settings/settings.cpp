// Reads and writes the viewer's settings file.
#include "app/settings/settings.hpp"

#include <toml++/toml.h>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/settings/settings_list.hpp"
#include "core/error.hpp"
#include "core/files/output_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kVersion = 1;

/// Takes values out of a parsed file; what does not fit is told with its line and left at its
/// default.
class Reading {
  public:
    Reading(const toml::table& root, const fs::path& file, std::vector<std::string>& warnings)
        : root_(root), file_(file), warnings_(warnings) {}

    void flag(std::string_view table, std::string_view name, bool& value) {
        if (const toml::node* node = find(table, name)) {
            if (const auto read = node->value_exact<bool>()) {
                value = *read;
            } else {
                warn(*node, table, name, "is not true or false");
            }
        }
    }

    void number(std::string_view table, std::string_view name, double& value, Range range) {
        if (const toml::node* node = find(table, name)) {
            const auto read = node->is_number() ? node->value<double>() : std::nullopt;
            if (read && *read >= range.lowest && *read <= range.highest) {
                value = *read;
            } else {
                std::ostringstream wrong;
                wrong << "is not a number from " << range.lowest << " to " << range.highest;
                warn(*node, table, name, wrong.str());
            }
        }
    }

    void integer(std::string_view table, std::string_view name, int& value, Range range) {
        double read = value;
        number(table, name, read, range);
        value = static_cast<int>(std::lround(read));
    }

    template <typename Enum>
    void word(std::string_view table, std::string_view name, Enum& value,
              const Words<Enum>& words) {
        if (const toml::node* node = find(table, name)) {
            const auto read = words.named(node->value<std::string_view>().value_or(""));
            if (read) {
                value = *read;
            } else {
                warn(*node, table, name, "is not " + std::string(words.what));
            }
        }
    }

    void text(std::string_view table, std::string_view name, std::string& value) {
        if (const toml::node* node = find(table, name)) {
            if (const auto read = node->value_exact<std::string>()) {
                value = *read;
            } else {
                warn(*node, table, name, "is not a text in quotes");
            }
        }
    }

    /// After all known values: tells what else stands in the file.
    void tell_unknown() {
        for (const auto& [table_key, node] : root_) {
            if (table_key == "version") continue;
            const toml::table* table = node.as_table();
            if (table == nullptr || !known_tables_.contains(std::string(table_key.str()))) {
                warn(node, "", table_key.str(), "is not a setting");
                continue;
            }
            for (const auto& [key, value] : *table) {
                const std::string full =
                    std::string(table_key.str()) + "." + std::string(key.str());
                if (!known_.contains(full)) {
                    warn(value, table_key.str(), key.str(), "is not a setting");
                }
            }
        }
    }

    void warn(const toml::node& node, std::string_view table, std::string_view name,
              const std::string& what) {
        std::ostringstream text;
        text << file_.string() << ":" << node.source().begin.line << ": ";
        if (!table.empty()) text << table << ".";
        text << name << " " << what << "; the default is kept";
        warnings_.push_back(text.str());
    }

  private:
    const toml::node* find(std::string_view table, std::string_view name) {
        known_tables_.emplace(table);
        known_.insert(std::string(table) + "." + std::string(name));
        const toml::node* node = root_.get(table);
        const toml::table* inside = node != nullptr ? node->as_table() : nullptr;
        return inside != nullptr ? inside->get(name) : nullptr;
    }

    const toml::table& root_;
    const fs::path& file_;
    std::vector<std::string>& warnings_;
    std::set<std::string> known_{};
    std::set<std::string> known_tables_{};
};

/// Writes values as TOML, a heading before each table; numbers as short as they come back the same.
class Writing {
  public:
    void flag(std::string_view table, std::string_view name, bool& value) {
        line(table, name, value ? "true" : "false");
    }
    void number(std::string_view table, std::string_view name, double& value, Range) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value);
        line(table, name, {digits, static_cast<std::size_t>(end.ptr - digits)});
    }
    void integer(std::string_view table, std::string_view name, int& value, Range) {
        line(table, name, std::to_string(value));
    }
    template <typename Enum>
    void word(std::string_view table, std::string_view name, Enum& value,
              const Words<Enum>& words) {
        line(table, name, '"' + std::string(words.name_of(value)) + '"');
    }
    void text(std::string_view table, std::string_view name, std::string& value) {
        std::ostringstream quoted;
        quoted << toml::value<std::string>(value);
        line(table, name, quoted.str());
    }

    [[nodiscard]] std::string text() const { return text_.str(); }

  private:
    void line(std::string_view table, std::string_view name, std::string_view value) {
        if (table != table_) text_ << "\n[" << table << "]\n";
        table_ = table;
        text_ << name << " = " << value << "\n";
    }

    std::ostringstream text_{};
    std::string table_{};
};

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    if (in && fs::is_regular_file(file) && fs::file_size(file) > 0) content << in.rdbuf();
    if (!in || content.fail() || !fs::is_regular_file(file)) {
        throw InputError("cannot read the settings file " + file.string() +
                         ": make it readable or delete it");
    }
    return content.str();
}

toml::table parsed(const fs::path& file) {
    const std::string content = content_of(file);
    try {
        return toml::parse(content);
    } catch (const toml::parse_error& error) {
        std::ostringstream text;
        text << "cannot understand the settings file " << file.string() << " at line "
             << error.source().begin.line << " (" << error.description() << "): mend or delete it";
        throw InputError(text.str());
    }
}

}  // namespace

fs::path settings_path() {
    const char* folder = std::getenv("XDG_CONFIG_HOME");
    if (folder != nullptr && *folder == '/') return fs::path(folder) / "dibhr" / "settings.toml";
    const char* home = std::getenv("HOME");
    return fs::path(home != nullptr ? home : "/") / ".config" / "dibhr" / "settings.toml";
}

Settings load_settings(const fs::path& file, std::vector<std::string>& warnings) {
    std::error_code failed;
    if (fs::status(file, failed).type() == fs::file_type::not_found) return {};
    const toml::table root = parsed(file);
    Settings settings;
    Reading reading(root, file, warnings);
    if (const toml::node* version = root.get("version")) {
        if (version->value<std::int64_t>() != kVersion) {
            reading.warn(*version, "", "version", "is not 1, the one this program writes");
        }
    }
    visit_settings(settings, reading);
    reading.tell_unknown();
    keep_in_range(settings.touch);
    return settings;
}

Settings load_settings(const fs::path& file) {
    std::vector<std::string> warnings;
    Settings settings = load_settings(file, warnings);
    for (const std::string& warning : warnings) std::cerr << "dibhr: " << warning << "\n";
    return settings;
}

void save_settings(const Settings& settings, const fs::path& file) {
    Writing writing;
    Settings copy = settings;
    visit_settings(copy, writing);
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    try {
        OutputFile out(file);
        out.write("# dibhr writes this file; change it while it is not running.\nversion = " +
                  std::to_string(kVersion) + "\n" + writing.text());
        out.commit();
    } catch (const InputError& error) {
        throw InputError(std::string("the settings are not kept: ") + error.what());
    }
}

}  // namespace dibhr
