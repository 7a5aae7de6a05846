// Writes messages to the service.
#include "device/inverse3/service_request.hpp"

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

std::string_view RequestWriter::write(const ServiceRequest& request) noexcept {
    size_ = 0;
    add("{");
    add_session(request);
    add_arm(request);
    add("}");
    return {text_.data(), size_};
}

void RequestWriter::add_session(const ServiceRequest& request) noexcept {
    if (!request.sets_session_name && !request.whole_state) return;
    add("\"session\":{");
    if (request.sets_session_name) {
        add("\"configure\":{\"profile\":{\"name\":");
        add_quoted(kSession);
        add("}}");
    }
    if (request.sets_session_name && request.whole_state) add(",");
    if (request.whole_state) add("\"force_render_full_state\":{}");
    add(request.arm.empty() ? "}" : "},");
}

void RequestWriter::add_arm(const ServiceRequest& request) noexcept {
    if (request.arm.empty()) return;
    add("\"inverse3\":[{\"device_id\":");
    add_quoted(request.arm.view());
    if (!request.preset.empty()) {
        add(",\"configure\":{\"preset\":{\"preset\":");
        add_quoted(request.preset.view());
        add("}}");
    }
    add(",\"commands\":{");
    if (request.force_newton) {
        add_force(*request.force_newton, request.dialect);
    } else {
        add("\"probe_position\":{}");
    }
    add("}}]");
}

void RequestWriter::add_force(Vec3 force_newton, ForceDialect dialect) noexcept {
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

void RequestWriter::add(std::string_view text) noexcept {
    assert(size_ + text.size() <= text_.size());
    const std::size_t fits = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), fits, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += fits;
}

void RequestWriter::add_quoted(std::string_view text) noexcept {
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

void RequestWriter::add_number(double number) noexcept {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    add({digits.data(), static_cast<std::size_t>(end.ptr - digits.data())});
}

}  // namespace dibhr::inverse3
