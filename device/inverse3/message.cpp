// Reads the service's JSON with simdjson, whose parser keeps its memory.
#include "device/inverse3/message.hpp"

#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace dibhr::inverse3 {

namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr double kFarthest_m = 2.0;  // twice what an arm spans
constexpr double kFastest_m_per_s = 1e3;
constexpr double kStrongest_newton = 1e3;  // a larger value is not valid

/// The object's member, or nothing.
std::optional<element> member(const object& from, std::string_view key) noexcept {
    element found;
    if (from[key].get(found) != simdjson::SUCCESS) return {};
    return found;
}

std::optional<object> object_in(const object& from, std::string_view key) noexcept {
    const auto found = member(from, key);
    object inner;
    if (!found || found->get(inner) != simdjson::SUCCESS) return {};
    return inner;
}

std::string_view text_in(const object& from, std::string_view key) noexcept {
    const auto found = member(from, key);
    std::string_view text;
    if (!found || found->get(text) != simdjson::SUCCESS) return {};
    return text;
}

bool flag_in(const std::optional<object>& from, std::string_view key, bool otherwise) noexcept {
    const auto found = from ? member(*from, key) : std::nullopt;
    bool flag = otherwise;
    return found && found->get(flag) == simdjson::SUCCESS ? flag : otherwise;
}

/// Accepts integers, too.
std::optional<double> number_in(const object& from, std::string_view key) noexcept {
    const auto found = member(from, key);
    double number = 0.0;
    if (!found || found->get(number) != simdjson::SUCCESS || !std::isfinite(number)) return {};
    return number;
}

std::optional<Vec3> vector_in(const std::optional<object>& from, std::string_view key,
                              double longest) noexcept {
    const auto inner = from ? object_in(*from, key) : std::nullopt;
    if (!inner) return {};
    const auto x = number_in(*inner, "x");
    const auto y = number_in(*inner, "y");
    const auto z = number_in(*inner, "z");
    if (!x || !y || !z) return {};
    const bool sensible =
        std::abs(*x) <= longest && std::abs(*y) <= longest && std::abs(*z) <= longest;
    return sensible ? std::optional<Vec3>({*x, *y, *z}) : std::nullopt;
}

Handedness handedness_of(std::string_view word) noexcept {
    if (word == "left") return Handedness::left;
    return word == "right" ? Handedness::right : Handedness::unknown;
}

std::optional<ArmConfig> config_in(const object& device) noexcept {
    const auto answer = object_in(device, "config");
    if (!answer) return {};
    ArmConfig config;
    config.minverse = text_in(*answer, "type") == "minverse";
    config.handedness = handedness_of(text_in(*answer, "handedness"));
    config.preset = text_in(*answer, "preset");
    if (const auto basis = object_in(*answer, "basis")) {
        config.basis = text_in(*basis, "permutation");
    }
    return config;
}

Arm arm_of(const object& device) noexcept {
    Arm arm;
    arm.config = config_in(device);
    const auto state = object_in(device, "state");
    arm.position_m = vector_in(state, "cursor_position", kFarthest_m);
    arm.velocity_m_per_s = vector_in(state, "cursor_velocity", kFastest_m_per_s);
    arm.force_newton = vector_in(state, "current_cursor_force", kStrongest_newton);
    const auto status = object_in(device, "status");
    arm.calibrated = flag_in(status, "calibrated", false);
    arm.powered = flag_in(status, "power_supply", true);
    arm.in_use = flag_in(status, "in_use", false);
    arm.locked = arm.calibrated && arm.powered && !flag_in(status, "ready", true);
    return arm;
}

