// Formats the rows of a computed stream of touches.
#include "app/commands/output_rows.hpp"

#include <array>
#include <charconv>

namespace dibhr {
namespace {

void append_vector(std::string& text, const Vec3& vector) {
    for (const double value : {vector.x, vector.y, vector.z}) {
        append_real(text, value);
        text += ',';
    }
}

}  // namespace

OutputRow row_of(double t_s, const Touch& touch, std::int64_t update_ns) {
    OutputRow row;
    row.t_s = t_s;
    row.goal = touch.goal;
    row.proxy = touch.proxy.position;
    row.spring_newton = touch.spring_force_newton;
    row.sent_newton = touch.sent_force_newton;
    row.contact = touch.proxy.contact;
    row.primitive = touch.proxy.active.kind;
    row.i = touch.proxy.active.i;
    row.j = touch.proxy.active.j;
    row.moves = touch.proxy.moves;
    row.update_ns = update_ns;
    return row;
}

void append_real(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                      std::chars_format::general, 17);
    text.append(digits.data(), result.ptr);
}

void append_row(std::string& text, const OutputRow& row) {
    append_real(text, row.t_s);
    text += ',';
    append_vector(text, row.goal);
    append_vector(text, row.proxy);
    append_vector(text, row.spring_newton);
    append_vector(text, row.sent_newton);
    text += row.contact ? "1," : "0,";
    text += name_of(row.primitive);
    for (const auto number :
         {std::int64_t{row.i}, std::int64_t{row.j}, std::int64_t{row.moves}, row.update_ns}) {
        text += ',';
        text += std::to_string(number);
    }
    text += '\n';
}

}  // namespace dibhr
