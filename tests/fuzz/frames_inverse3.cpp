// A client's bytes, cut anywhere: the simulated service finds the same frames, however they come,
// and what they mean to it is told without a fault.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/inverse3/simulated/frames.hpp"
#include "device/inverse3/simulated/scene.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;
using namespace dibhr::inverse3;

namespace {

/// What the frames hold, when the bytes come `at_a_time`.
std::vector<std::string> payloads_of(std::string_view bytes, std::size_t at_a_time) {
    std::vector<std::string> payloads;
    std::string came;
    for (std::size_t at = 0; at < bytes.size(); at += at_a_time) {
        came += bytes.substr(at, at_a_time);
        for (std::size_t before = came.size();; before = came.size()) {
            auto frame = simulated::take_frame(came);
            if (!frame) break;
            test::require_rule(came.size() < before, "a frame has bytes, and they are taken");
            payloads.push_back(std::move(frame->payload));
        }
    }
    return payloads;
}

}  // namespace

/// The first byte says how many come at a time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::vector<std::string> payloads = payloads_of(bytes, bytes.size());
    test::require_rule(payloads_of(bytes, 1U + data[0]) == payloads,
                       "the frames are the same, however their bytes come");
    simulated::Scene scene;
    for (const std::string& payload : payloads) {
        (void)simulated::apply_message(scene, payload, {});
        test::require_rule(!simulated::state_text(scene, true).empty(), "it goes on to answer");
    }
    return 0;
}
