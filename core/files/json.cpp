// Reading and writing JSON, which the library has in its headers, compiled once.
#include "core/files/json.hpp"

#include <cmath>

namespace dibhr {

namespace {

std::string written(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const Json& json) {
    return written(json, 2) + '\n';
}

std::string json_line(const Json& json) {
    return written(json, -1);
}

std::optional<double> finite_number_in(const Json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    const double number = found->get<double>();
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

Json parsed_json(std::string_view text) {
    return Json::parse(text.begin(), text.end(), nullptr, false);
}

}  // namespace dibhr
