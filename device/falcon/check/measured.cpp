// What was measured, as indented JSON.
#include "device/falcon/check/measured.hpp"

#include <utility>

#include "core/files/json_text.hpp"

namespace dibhr::falcon {

namespace {

/// One item a line, two spaces further in.
std::string nested(const std::vector<std::string>& items, char open, char close) {
    std::string text(1, open);
    for (const std::string& item : items) {
        text += text.size() == 1 ? "\n  " : ",\n  ";
        for (const char c : item) {
            text += c;
            if (c == '\n') text += "  ";
        }
    }
    return items.empty() ? text + close : text + '\n' + close;
}

std::string in_one_line(const std::vector<std::string>& items) {
    std::string text = "[";
    for (const std::string& item : items) text += (text.size() == 1 ? "" : ", ") + item;
    return text + "]";
}

}  // namespace

MeasuredList& MeasuredList::add(double value) {
    items_.push_back(json_number(value));
    return *this;
}

MeasuredList& MeasuredList::add(const Measured& object) {
    items_.push_back(object.text());
    has_objects_ = true;
    return *this;
}

std::string MeasuredList::text() const {
    return has_objects_ ? nested(items_, '[', ']') : in_one_line(items_);
}

Measured& Measured::add_json(std::string_view name, std::string json) {
    members_.push_back(json_quoted(name) + ": " + std::move(json));
    return *this;
}

Measured& Measured::add(std::string_view name, std::string_view text) {
    return add_json(name, json_quoted(text));
}

Measured& Measured::add(std::string_view name, const char* text) {
    return add_json(name, json_quoted(text));
}

Measured& Measured::add(std::string_view name, bool value) {
    return add_json(name, value ? "true" : "false");
}

Measured& Measured::add(std::string_view name, double value) {
    return add_json(name, json_number(value));
}

Measured& Measured::add(std::string_view name, int value) {
    return add_json(name, std::to_string(value));
}

Measured& Measured::add(std::string_view name, std::uint64_t value) {
    return add_json(name, std::to_string(value));
}

Measured& Measured::add(std::string_view name, const Measured& value) {
    return add_json(name, value.text());
}

Measured& Measured::add(std::string_view name, const MeasuredList& value) {
    return add_json(name, value.text());
}

Measured& Measured::add(std::string_view name, Vec3 value) {
    return add(name, MeasuredList().add(value.x).add(value.y).add(value.z));
}

Measured& Measured::add(std::string_view name, const Counts& value) {
    MeasuredList counts;
    for (const auto count : value) counts.add(static_cast<double>(count));
    return add(name, counts);
}

Measured& Measured::add_null(std::string_view name) {
    return add_json(name, "null");
}

std::string Measured::text() const {
    return nested(members_, '{', '}');
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        if (!text.empty()) text += ' ';
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

}  // namespace dibhr::falcon
