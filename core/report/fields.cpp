// A JSON object, a line of CSV and a row of a table, filled value by value.
#include "core/report/fields.hpp"

#include <cmath>

#include "core/files/csv_table.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

std::string csv_text(const Json& value) {
    if (value.is_null()) return {};
    if (value.is_string()) return csv_cell(value.get<std::string>());
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    if (!value.is_number_float()) return json_line(value);
    std::string number;
    append_number(number, value.get<double>());
    return number;
}

}  // namespace

void Fields::add(const FieldName& name, const Json& value) {
    if (!name.json.empty())
        json[Json::json_pointer(name.json)] =
            value.is_string() ? Json(utf8_text(value.get<std::string>())) : value;
    if (name.csv.empty()) return;
    const char* const comma = csv_head.empty() ? "" : ",";
    csv_head += comma + name.csv;
    csv_line += comma + csv_text(value);
}

void Fields::show(const std::string& head, const std::string& html) {
    heads.push_back(head);
    cells.push_back(html);
}

void Fields::plain(const FieldName& name, const Json& value, const char* head) {
    add(name, value);
    show(head, value.is_string() ? html_text(value.get<std::string>()) : json_line(value));
}

void Fields::fixed(const FieldName& name, double value, int digits, const char* head) {
    add(name, value);
    show(head, number_text(value, digits));
}

void Fields::significant(const FieldName& name, double value, int digits, const char* head) {
    add(name, value);
    show(head, number_cell(value, digits));
}

std::string number_cell(double value, int digits) {
    return std::isfinite(value) ? short_text(value, digits) : kNoCell;
}

std::string text_cell(const std::string& text) {
    return "<span class=\"text\">" + html_text(text) + "</span>";
}

}  // namespace dibhr
