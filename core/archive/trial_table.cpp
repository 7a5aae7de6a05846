// Reads the answers by SQL, with the explanations of their columns in the study file.
#include "core/archive/trial_table.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/archive/archive_layout.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/utc_text.hpp"
#include "core/sqlite/csv_rows.hpp"

namespace dibhr {

namespace {

std::string question(const Database& database) {
    constexpr std::int64_t kMostIntervals = 8;
    const bool has_early =
        database.number("SELECT count(*) FROM pragma_table_info('trial') WHERE name = 'early'") > 0;
    const std::int64_t intervals = std::min(
        kMostIntervals, database.number("SELECT ifnull(max(interval), -1) + 1 FROM interval"));
    std::string columns =
        "SELECT t.trial, t.block, t.position, t.practice, t.form, t.item, t.repetition, t.target, "
        "t.track, t.level, t.choice, t.number, t.\"right\", t.reaction_s, t.utc_s, ";
    columns += has_early ? "t.early" : "NULL AS early";
    std::string tables = " FROM trial t";
    for (std::int64_t k = 0; k < intervals; ++k) {
        const std::string number = std::to_string(k);
        const std::string alias = "i" + number;
        for (const char* const name : {"condition", "value", "values"})
            columns += ", " + alias + ".\"" + name + "\" AS " + name + "_" + number;
        tables += " LEFT JOIN interval " + alias + " ON " + alias + ".trial = t.trial AND " +
                  alias + ".interval = " + number;
    }
    return columns + tables + " ORDER BY t.trial";
}

/// The explanations in the file, and those that it or its first schema lacks.
std::map<std::string, std::string> meanings_in(const Database& database) {
    std::map<std::string, std::string> meanings{
        {"form", "what is done in the trial"},
        {"condition", "name of what was felt in the interval"},
        {"early", "answers that were pressed before the question; empty: not counted"},
        {"run", "the run that holds the ticks of this trial; empty: none were recorded"}};
    for (Statement row(database,
                       "SELECT \"column\", meaning FROM explanation WHERE \"table\" IN ('trial', "
                       "'interval')");
         row.next();)
        meanings[row.text(0)] = row.text(1);
    return meanings;
}

void add_column(Json& json, const std::string& name,
                const std::map<std::string, std::string>& meanings) {
    const std::size_t number = name.find_last_of('_') + 1;
    const bool of_interval = number > 0 && is_of_digits(std::string_view(name).substr(number));
    const std::string base = of_interval ? name.substr(0, number - 1) : name;
    const auto known = meanings.find(base);
    std::string meaning = known == meanings.end() ? base : known->second;
    if (of_interval) meaning += "; of interval " + name.substr(number) + ", counted from 0";
    json[name] = column(meaning, name.ends_with("_s") ? "s" : "");
}

}  // namespace

TrialTable trial_table(const StudyRecord& study, const TableSource& source,
                       const std::string& protocol, const std::map<int, std::string>& runs) {
    constexpr int kLongest_bytes = 1 << 30;
    const Database database(study.file, {.longest_bytes = kLongest_bytes},
                            [&study](const DatabaseError& error) {
                                throw InputError(study.file.string() + ": cannot be read (" +
                                                 error.what() + "); take a copy that is whole");
                            });
    TrialTable table;
    Json& json = table.dictionary;
    add_source(json, kStudyTask, source);
    json["Rows"] = study.answered.size();
    json["Protocol"] = protocol;
    json["ProtocolSha256"] = study.identity.protocol_sha256;
    json["OrderNumber"] = study.identity.number;
    json["Seed"] = study.identity.seed;
    json["StartTime"] = utc_text(study.identity.created_s);
    json["StartTime_utc_s"] = study.identity.created_s;
    json["RecordedBy"] = study.identity.program;
    json["StudySchema"] = database.number("PRAGMA user_version");
    json["SimulatedBy"] = study.identity.pilot;
    json["Finished"] = study.finished;
    json[kRuns] = Json::object();
    for (const auto& [trial, run] : runs) json[kRuns][run] = trial;
    Statement trials(database, question(database));
    const auto end_line = [&table](const std::string& last) {
        table.rows.back() = ',';
        table.rows += last + '\n';
    };
    append_names(table.rows, trials);
    end_line("run");
    while (trials.next()) {
        append_row(table.rows, trials);
        const auto run = runs.find(static_cast<int>(trials.integer(0)));
        end_line(run == runs.end() ? std::string() : run->second);
    }
    const std::map<std::string, std::string> meanings = meanings_in(database);
    for (int k = 0; k < trials.columns(); ++k) add_column(json, trials.name(k), meanings);
    add_column(json, "run", meanings);
    return table;
}

}  // namespace dibhr
