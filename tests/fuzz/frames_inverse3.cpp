// A service's bytes, cut anywhere: every frame ends where it ends, however the bytes come, and none
// is lost; what a client's bytes mean to the simulated service is told without a fault.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "device/inverse3/frame_bounds.hpp"
#include "device/inverse3/simulated/frames.hpp"
#include "device/inverse3/simulated/scene.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;
using namespace dibhr::inverse3;

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Where pieces end, when the bytes come `at_a_time`; of those ends every piece has, the frames'
/// are some.
std::vector<std::size_t> ends_of(Bytes bytes, std::size_t at_a_time) {
    FrameBounds bounds;
    std::vector<std::size_t> ends;
    for (std::size_t at = 0; at < bytes.size();) {
        const Bytes here = bytes.subspan(at, std::min(at_a_time, bytes.size() - at));
        const std::size_t taken = bounds.take(here);
        test::require_rule(taken > 0 && taken <= here.size(), "something is taken, and no more");
        at += taken;
        ends.push_back(at);
    }
    return ends;
}

void serve(Bytes bytes) {
    std::string came(bytes.begin(), bytes.end());
    simulated::Scene scene;
    for (std::size_t before = came.size() + 1; came.size() < before;) {
        before = came.size();
        const auto frame = simulated::take_frame(came);
        if (!frame) return;
        (void)simulated::obey(scene, frame->payload, {});
        test::require_rule(!simulated::state_text(scene, true).empty(), "it goes on to answer");
    }
}

}  // namespace

/// The first byte says how many come at a time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const Bytes bytes(data + 1, size - 1);
    const std::vector<std::size_t> at_once = ends_of(bytes, bytes.size());
    const std::vector<std::size_t> in_pieces = ends_of(bytes, 1U + data[0]);
    test::require_rule(
        std::includes(in_pieces.begin(), in_pieces.end(), at_once.begin(), at_once.end()),
        "frames end at the same bytes, however they come");
    serve(bytes);
    return 0;
}
