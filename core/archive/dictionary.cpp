// Sidecars after BIDS: a member for every column, and facts.
#include "core/archive/dictionary.hpp"

#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/archive/archive_layout.hpp"
#include "core/files/output_file.hpp"
#include "core/files/utc_text.hpp"
#include "core/session/session_schema.hpp"

namespace dibhr {

namespace {

/// The columns of the view `tick`. Files of earlier schemas explain fewer: this schema explains
/// the rest.
void add_tick_columns(Json& json, const Session& session) {
    std::map<std::string, Json> known;
    for (Statement rows = session.reader().rows("SELECT name, unit, meaning FROM tick_column");
         rows.next();)
        known[rows.text(0)] = column(rows.text(2), rows.text(1));
    for (const TickColumn& own : tick_columns())
        known.emplace(own.name, column(own.meaning, own.unit));
    const Statement ticks = session.reader().rows("SELECT * FROM tick");
    for (int k = 0; k < ticks.columns(); ++k) json[ticks.name(k)] = known[ticks.name(k)];
    Json levels = Json::object();
    for (Statement row = session.reader().rows("SELECT code, name FROM cut"); row.next();)
        levels[row.text(0)] = row.text(1).empty() ? "not cut" : row.text(1);
    if (json.contains("cut")) json["cut"]["Levels"] = std::move(levels);
}

Json row_of(const Statement& row) {
    Json json = Json::object();
    for (int k = 0; k < row.columns(); ++k) {
        Json& value = json[row.name(k)];
        if (row.type(k) == Statement::Type::integer) value = row.integer(k);
        if (row.type(k) == Statement::Type::real) value = row.real(k);
        if (row.type(k) == Statement::Type::text) value = row.text(k);
    }
    return json;
}

Json rows_of(const Session& session, const std::string& query) {
    Json all = Json::array();
    for (Statement row = session.reader().rows(query); row.next();) all.push_back(row_of(row));
    return all;
}

void add_clock(Json& json, const Session& session) {
    if (const std::optional<double> begin = session.utc_at(session.begin_s())) {
        json["StartTime"] = utc_text(*begin);
        json["StartTime_utc_s"] = *begin;
    }
    if (const std::optional<ClockDrift> drift = session.drift())
        json["ClockDrift"] = {{"GainedByWallClock_s", drift->gained_s}, {"Over_s", drift->over_s}};
}

}  // namespace

Json column(const std::string& meaning, const std::string& unit) {
    Json entry = {{kDescription, meaning}};
    if (!unit.empty()) entry["Units"] = unit;
    return entry;
}

void add_source(Json& json, const char* task, const TableSource& source) {
    json["TaskName"] = task;
    json[kSource] = source.file;
    if (source.trial >= 0) json[kTrial] = source.trial;
}

Json tick_dictionary(const Session& session, const TableSource& source) {
    Json json = Json::object();
    add_source(json, kTouchTask, source);
    const double length_s = session.end_s() - session.begin_s();
    if (length_s > 0.0)
        json["SamplingFrequency"] = static_cast<double>(session.rows() - 1) / length_s;
    add_clock(json, session);
    json["Rows"] = session.rows();
    json["MissingTicks"] = session.missing();
    json["RecordedBy"] = session.fact("program");
    json["SessionSchema"] = rows_of(session, "PRAGMA user_version")[0]["user_version"];
    json["Device"] = session.fact("device");
    json["Facts"] = session.facts();
    json["Parameters"] = rows_of(session, "SELECT * FROM parameters ORDER BY first_tick");
    json["Sources"] = rows_of(session, "SELECT * FROM source ORDER BY first_tick");
    json["Media"] = rows_of(session, "SELECT * FROM media ORDER BY id");
    add_tick_columns(json, session);
    return json;
}

Json mark_dictionary(const Session& session, const TableSource& source) {
    Json json = Json::object();
    add_source(json, kTouchTask, source);
    json["Rows"] = session.marks().size();
    json["t"] = column("when it was marked, on the clock of the ticks' column t", "s");
    json["utc_s"] = column("wall time of it since 1970-01-01 00:00 UTC", "s");
    json["tag"] = column("what was marked");
    json["text"] = column("what was written beside it");
    return json;
}

Json media_dictionary() {
    Json json = Json::object();
    json["name"] = column("name of the file, or folder of pictures, that was touched");
    json["bytes"] = column("size; 0: the recording ended before it was known", "byte");
    json["sha256"] = column(
        "SHA-256 of all bytes after the first head_bytes; of a folder, of the names, each with a "
        "zero behind it, and the bytes of its files in order");
    json["head_bytes"] = column("bytes at its begin that are not in the sum", "byte");
    json["copied"] = column("whether the file is in this folder, with this sum");
    return json;
}

void write_table(const std::filesystem::path& archive, const std::filesystem::path& table,
                 std::string_view rows, const Json& dictionary) {
    std::error_code failed;
    make_folders((archive / table).parent_path(), failed);
    if (!rows.empty()) write_file(archive / table, rows);
    write_file(archive / sidecar_of(table), json_text(dictionary));
}

std::filesystem::path sidecar_of(std::filesystem::path table) {
    return table.replace_extension(".json");
}

}  // namespace dibhr
