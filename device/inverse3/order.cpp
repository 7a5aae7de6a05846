// Writes messages to the service.
#include "device/inverse3/order.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>

namespace dibhr::inverse3 {

namespace {

constexpr std::string_view kSession = "dibhr:viewer";  // what the Haply Hub shows

}  // namespace

const char* name_of(ForceDialect dialect) noexcept {
    return dialect == ForceDialect::vector ? "vector" : "values";
}

std::string_view OrderWriter::write(const Order& order) noexcept {
    size_ = 0;
    add("{");
    add_session(order);
    add_arm(order);
    add("}");
    return {text_.data(), size_};
}

void OrderWriter::add_session(const Order& order) noexcept {
    if (!order.introduces && !order.whole_state) return;
    add("\"session\":{");
    if (order.introduces) {
        add("\"configure\":{\"profile\":{\"name\":");
        add_quoted(kSession);
        add("}}");
    }
    if (order.introduces && order.whole_state) add(",");
    if (order.whole_state) add("\"force_render_full_state\":{}");
    add(order.arm.empty() ? "}" : "},");
}

void OrderWriter::add_arm(const Order& order) noexcept {
    if (order.arm.empty()) return;
    add("\"inverse3\":[{\"device_id\":");
    add_quoted(order.arm.view());
    if (!order.preset.empty()) {
        add(",\"configure\":{\"preset\":{\"preset\":");
        add_quoted(order.preset.view());
        add("}}");
    }
    add(",\"commands\":{");
    if (order.force_newton) {
        add_force(*order.force_newton, order.dialect);
    } else {
        add("\"probe_position\":{}");
    }
    add("}}]");
}

void OrderWriter::add_force(Vec3 force_newton, ForceDialect dialect) noexcept {
    const Vec3 force = is_finite(force_newton) ? force_newton : Vec3{0.0};
    add("\"set_cursor_force\":{\"");
    add(name_of(dialect));
    add("\":{\"x\":");
    add_number(force.x);
    add(",\"y\":");
    add_number(force.y);
    add(",\"z\":");
    add_number(force.z);
    add("}}");
}

void OrderWriter::add(std::string_view text) noexcept {
    assert(size_ + text.size() <= text_.size());
    const std::size_t fits = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), fits, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += fits;
}

void OrderWriter::add_quoted(std::string_view text) noexcept {
    constexpr std::string_view kHex = "0123456789abcdef";
    add("\"");
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            const std::array<char, 2> escaped{'\\', c};
            add({escaped.data(), escaped.size()});
        } else if (byte < 0x20) {
            const std::array<char, 6> escaped{
                '\\', 'u', '0', '0', kHex[byte >> 4U], kHex[byte & 15U]};
            add({escaped.data(), escaped.size()});
        } else {
            add({&c, 1});
        }
    }
    add("\"");
}

void OrderWriter::add_number(double number) noexcept {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    add({digits.data(), static_cast<std::size_t>(end.ptr - digits.data())});
}

}  // namespace dibhr::inverse3
