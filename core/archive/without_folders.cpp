// Removes folders in copies of sessions and studies, by SQL.
#include "core/archive/without_folders.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kLongestValue_bytes = 1 << 30;  ///< a trial's session

Database::ErrorHandler refusal_of(const fs::path& file) {
    return [file](const DatabaseError& error) {
        throw InputError(file.string() + ": cannot be copied into the archive (" + error.what() +
                         "); make room, also in TMPDIR, or take a copy of it that is whole");
    };
}

/// Changes each text of a column, where the table has that column.
template <typename Change>
void rewrite(const Database& database, const std::string& table, const std::string& column,
             const Change& change, const std::string& where = "1") {
    if (database.number("SELECT count(*) FROM pragma_table_info('" + table + "') WHERE name = '" +
                        column + "'") == 0)
        return;
    const std::string quoted = '"' + column + '"';
    std::vector<std::string> texts;
    for (Statement row(database, "SELECT DISTINCT " + quoted + " FROM " + table + " WHERE " +
                                     quoted + " LIKE '%/%' AND " + where);
         row.next();)
        texts.push_back(row.text(0));
    Statement update(database, "UPDATE " + table + " SET " + quoted + " = ? WHERE " + quoted +
                                   " = ? AND " + where);
    for (const std::string& text : texts) update.run(change(text), text);
}

bool has_table(const Database& database, const std::string& name) {
    return database.number("SELECT count(*) FROM sqlite_master WHERE name = '" + name + "'") > 0;
}

void rename_media(const Database& database,
                  const std::function<std::string(const FileContent&)>& name_media) {
    if (!has_table(database, "media")) return;
    const bool has_head =
        database.number(
            "SELECT count(*) FROM pragma_table_info('media') WHERE name = 'head_bytes'") > 0;
    std::vector<std::pair<std::int64_t, std::string>> names;
    std::set<std::string> used;
    for (Statement row(database, std::string("SELECT id, file, bytes, sha256, ") +
                                     (has_head ? "head_bytes" : "0") + " FROM media");
         row.next();) {
        std::string name = name_media({.file = row.text(1),
                                       .bytes = static_cast<std::uint64_t>(row.integer(2)),
                                       .sha256 = row.text(3),
                                       .head_bytes = static_cast<std::uint64_t>(row.integer(4))});
        // The column is unique, and two files may have had the same content.
        while (!used.insert(name).second) name.insert(0, "./");
        names.emplace_back(row.integer(0), std::move(name));
    }
    database.execute("UPDATE media SET file = 'file ' || id");
    Statement update(database, "UPDATE media SET file = ? WHERE id = ?");
    for (const auto& [id, name] : names) update.run(name, id);
}

/// Of a path, also a relative one, and of "goals:PATH".
std::string file_name_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return path;
    const std::size_t colon = path.find(':');
    return (colon < slash ? path.substr(0, colon + 1) : std::string()) + path.substr(slash + 1);
}

bool is_of_web(std::string_view before) {
    return before.ends_with("http:") || before.ends_with("https:");
}

std::string values_without_folders(const std::string& text) {
    Json values = parsed_json(text);
    if (!values.is_object()) return without_folders(text);
    for (auto& [key, value] : values.items()) {
        if (!value.is_string()) continue;
        const auto text_of = value.get<std::string>();
        value = key == "bump" ? file_name_of(text_of) : without_folders(text_of);
    }
    return json_line(values);
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(in), {});
    if (!in.is_open() || in.bad())
        throw InputError(file.string() + ": cannot be read again; check the disk");
    return bytes;
}

}  // namespace

std::string without_folders(std::string_view text) {
    constexpr std::string_view kBefore = " \t\n\"'`=:,;([{<|";
    constexpr std::string_view kEnd = "\n\"'`,;";
    // The whole text is one path, in which any of these may stand.
    if (text.starts_with('/') && text.find('\n') == std::string_view::npos)
        return std::string(text.substr(text.rfind('/') + 1));
    std::string plain;
    std::size_t at = 0;
    for (std::size_t slash = text.find('/'); slash != std::string_view::npos;
         slash = text.find('/', slash + 1)) {
        if (slash < at) continue;
        const bool begins = slash == 0 || kBefore.find(text[slash - 1]) != std::string_view::npos;
        const bool goes_on = slash + 1 < text.size() && text[slash + 1] != ' ';
        if (!begins || !goes_on) continue;
        if (is_of_web(text.substr(0, slash))) {
            slash = std::min(text.find_first_of(" \n\"'", slash), text.size()) - 1;
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(kEnd, slash), text.size());
        const std::size_t name = text.substr(0, end).rfind('/') + 1;
        plain += text.substr(at, slash - at);
        at = name;
    }
    return plain += text.substr(at);
}

void copy_database(const fs::path& from, const fs::path& to, bool complete) {
    const Database database(from, {.complete = complete, .longest_bytes = kLongestValue_bytes},
                            refusal_of(from));
    Statement copy(database, "VACUUM INTO ?");
    copy.bind(std::string_view(to.native()));
    static_cast<void>(copy.next());
}

void remove_folders(const fs::path& session,
                    const std::function<std::string(const FileContent&)>& name_media) {
    Database database(session, refusal_of(session));
    database.restrict_untrusted(kLongestValue_bytes);
    database.execute("BEGIN");
    rewrite(database, "session", "value", without_folders);
    rewrite(database, "session", "value", file_name_of, "key IN ('bump', 'device')");
    rewrite(database, "source", "depth_meaning", without_folders);
    rename_media(database, name_media);
    database.execute("COMMIT; VACUUM");
}

void remove_study_folders(const fs::path& study, const fs::path& scratch,
                          const std::function<void(int trial)>& change) {
    Database database(study, refusal_of(study));
    database.restrict_untrusted(kLongestValue_bytes);
    database.execute("BEGIN");
    rewrite(database, "study", "value", without_folders);
    rewrite(database, "interval", "values", values_without_folders);
    database.execute("COMMIT");
    std::vector<int> trials;
    for (Statement row(database, "SELECT trial FROM session ORDER BY trial"); row.next();)
        trials.push_back(static_cast<int>(row.integer(0)));
    for (const int trial : trials) {
        if (!write_study_session(study, trial, scratch)) continue;
        change(trial);
        const std::string bytes = bytes_of(scratch);
        Statement(database, "UPDATE session SET file = ? WHERE trial = ?")
            .run(SqlBytes{bytes}, trial);
        fs::remove(scratch);
    }
    database.execute("VACUUM");
}

}  // namespace dibhr
