// `dibhr export`: the view `tick` as text.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/commands/batch/session_batch.hpp"
#include "app/commands/batch/stoppable_work.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"
#include "core/session/session.hpp"
#include "core/session/session_schema.hpp"
#include "core/sqlite/csv_rows.hpp"

namespace dibhr {

namespace {

/// A line for each column: its name, and what it means.
std::string columns_help() {
    std::string text = "Columns of the CSV; those of `dibhr touch` come first:\n";
    for (const TickColumn& column : tick_columns()) {
        constexpr std::size_t kNameWidth = 12;
        std::string name = "  " + column.name;
        name.resize(std::max(name.size() + 1, kNameWidth + 2), ' ');
        text +=
            name + column.meaning + (column.unit.empty() ? "" : " [" + column.unit + "]") + '\n';
    }
    return text + "Tables are those of the session, a SQLite file.\n";
}

constexpr std::int64_t kRowsPerStep = 10000;  // of the progress bar

/// Prints when the first tick was, and how the wall clock went beside the ticks' clock.
void print_clock(const Session& session) {
    const std::optional<double> begin = session.utc_at(session.begin_s());
    if (!begin) return;
    std::cout << "first tick (t = " << number_text(session.begin_s(), 6)
              << " s): " << wall_time_text(*begin) << ", utc_s = " << number_text(*begin, 6)
              << '\n';
    if (const std::optional<ClockDrift> drift = session.drift())
        std::cout << "drift of the wall clock on t: " << number_text(1e3 * drift->gained_s, 3)
                  << " ms in " << number_text(drift->over_s, 1) << " s\n";
}

void write_ticks(const Session& session, const std::filesystem::path& csv,
                 const WorkProgress& progress) {
    Statement ticks = session.reader().rows("SELECT * FROM tick ORDER BY tick");
    RowFile rows(csv, {session.file()}, "is the session that is read; give --csv another name");
    append_names(rows.text(), ticks);
    for (std::int64_t done = 0; ticks.next(); ++done) {
        append_row(rows.text(), ticks);
        rows.rows_done();
        if (done % kRowsPerStep == 0)
            progress(static_cast<double>(done) / static_cast<double>(session.rows()));
    }
    rows.commit();
}

SessionWork export_into(const std::filesystem::path& folder, const GivenFile& file,
                        const WorkProgress& progress) {
    Session session(file.file);
    session.rescue_if_damaged();
    SessionWork done = summary_of(session);
    if (const std::optional<ClockDrift> drift = session.drift())
        done.cells.push_back({"clock_drift_ms", number_text(1e3 * drift->gained_s, 3)});
    done.warnings.push_back(session.warning());
    done.files.push_back(file.name + ".csv");
    write_ticks(session, folder / done.files.front(), progress);
    return done;
}

void export_one(const std::filesystem::path& file, const std::filesystem::path& csv) {
    Session session(file);
    session.rescue_if_damaged();
    print_warning(session.warning());
    {
        StoppableWork work("Exporting", csv);
        write_ticks(session, csv, [&work](double share) { work.show(share); });
    }
    if (csv != "-") print_clock(session);
}

}  // namespace

int run_export(CLI::App& app, const Arguments& arguments) {
    BatchOptions batch;
    std::filesystem::path csv;
    add_sessions(app, batch, "Folder for NAME.csv of each session, and export.csv, their summary");
    add_file(app, "--csv", csv, "One row for each tick, of one session; - is standard output");
    app.footer(columns_help() +
               "\nExamples:\n"
               "  dibhr export mine.dibhr --csv mine.csv\n"
               "  dibhr export mine.dibhr --csv - | head\n"
               "  dibhr export recordings --out ticks");
    if (!parse(app, arguments)) return 0;
    if (batch.is_batch()) {
        if (!csv.empty() || (batch.out.empty() && !batch.list))
            throw UsageError(
                "export writes several sessions into a folder: give --out DIR, and no --csv");
        return run_batch(
            app,
            {.command = "export",
             .title = "Exporting",
             .work =
                 [](const GivenFile& file, const auto& folder, const WorkProgress& progress) {
                     return export_into(folder, file, progress);
                 }},
            batch);
    }
    if (csv.empty())
        throw UsageError("--csv is required, or --out DIR for many (see dibhr export --help)");
    export_one(batch.file(), csv);
    return 0;
}

}  // namespace dibhr