/// Sources name the same buttons in two ways.
std::uint8_t buttons_in(const std::optional<object>& state) noexcept {
    constexpr std::array<std::array<const char*, 2>, 4> kNames{
        {{"a", "button_0"}, {"b", "button_1"}, {"c", "button_2"}, {"home", "button_3"}}};
    const auto buttons = state ? object_in(*state, "buttons") : std::nullopt;
    std::uint8_t bits = flag_in(state, "button", false) ? 1U : 0U;  // a wired grip's only one
    for (std::size_t k = 0; k < kNames.size(); ++k) {
        const bool down =
            flag_in(buttons, kNames[k][0], false) || flag_in(buttons, kNames[k][1], false);
        if (down) bits = static_cast<std::uint8_t>(bits | 1U << k);
    }
    return bits;
}

Grip grip_of(const object& device, bool wired) noexcept {
    Grip grip;
    grip.wired = wired;
    const auto state = object_in(device, "state");
    const auto status = object_in(device, "status");
    grip.buttons = buttons_in(state);
    grip.connected = flag_in(status, "connected", true);
    grip.awake = flag_in(status, "awake", true);
    const auto battery = state ? number_in(*state, "battery_level") : std::nullopt;
    if (battery) grip.battery = std::clamp(*battery, 0.0, 1.0);
    return grip;
}

/// Reads every device of the list `key` with `make`, and appends it to `into`.
template <typename Device, typename Make>
void read_list(const object& from, std::string_view key,
               std::array<Device, ServiceMessage::kMost>& into, std::size_t& count,
               Make make) noexcept {
    const auto found = member(from, key);
    array list;
    if (!found || found->get(list) != simdjson::SUCCESS) return;
    for (const element entry : list) {
        object device;
        if (count == into.size() || entry.get(device) != simdjson::SUCCESS) continue;
        const std::string_view name = text_in(device, "device_id");
        DeviceId id;
        // An ID that does not fit is not used: cut, it could be another device's.
        if (name.empty() || !id.assign(name)) continue;
        into[count] = make(device);
        into[count].id = id;
        ++count;
    }
}

void read_message(const object& root, ServiceMessage& message) noexcept {
    message.has_session = member(root, "session_id").has_value();
    message.error_text = text_in(root, "error");
    read_list(root, "inverse3", message.arms, message.arm_count, arm_of);
    read_list(root, "minverse", message.arms, message.arm_count, arm_of);
    const auto wireless = [](const object& device) noexcept { return grip_of(device, false); };
    const auto wired = [](const object& device) noexcept { return grip_of(device, true); };
    read_list(root, "wireless_verse_grip", message.grips, message.grip_count, wireless);
    read_list(root, "verse_grip", message.grips, message.grip_count, wired);
    read_list(root, "custom_verse_grip", message.grips, message.grip_count, wireless);
}

}  // namespace

const Arm* ServiceMessage::arm(const DeviceId& id) const noexcept {
    const auto* const end = arms.begin() + arm_count;
    const auto* const found =
        std::find_if(arms.begin(), end, [&](const Arm& one) { return one.id == id; });
    return found == end ? nullptr : found;
}

struct MessageReader::Parser {
    simdjson::dom::parser dom{kLongest_bytes};
    std::vector<char> text = std::vector<char>(kLongest_bytes + simdjson::SIMDJSON_PADDING);
};

MessageReader::MessageReader() : parser_(std::make_unique<Parser>()) {
    // Parses a text of the greatest length, so that the parser allocates all its memory now.
    std::string longest(kLongest_bytes, ' ');
    longest.front() = '{';
    longest.back() = '}';
    ServiceMessage nothing;
    if (!read(longest, nothing)) throw std::bad_alloc{};
}

MessageReader::~MessageReader() = default;

bool MessageReader::read(std::string_view text, ServiceMessage& message) noexcept {
    message = {};
    if (text.empty() || text.size() > kLongest_bytes) return false;
    std::memcpy(parser_->text.data(), text.data(), text.size());
    object root;
    if (parser_->dom.parse(parser_->text.data(), text.size(), false).get(root) !=
        simdjson::SUCCESS) {
        return false;
    }
    read_message(root, message);
    return true;
}

}  // namespace dibhr::inverse3
