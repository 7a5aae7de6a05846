// `dibhr devices`: the stage of every attached Falcon, and what is missing.
#include "device/falcon/survey.hpp"

#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>

#include "device/falcon/bring_up.hpp"
#include "device/falcon/homing_watch.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

namespace {

// Replies hold the homed bits only while the homing bit is set; the first replies may be older.
constexpr std::chrono::milliseconds kLookFor{500};
constexpr std::chrono::milliseconds kBetweenQuestions{5};
constexpr std::chrono::milliseconds kAnswerLimit{30};

/// The first reply with all axes homed, or the last reply of half a second.
std::optional<Reply> homing_reply(FtdiPort& port) {
    const auto end = std::chrono::steady_clock::now() + kLookFor;
    std::optional<Reply> last;
    while (std::chrono::steady_clock::now() < end && !(last && homed_axes(last->homed) == 3)) {
        if (const auto reply = request_reply(port, no_force(Led::red), kAnswerLimit)) last = reply;
        std::this_thread::sleep_for(kBetweenQuestions);
    }
    return last;
}

void ask_for_homing(FtdiPort& port, SurveyedFalcon& found) {
    found.stage = Stage::homing;
    const auto reply = homing_reply(port);
    send_stop_packets(port);
    const int axes = reply ? homed_axes(reply->homed) : 0;
    if (axes == 3) found.stage = Stage::ready;
    found.sentence = axes == 3 ? "ready to touch" : how_to_home(axes);
}

void survey(const UsbContext& usb, const ConnectionOptions& options, const FirmwareImage& firmware,
            SurveyedFalcon& found) {
    FtdiPort port(usb, found.attached);
    found.stage = Stage::no_firmware;
    UploadOptions upload_options;
    upload_options.slower = options.slower_upload;
    if (bring_up(port, firmware, upload_options, std::stop_token()) == BroughtUp::no_firmware) {
        found.sentence = missing_firmware_advice(found.attached);
        return;
    }
    ask_for_homing(port, found);
}

}  // namespace

std::vector<AttachedFalcon> attached_falcons() {
    return attached_falcons(UsbContext());
}

std::string why_it_cannot_be_opened(const AttachedFalcon& falcon) {
    try {
        const UsbContext usb;
        const FtdiPort port(usb, falcon);
    } catch (const UsbError& refusal) {
        return refusal.what();
    }
    return {};
}

std::vector<SurveyedFalcon> survey_falcons(const ConnectionOptions& options,
                                           const FirmwareImage& firmware) {
    const UsbContext usb;
    std::vector<SurveyedFalcon> falcons;
    for (const AttachedFalcon& attached : attached_falcons(usb)) {
        SurveyedFalcon& found = falcons.emplace_back(SurveyedFalcon{attached, {}, {}});
        found.stage = Stage::cannot_open;
        try {
            survey(usb, options, firmware, found);
        } catch (const DeviceError& failure) {
            found.sentence = failure.what();
        }
    }
    return falcons;
}

}  // namespace dibhr::falcon
