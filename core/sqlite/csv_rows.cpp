// Rows of a query as CSV.
#include "core/sqlite/csv_rows.hpp"

#include "core/files/csv_table.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

void append_cell(std::string& text, const Statement& rows, int column) {
    switch (rows.type(column)) {
        case Statement::Type::null:
            break;
        case Statement::Type::integer:
            text += std::to_string(rows.integer(column));
            break;
        case Statement::Type::real:
            append_number(text, rows.real(column));
            break;
        case Statement::Type::text:
            text += csv_cell(rows.text(column));
            break;
    }
}

}  // namespace

void append_names(std::string& text, const Statement& rows) {
    for (int column = 0; column < rows.columns(); ++column)
        text += (column > 0 ? "," : "") + csv_cell(rows.name(column));
    text += '\n';
}

void append_row(std::string& text, const Statement& rows) {
    for (int column = 0; column < rows.columns(); ++column) {
        if (column > 0) text += ',';
        append_cell(text, rows, column);
    }
    text += '\n';
}

}  // namespace dibhr
