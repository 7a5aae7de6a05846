// Is firmware already there?
#include "device/falcon/probe.hpp"

#include <exception>

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr int kQuestions = 10;
constexpr milliseconds kAnswerLimit{30};
constexpr int kLastPackets = 5;         // README.md, Safety numbers
constexpr milliseconds kLastLimit{10};  // for each; a Falcon that runs answers within 2 ms

milliseconds left_until(Clock::time_point end) {
    return std::chrono::ceil<milliseconds>(end - Clock::now());
}

template <typename Action>
void unless_it_fails(const Action& act) noexcept {
    try {
        act();
    } catch (const std::exception& failure) {
        // Nobody is left to tell: the caller knows already, or is leaving.
        return;
    }
}

}  // namespace

std::optional<Reply> ask(FtdiPort& port, const Command& command, milliseconds limit) {
    port.write(encode(command));
    ReplyStream stream;
    const auto end = Clock::now() + limit;
    for (auto left = limit; left > milliseconds(0); left = left_until(end)) {
        auto bytes = port.read(left).bytes;
        if (const auto reply = stream.add(bytes)) return reply;
    }
    return std::nullopt;
}

bool answers(FtdiPort& port, const std::stop_token& stop) {
    port.purge();
    port.request(kLatencyRunTime);
    port.request(kBaudRunTime);
    port.purge();
    for (int k = 0; k < kQuestions && !stop.stop_requested(); ++k) {
        if (ask(port, Command{}, kAnswerLimit)) return true;
    }
    return false;
}

void leave_without_force(FtdiPort& port) noexcept {
    for (int k = 0; k < kLastPackets; ++k) {
        unless_it_fails([&] {
            port.write(encode(no_force(Led::off)), kLastLimit);
            (void)port.read(kLastLimit);
        });
    }
    unless_it_fails([&] { port.request(kNoEventCharacter); });
}

}  // namespace dibhr::falcon
