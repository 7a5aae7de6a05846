// The fields of a report: each value is described once, for JSON, CSV and the page's table.
#pragma once

#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/report/page_parts.hpp"

namespace dibhr {

/// A value's names in JSON and CSV; empty: it is left out there.
struct FieldName {
    FieldName(const char* in_both) : FieldName(std::string(in_both)) {}
    FieldName(const std::string& in_both) : json("/" + in_both), csv(in_both) {}
    FieldName(const char* in_json, const char* in_csv) : json(in_json), csv(in_csv) {}

    std::string json;  ///< "/sent/mean_newton": a member of the object "sent" (RFC 6901)
    std::string csv;
};

/// The values of one thing, filled in order.
struct Fields {
    Json json = Json::object();
    std::string csv_head{}, csv_line{};  ///< names and values (a truth as 1 or 0, null as nothing)
    Cells heads{}, cells{};              ///< columns of the page, as HTML

    /// For scripts; null: not known.
    void add(const FieldName& name, const Json& value);
    /// On the page, as HTML.
    void show(const std::string& head, const std::string& html);

    // For scripts and page: a text or a whole number; a number with `digits` after the point; one
    // with `digits` significant digits.
    void plain(const FieldName& name, const Json& value, const char* head);
    void fixed(const FieldName& name, double value, int digits, const char* head);
    void significant(const FieldName& name, double value, int digits, const char* head);
};

/// A table with a row of fields from `describe` for each item; empty without items.
template <typename Items, typename Describe>
[[nodiscard]] std::string table_of(const Items& items, const Describe& describe) {
    Cells heads;
    std::vector<Cells> rows;
    for (const auto& item : items) {
        const Fields row = describe(item);
        heads = row.heads;
        rows.push_back(row.cells);
    }
    return rows.empty() ? std::string() : table_of(heads, rows);
}

/// A cell without a value.
inline constexpr const char* kNoCell = "&ndash;";
/// With `digits` significant digits; kNoCell for a value that is not finite.
[[nodiscard]] std::string number_cell(double value, int digits = 3);
/// Plain text that breaks where it must.
[[nodiscard]] std::string text_cell(const std::string& text);

}  // namespace dibhr
