// What `dibhr devices` does with an arm.
#include "device/forcedimension/guided.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "device/forcedimension/forcedimension_device.hpp"
#include "device/forcedimension/record.hpp"
#include "device/hand/check/questions.hpp"
#include "device/recorded_device.hpp"

namespace dibhr::forcedimension {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kPoll{10};
constexpr seconds kSearchLimit{3};

FoundCalls library_of(const ConnectionOptions& options) {
    FoundCalls found = load_calls(options.library);
    if (found.calls != nullptr) return found;
    throw DeviceError(found.trouble.empty()
                          ? "Force Dimension's library is not installed: get the SDK from "
                            "forcedimension.com, and name its folder in FDSDK"
                          : found.trouble);
}

/// Polls the device until the condition is true, at most for `limit`.
template <typename IsSo>
Status wait_for(const ForceDimensionDevice& device, Clock::duration limit, IsSo is_so) {
    const auto end = Clock::now() + limit;
    Status status = device.status();
    while (!is_so(status) && Clock::now() < end) {
        std::this_thread::sleep_for(kPoll);
        status = device.status();
    }
    return status;
}

bool has_arm(const Status& status) {
    return status.stage != Stage::looking;
}

struct ArmQuestions final : CheckQuestions {
    using CheckQuestions::CheckQuestions;

  private:
    void keep_alive() override { std::this_thread::sleep_for(kPoll); }
};

bool agrees(CheckConsole& console, const DeviceOffer& offer) try {
    ArmQuestions questions(console);
    console.print(offer.warning);
    return questions.yes_or_no(offer.label + "?");
} catch (const StepSkipped&) {
    return false;
} catch (const PersonQuits&) {
    return false;
}

}  // namespace

void initialise_arm(const ConnectionOptions& options, const PrintLine& print,
                    CheckConsole& console) {
    ForceDimensionDevice device(options, library_of(options));
    Status status = wait_for(device, kSearchLimit, has_arm);
    if (status.stage != Stage::not_initialised) {
        if (status.stage != Stage::ready) throw DeviceError(status.sentence);
        print(name_of(status) + " knows its position: nothing to initialise");
        return;
    }
    if (!status.offer || !agrees(console, *status.offer)) {
        print("The arm has not moved.");
        return;
    }
    device.agree_to(status.offer->number);
    const std::uint64_t agreed = status.offer->number;
    bool stopped = false;
    status = wait_for(device, std::chrono::minutes(2), [&](const Status& now) {
        const bool can_stop = now.stage == Stage::initialising && now.offer;
        if (!stopped && can_stop && console.interrupted()) {
            device.agree_to(now.offer->number);  // the offer to stop
            stopped = true;
        }
        return now.stage != Stage::initialising && (!now.offer || now.offer->number != agreed);
    });
    if (stopped) return print("You have stopped the arm. It does not know its position yet.");
    if (status.stage != Stage::ready) throw DeviceError(status.sentence);
    print(name_of(status) + " is initialised");
}

void record_arm(const ConnectionOptions& options, const std::filesystem::path& file,
                const PrintLine& print) {
    FoundCalls found = library_of(options);
    found.calls = std::make_shared<RecordedCalls>(std::move(found.calls), file);
    ForceDimensionDevice device(options, std::move(found));
    record_device(device, file, print);
}

void play_arm(const std::filesystem::path& record, const PrintLine& print) {
    ConnectionOptions options;
    options.library = record.string();
    FoundCalls found = play_record(record);
    if (found.calls == nullptr) throw DeviceError(found.trouble);
    ForceDimensionDevice device(options, std::move(found));
    play_device(device, record, "forcedimension", print);
}

}  // namespace dibhr::forcedimension
