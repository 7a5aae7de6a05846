// Asks for them one after the other.
#include "device/inverse3/kept_settings.hpp"

#include <simdjson.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "core/files/plain_text.hpp"
#include "device/inverse3/service_link.hpp"

namespace dibhr::inverse3 {

namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr std::chrono::milliseconds kTakes{300};
constexpr std::size_t kLongest = 120;

std::string shortened(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

/// What stands around a value, and not for one: an answer's own envelope, and a switch, whose value
/// says it all.
bool is_said_by_itself(std::string_view key) {
    constexpr std::array<std::string_view, 6> kKeys{"ok",   "enabled", "value",
                                                    "data", "result",  "device_id"};
    return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

std::string joined(const std::string& name, const std::string& value) {
    return name.empty() ? value : value.empty() ? name : name + " " + value;
}

std::string words_of(const element& value, const std::string& name);

void add(std::string& words, const std::string& more) {
    if (more.empty()) return;
    words += (words.empty() ? "" : ", ") + more;
}

std::string words_of(const object& members, const std::string& name) {
    std::string words;
    for (const auto& [key, value] : members) {
        if (key == "ok" || key == "device_id") continue;
        std::string spoken(key);
        std::replace(spoken.begin(), spoken.end(), '_', ' ');
        add(words, words_of(value, is_said_by_itself(key) ? name : joined(name, spoken)));
    }
    return words;
}

std::string words_of(const array& values, const std::string& name) {
    std::string words;
    for (const element& value : values) add(words, words_of(value, {}));
    return joined(name, words);
}

std::string words_of(const element& value, const std::string& name) {
    switch (value.type()) {
        case simdjson::dom::element_type::OBJECT:
            return words_of(object(value), name);
        case simdjson::dom::element_type::ARRAY:
            return words_of(array(value), name);
        case simdjson::dom::element_type::BOOL:
            return joined(name, bool(value) ? "on" : "off");
        case simdjson::dom::element_type::STRING:
            return joined(name, std::string(std::string_view(value)));
        case simdjson::dom::element_type::NULL_VALUE:
            return joined(name, "none");
        default:
            return joined(name, short_text(double(value)));
    }
}

/// Of an answer that says that there is none.
std::optional<std::string> refusal_in(const element& value) {
    object members;
    bool ok = true;
    if (value.get(members) != simdjson::SUCCESS || members["ok"].get(ok) != simdjson::SUCCESS || ok)
        return std::nullopt;
    std::string_view why;
    if (members["error"].get(why) != simdjson::SUCCESS) why = "refused";
    return std::string(why);
}

/// Empty: nothing.
std::string told_of(const ConnectionOptions& options, const std::string& target) {
    try {
        return http_get(options.port, target, ServiceLink::Time::clock::now() + kTakes);
    } catch (const LinkError&) {
        return {};
    }
}

}  // namespace

std::string words_of_setting(std::string_view told) {
    simdjson::dom::parser parser;
    element value;
    // The parser reads a little beyond the end: of a copy of its own.
    if (parser.parse(told.data(), told.size(), true).get(value) != simdjson::SUCCESS)
        return shortened(std::string(told));
    if (const auto refusal = refusal_in(value)) return "not told: " + shortened(*refusal);
    const std::string words = words_of(value, {});
    return shortened(words.empty() ? std::string(told) : words);
}

std::vector<KeptSetting> ask_kept_settings(const ConnectionOptions& options,
                                           const std::string& device) {
    const std::string config = "/inverse3/" + device + "/config/";
    const std::array<std::pair<const char*, std::string>, 4> questions{
        {{"gravity compensation", config + "gravity_compensation"},
         {"torque scaling", config + "torque_scaling"},
         {"filters", config + "filters"},
         {"force scale", "/settings/devices/force_scale"}}};
    std::vector<KeptSetting> kept;
    for (const auto& [name, target] : questions) {
        const std::string told = told_of(options, target);
        if (!told.empty()) kept.push_back({name, words_of_setting(told), shortened(told)});
    }
    return kept;
}

}  // namespace dibhr::inverse3
