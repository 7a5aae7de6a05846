// The options of many sessions, and their summary.
#include "app/commands/batch/session_batch.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include "app/commands/command_line.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/csv_table.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/scratch_folder.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

// What neither changes a session's results nor is part of them.
constexpr std::array<std::string_view, 7> kNotDeciding{"SESSION", "FILE",   "--out",  "--only",
                                                       "--jobs",  "--list", "--again"};

void add_files_option(CLI::App& app, const std::string& name, std::vector<fs::path>& files,
                      const std::string& help, const std::string& type) {
    app.add_option_function<std::vector<std::string>>(
           name,
           [&files](const std::vector<std::string>& texts) {
               files.assign(texts.begin(), texts.end());
           },
           help)
        ->type_name(type);
}

Json json_of(const SessionWork& done) {
    return {{"cells",
             json_list(done.cells,
                       [](const SummaryCell& cell) {
                           return Json{utf8_text(cell.column), utf8_text(cell.value), cell.printed};
                       })},
            {"facts", json_list(done.facts,
                                [](const auto& fact) {
                                    return Json{utf8_text(fact.first), utf8_text(fact.second)};
                                })},
            {"text", utf8_text(done.text)}};
}

/// A session's line of the summary.
struct SummaryRow {
    std::string file{};
    std::string failure{};  ///< why it was passed over
    std::map<std::string, std::string> cells{};
};

struct Summary {
    std::vector<std::string> columns{}, printed{};
    std::vector<SummaryRow> rows{};
};

Summary summary_of(const std::vector<GivenFile>& files, const std::vector<WorkResult>& results) {
    Summary summary;
    std::set<std::string> facts, known;
    for (std::size_t k = 0; k < files.size(); ++k) {
        SummaryRow row{.file = files[k].file.string()};
        if (!results[k].done) row.failure = results[k].failures.front();
        const Json& value = results[k].value;
        for (const Json& cell : value.value("cells", Json::array())) {
            const auto column = cell.at(0).get<std::string>();
            row.cells[column] = cell.at(1).get<std::string>();
            if (!known.insert(column).second) continue;
            summary.columns.push_back(column);
            if (cell.at(2).get<bool>()) summary.printed.push_back(column);
        }
        for (const Json& fact : value.value("facts", Json::array())) {
            const std::string column = "fact " + fact.at(0).get<std::string>();
            row.cells[column] = fact.at(1).get<std::string>();
            facts.insert(column);
        }
        summary.rows.push_back(std::move(row));
    }
    summary.columns.insert(summary.columns.end(), facts.begin(), facts.end());
    return summary;
}

std::string value_in(const SummaryRow& row, const std::string& column) {
    const auto found = row.cells.find(column);
    return found == row.cells.end() ? std::string() : found->second;
}

/// RFC 4180, as all tables of dibhr.
std::string csv_of(const Summary& summary) {
    std::string text = "session,failure";
    for (const std::string& column : summary.columns) text += ',' + csv_cell(column);
    text += '\n';
    for (const SummaryRow& row : summary.rows) {
        text += csv_cell(row.file) + ',' + csv_cell(row.failure);
        for (const std::string& column : summary.columns)
            text += ',' + csv_cell(value_in(row, column));
        text += '\n';
    }
    return text;
}

/// The columns below their names, numbers to the right; a session that was passed over has none.
void print_table(const Summary& summary) {
    std::vector<std::vector<std::string>> lines{{"session"}};
    for (const std::string& column : summary.printed) lines.front().push_back(column);
    for (const SummaryRow& row : summary.rows) {
        lines.push_back({one_line(row.file)});
        for (const std::string& column : summary.printed)
            lines.back().push_back(row.failure.empty() ? one_line(value_in(row, column)) : "-");
    }
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k)
            widths[k] = std::max(widths[k], line[k].size());
    for (const auto& line : lines) {
        std::string text = line.front() + std::string(widths.front() - line.front().size(), ' ');
        for (std::size_t k = 1; k < line.size(); ++k)
            text += "  " + std::string(widths[k] - line[k].size(), ' ') + line[k];
        std::cout << text << '\n';
    }
}

bool are_same(const fs::path& a, const fs::path& b) {
    std::error_code missing;
    return a == b || fs::equivalent(a, b, missing);
}

/// Those of --only.
std::vector<GivenFile> chosen(const std::vector<GivenFile>& files,
                              const std::vector<fs::path>& only) {
    if (only.empty()) return files;
    std::vector<GivenFile> some;
    for (const fs::path& one : only) {
        const auto found = std::ranges::find_if(
            files, [&one](const GivenFile& file) { return are_same(file.file, one); });
        if (found == files.end())
            throw UsageError("--only " + in_quotes(one.string(), 200) +
                             " is none of the sessions that were given");
        some.push_back(*found);
    }
    return some;
}

