// JSON, written by hand: objects and lists of numbers and names, for scripts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dibhr {

/// The shortest text that reads back to the same number; "null" for what is not finite, which JSON
/// does not have.
[[nodiscard]] std::string json_number(double value);

/// In quotation marks. The bytes of other languages' letters stay as they are.
[[nodiscard]] std::string json_quoted(std::string_view text);

/// One object: `add` its members, then take the text.
class JsonObject {
  public:
    JsonObject& add(std::string_view name, const std::string& json);
    JsonObject& add(std::string_view name, double value) { return add(name, json_number(value)); }
    JsonObject& add(std::string_view name, std::int64_t value) {
        return add(name, std::to_string(value));
    }
    JsonObject& add(std::string_view name, std::uint64_t value) {
        return add(name, std::to_string(value));
    }
    JsonObject& add(std::string_view name, int value) { return add(name, std::to_string(value)); }
    JsonObject& add_text(std::string_view name, std::string_view value) {
        return add(name, json_quoted(value));
    }
    [[nodiscard]] std::string text() const { return "{" + text_ + "}"; }

  private:
    std::string text_{};
};

/// Each item on a line of its own, indented.
template <typename Items, typename ToJson>
[[nodiscard]] std::string json_list(const Items& items, const std::string& indent, ToJson to_json) {
    std::string text = "[";
    const char* separator = "\n";
    for (const auto& item : items) {
        text += separator + indent + to_json(item);
        separator = ",\n";
    }
    return text + "]";
}

}  // namespace dibhr
