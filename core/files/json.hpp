// JSON by nlohmann's library, its members in the order in which they were added.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dibhr {

using Json = nlohmann::ordered_json;

/// A list of what `to_json` makes of each item.
template <typename Items, typename ToJson>
[[nodiscard]] Json json_list(const Items& items, ToJson to_json) {
    Json list = Json::array();
    for (const auto& item : items) list.push_back(to_json(item));
    return list;
}

/// Indented, with a line break at the end. Numbers read back to the same bits; what is not finite
/// becomes null, and bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(const Json& json);

/// Likewise in one line, without a line break.
[[nodiscard]] std::string json_line(const Json& json);

/// The finite number of that name; nothing where an object has none, or for another value.
[[nodiscard]] std::optional<double> finite_number_in(const Json& object, const char* name);

/// A discarded value when the text is no JSON.
[[nodiscard]] Json parsed_json(std::string_view text);

}  // namespace dibhr
