// Reads the settings that the service keeps for all programs, one after the other.
#include "device/inverse3/kept_settings.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "device/inverse3/service_link.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::chrono::milliseconds kSettingTimeout{300};
constexpr std::size_t kLongest = 120;
constexpr std::size_t kLongestRead = 4096;

std::string shortened(const std::string& answer) {
    const std::string text = one_line(answer);
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

/// A key that adds nothing to its value, such as the envelope of an answer, or a switch.
bool is_said_by_itself(std::string_view key) {
    constexpr std::array<std::string_view, 4> kKeys{"enabled", "value", "data", "result"};
    return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

std::string joined(const std::string& name, const std::string& value) {
    return name.empty() ? value : value.empty() ? name : name + " " + value;
}

void add(std::string& words, const std::string& more) {
    if (more.empty()) return;
    words += (words.empty() ? "" : ", ") + more;
}

std::string words_of(const Json& value, const std::string& name) {
    std::string words;
    switch (value.type()) {
        case Json::value_t::object:
            for (const auto& [key, member] : value.items()) {
                if (key == "ok" || key == "device_id") continue;
                std::string spoken(key);
                std::replace(spoken.begin(), spoken.end(), '_', ' ');
                add(words, words_of(member, is_said_by_itself(key) ? name : joined(name, spoken)));
            }
            return words;
        case Json::value_t::array:
            for (const Json& one : value) add(words, words_of(one, {}));
            return joined(name, words);
        case Json::value_t::boolean:
            return joined(name, value.get<bool>() ? "on" : "off");
        case Json::value_t::string:
            return joined(name, value.get<std::string>());
        case Json::value_t::null:
            return joined(name, "none");
        default:
            return joined(name, short_text(value.get<double>()));
    }
}

/// The reason in an answer that reports an error.
std::optional<std::string> refusal_in(const Json& value) {
    if (!value.is_object() || value.value("ok", Json(true)) != Json(false)) return std::nullopt;
    const Json why = value.value("error", Json());
    return why.is_string() ? why.get<std::string>() : "refused";
}

/// The answer of the service; empty: none.
std::string answer_of(const ConnectionOptions& options, const std::string& target) {
    try {
        return http_get(options.port, target, ServiceLink::Time::clock::now() + kSettingTimeout);
    } catch (const LinkError&) {
        return {};
    }
}

}  // namespace

std::string setting_text(std::string_view answer) {
    const Json value =
        answer.size() > kLongestRead ? Json(Json::value_t::discarded) : parsed_json(answer);
    if (value.is_discarded()) return shortened(std::string(answer));
    if (const auto refusal = refusal_in(value)) return "not told: " + shortened(*refusal);
    const std::string words = words_of(value, {});
    return shortened(words.empty() ? std::string(answer) : words);
}

std::vector<KeptSetting> fetch_kept_settings(const ConnectionOptions& options,
                                             const std::string& device) {
    const std::string config = "/inverse3/" + device + "/config/";
    const std::array<std::pair<const char*, std::string>, 4> questions{
        {{"gravity compensation", config + "gravity_compensation"},
         {"torque scaling", config + "torque_scaling"},
         {"filters", config + "filters"},
         {"force scale", "/settings/devices/force_scale"}}};
    std::vector<KeptSetting> kept;
    for (const auto& [name, target] : questions) {
        const std::string answer = answer_of(options, target);
        if (!answer.empty()) kept.push_back({name, setting_text(answer), shortened(answer)});
    }
    return kept;
}

}  // namespace dibhr::inverse3
