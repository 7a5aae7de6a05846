// Reading and writing JSON, which the library has in its headers, compiled once.
#include "core/files/json.hpp"

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

Json parsed_json(std::string_view text) {
    return Json::parse(text.begin(), text.end(), nullptr, false);
}

}  // namespace dibhr
