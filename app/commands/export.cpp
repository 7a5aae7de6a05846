// `dibhr export`: the view `tick` as text.
#include "app/commands/export.hpp"

#include <cstdint>
#include <string>

#include "app/commands/output_rows.hpp"
#include "app/commands/progress_bar.hpp"
#include "app/commands/session_rows.hpp"
#include "core/files/error_line.hpp"
#include "core/session/session.hpp"

namespace dibhr {

namespace {

constexpr std::int64_t kRowsPerStep = 10000;  // of the progress bar

void append_cell(std::string& text, const SessionReader::Query& ticks, int column) {
    switch (ticks.kind(column)) {
        case SessionReader::Kind::nothing:
            break;
        case SessionReader::Kind::integer:
            text += std::to_string(ticks.integer(column));
            break;
        case SessionReader::Kind::real:
            append_real(text, ticks.real(column));
            break;
        case SessionReader::Kind::text:
            text += ticks.text(column);
            break;
    }
}

}  // namespace

int run_export(const ExportOptions& options) {
    const Session session(options.session);
    session.check();
    print_warning(session.warning());
    SessionReader::Query ticks(session.reader(), "SELECT * FROM tick ORDER BY tick");
    SessionRows rows(options.csv, options.session);
    ProgressBar bar("Exporting");
    const auto add_row = [&](auto append) {
        for (int column = 0; column < ticks.columns(); ++column) {
            if (column > 0) rows.text() += ',';
            append(column);
        }
        rows.text() += '\n';
        rows.row_done();
    };
    add_row([&](int column) { rows.text() += ticks.name(column); });
    for (std::int64_t done = 0; ticks.next(); ++done) {
        add_row([&](int column) { append_cell(rows.text(), ticks, column); });
        if (done % kRowsPerStep == 0) {
            bar.show(static_cast<double>(done) / static_cast<double>(session.rows()));
        }
    }
    rows.commit();
    return 0;
}

}  // namespace dibhr
