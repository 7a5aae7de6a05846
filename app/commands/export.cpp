// `dibhr export`: the view `tick` as text.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"
#include "core/session/session.hpp"
#include "core/sqlite/csv_rows.hpp"

namespace dibhr {

namespace {

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

}  // namespace

int run_export(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path file;
    std::filesystem::path csv;
    add_session(app, file);
    add_file(app, "--csv", csv, "One row for each tick; - is standard output")->required();
    app.footer(
        "The columns of `dibhr touch` come first; table tick_column of the session explains all.\n"
        "\nExamples:\n"
        "  dibhr export mine.dibhr --csv mine.csv\n"
        "  dibhr export mine.dibhr --csv - | head");
    if (!parse(app, arguments)) return 0;
    const Session session(file);
    session.check();
    print_warning(session.warning());
    Statement ticks = session.reader().rows("SELECT * FROM tick ORDER BY tick");
    RowFile rows(csv, {file}, "is the session that is read; give --csv another name");
    ProgressBar bar("Exporting");
    append_names(rows.text(), ticks);
    for (std::int64_t done = 0; ticks.next(); ++done) {
        append_row(rows.text(), ticks);
        rows.rows_done();
        if (done % kRowsPerStep == 0)
            bar.show(static_cast<double>(done) / static_cast<double>(session.rows()));
    }
    rows.commit();
    if (csv != "-") print_clock(session);
    return 0;
}

}  // namespace dibhr
