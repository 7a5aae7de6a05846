// Rows of a query as CSV: NULL is an empty cell, reals have 17 significant digits.
#pragma once

#include <string>

#include "core/sqlite/database.hpp"

namespace dibhr {

/// Appends the line of the columns' names.
void append_names(std::string& text, const Statement& rows);
/// Appends the line of the present row.
void append_row(std::string& text, const Statement& rows);

}  // namespace dibhr
