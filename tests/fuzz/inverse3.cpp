// The text of a service that is none: what is read of it is bounded and finite, and it is read the
// same a second time.
#include <cmath>
#include <string_view>

#include "device/inverse3/kept_settings.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/service_request.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;
using namespace dibhr::inverse3;

namespace {

void require_safe(const Arm& arm) {
    test::require_rule(!arm.id.empty(), "an arm has a name");
    test::require_rule(!arm.position_m || is_finite(*arm.position_m), "a position is finite");
    test::require_rule(!arm.force_newton || is_finite(*arm.force_newton), "a force is finite");
}

void require_safe(const Grip& grip) {
    test::require_rule(grip.buttons < 16, "there are four buttons");
    const double battery = grip.battery.value_or(0.0);
    test::require_rule(battery >= 0.0 && battery <= 1.0, "a battery is between empty and full");
}

bool same(const ServiceMessage& a, const ServiceMessage& b) {
    return a.arm_count == b.arm_count && a.grip_count == b.grip_count &&
           a.error_text == b.error_text && (a.arm_count == 0 || a.arms[0].id == b.arms[0].id);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static MessageReader reader;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    ServiceMessage message;
    ServiceMessage again;
    const bool understood = reader.read(text, message);
    test::require_rule(understood == reader.read(text, again) && same(message, again),
                       "what was read before changes nothing");
    test::require_rule(understood || message.arm_count + message.grip_count == 0,
                       "nothing is known of what is not understood");
    test::require_rule(setting_text(text).size() < 200, "a setting is told in a line");
    RequestWriter writer;
    for (std::size_t k = 0; k < message.arm_count; ++k) {
        require_safe(message.arms[k]);
        const std::string_view request = writer.write(
            {.arm = message.arms[k].id, .sets_session_name = true, .whole_state = true});
        test::require_rule(request.ends_with("}}]}"), "an order for any arm is whole");
    }
    for (std::size_t k = 0; k < message.grip_count; ++k) require_safe(message.grips[k]);
    return 0;
}
