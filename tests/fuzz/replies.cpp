// The Falcon's bytes, cut anywhere: no whole reply is missed or made up, no byte forgotten, and
// what the replies tell is told without a fault.
#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "device/falcon/homing_watch.hpp"
#include "device/falcon/packet.hpp"
#include "device/hand/buttons.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;
using namespace dibhr::falcon;

namespace {

using Bytes = std::span<const std::uint8_t>;

bool same(const Reply& a, const Reply& b) {
    return a.encoder == b.encoder && a.buttons == b.buttons && a.homed == b.homed;
}

/// Every 16 bytes that are one, looked for from the left.
std::vector<Reply> whole_replies(Bytes bytes) {
    std::vector<Reply> replies;
    for (std::size_t at = 0; at + kPacketBytes <= bytes.size();) {
        Packet packet{};
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), kPacketBytes, packet.begin());
        const std::optional<Reply> reply = decode(packet);
        if (reply) replies.push_back(*reply);
        at += reply ? kPacketBytes : 1;
    }
    return replies;
}

/// What the stream makes of the bytes when they come in pieces of `lengths`, again and again.
std::vector<Reply> streamed(Bytes bytes, std::span<const std::uint8_t> lengths) {
    ReplyStream stream;
    std::vector<Reply> replies;
    const std::size_t in_all = bytes.size();
    for (std::size_t piece = 0; !bytes.empty(); ++piece) {
        const std::size_t length = 1 + lengths[piece % lengths.size()] % 64;
        Bytes here = bytes.first(std::min(length, bytes.size()));
        bytes = bytes.subspan(here.size());
        while (!here.empty()) {
            if (const auto reply = stream.add(here)) replies.push_back(*reply);
        }
    }
    const std::size_t told = replies.size() * kPacketBytes + stream.discarded();
    test::require_rule(told <= in_all && in_all - told < kPacketBytes,
                       "a byte belongs to a reply, to none, or to the one that is coming");
    return replies;
}

void watch(const std::vector<Reply>& replies, std::uint8_t step_ms) {
    HomingWatch homing;
    ButtonDebounce buttons;
    HomingWatch::Time now{};
    homing.begin(now);
    for (const Reply& reply : replies) {
        now += std::chrono::milliseconds(step_ms);
        homing.add(reply, now);
        test::require_rule(homing.ready() == (homing.epoch() != kNoEpoch),
                           "poses have an epoch when they may be trusted");
        test::require_rule(!homing.ready() || reply.homed == kAllAxes,
                           "no pose may be trusted while an axis is not homed");
        test::require_rule(buttons.add(reply.buttons, now) < 16, "there are four buttons");
    }
}

}  // namespace

/// Four bytes say how the others come.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead = 4;
    if (size < kHead) return 0;
    const Bytes head(data, kHead);
    const Bytes bytes(data + kHead, size - kHead);
    const std::vector<Reply> replies = streamed(bytes, head);
    const std::vector<Reply> expected = whole_replies(bytes);
    test::require_rule(
        std::equal(replies.begin(), replies.end(), expected.begin(), expected.end(), same),
        "the same replies come however the bytes are cut");
    watch(replies, head[0]);
    return 0;
}