/// 1 when anything was wrong.
int print_messages(const std::vector<WorkResult>& results) {
    int exit_code = 0;
    for (const WorkResult& result : results) {
        for (const std::string& warning : result.warnings) print_warning(warning);
        for (const std::string& failure : result.failures) print_error_line(failure);
        if (!result.failures.empty()) exit_code = 1;
    }
    return exit_code;
}

}  // namespace

bool BatchOptions::is_batch() const {
    return are_many(given) || !out.empty() || list;
}

void add_sessions(CLI::App& app, BatchOptions& batch, const std::string& out_help) {
    add_files_option(app, "SESSION", batch.given,
                     "Recorded sessions, and folders in which all of them are taken", "");
    app.get_option("SESSION")->required();
    add_batch_options(app, batch, out_help);
}

void add_batch_options(CLI::App& app, BatchOptions& batch, const std::string& out_help) {
    add_file(app, "--out", batch.out, out_help, "DIR");
    add_files_option(app, "--only", batch.only,
                     "Of all sessions works on this one only, and sums nothing up", "SESSION");
    app.get_option("--only")->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--jobs", batch.jobs,
                   "Sessions that are worked on at a time; by default one on each processor")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    app.add_flag("--list", batch.list,
                 "Only lists the sessions: the name of each one's results, a tab, its file");
    app.add_flag("--again", batch.again, "Also makes the results again that are there");
}

SessionWork summary_of(const Session& session) {
    const std::optional<double> begin = session.utc_at(session.begin_s());
    return {.cells = {{"duration_s", number_text(session.end_s() - session.begin_s(), 3), true},
                      {"ticks", std::to_string(session.rows()), true},
                      {"missing_ticks", std::to_string(session.missing())},
                      {"marks", std::to_string(session.marks().size())},
                      {"first_tick_utc_s", begin ? number_text(*begin, 3) : ""}},
            .facts = session.facts()};
}

std::string deciding_options(const CLI::App& app) {
    Json options = Json::array();
    for (const CLI::Option* const option : app.get_options()) {
        const bool decides =
            std::ranges::find(kNotDeciding, option->get_name()) == kNotDeciding.end();
        if (option->count() == 0 || !decides) continue;
        Json one{option->get_name()};
        for (const std::string& value : option->results()) {
            one.push_back(utf8_text(value));
            std::error_code missing;  // of a file that is given, also what is in it decides
            if (fs::is_regular_file(value, missing))
                one.push_back(fs::last_write_time(value, missing).time_since_epoch().count());
        }
        options.push_back(std::move(one));
    }
    return json_line(options);
}

int run_batch(const CLI::App& app, const SessionBatch& batch, const BatchOptions& options) {
    const std::vector<GivenFile> all = given_files(options.given, sought_sessions());
    if (options.list) {
        for (const GivenFile& file : all)
            std::cout << file.name << '\t' << file.file.string() << '\n';
        return 0;
    }
    if (options.out.empty() && !options.only.empty())
        throw UsageError("--only needs --out DIR, where its result is kept");
    const std::vector<GivenFile> files = chosen(all, options.only);
    std::optional<ScratchFolder> scratch;
    if (options.out.empty()) scratch.emplace("the results of many sessions are put together there");
    const fs::path folder = scratch ? scratch->path() : options.out;
    const std::vector<WorkResult> results =
        work_through({.command = batch.command,
                      .options = deciding_options(app),
                      .title = batch.title,
                      .folder = folder,
                      .at_once = static_cast<std::size_t>(options.jobs),
                      .again = options.again,
                      .in_scratch = scratch.has_value(),
                      .work =
                          [&](const GivenFile& file, const WorkProgress& progress) {
                              SessionWork done = batch.work(file, folder, progress);
                              WorkResult result{.value = json_of(done)};
                              result.files = std::move(done.files);
                              result.warnings = std::move(done.warnings);
                              result.failures = std::move(done.failures);
                              return result;
                          }},
                     files);
    const int exit_code = print_messages(results);
    if (!options.only.empty()) return exit_code;
    for (const WorkResult& result : results) std::cout << result.value.value("text", std::string());
    const Summary summary = summary_of(files, results);
    if (batch.table) print_table(summary);
    if (scratch) return exit_code;
    const fs::path csv = folder / (batch.command + ".csv");
    write_file(csv, csv_of(summary));
    if (batch.table) std::cout << csv.string() << '\n';
    return exit_code;
}

}  // namespace dibhr
