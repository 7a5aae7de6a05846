// Formats the rows of a computed stream of touches.
#include "app/output_rows.hpp"

#include <array>
#include <charconv>

namespace dibhr {
namespace {

void append_real(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                      std::chars_format::general, 17);
    text.append(digits.data(), result.ptr);
    text += ',';
}

void append_vector(std::string& text, const Vec3& vector) {
    append_real(text, vector.x);
    append_real(text, vector.y);
    append_real(text, vector.z);
}

}  // namespace

void append_row(std::string& text, const OutputRow& row) {
    append_real(text, row.t_s);
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
