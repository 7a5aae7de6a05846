// Step 9: which error comes when a cable is unplugged, and what is lost by it.
#include <libusb.h>

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "device/falcon/bring_up.hpp"
#include "device/falcon/check/desk.hpp"
#include "device/falcon/reply_watch.hpp"

namespace dibhr::falcon {

namespace {

using Clock = CheckedFalcon::Clock;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{10};
constexpr milliseconds kLookEvery{100};
constexpr int kQuestions = 20;  // the first replies may be older than the homing bit

/// Exchanges packets until the USB reports an error.
UsbError loss_while_talking(CheckDesk& desk, Json& part) {
    auto last_reply = Clock::now();
    for (;;) {
        desk.answered();
        try {
            const auto heard = desk.falcon.exchange(no_force(Led::blue), kPeriod);
            if (heard) last_reply = heard->at;
        } catch (const UsbError& loss) {
            part["error"] = libusb_error_name(loss.code());
            part["told"] = loss.what();
            part["ms_after_the_last_reply"] =
                std::chrono::duration<double, std::milli>(Clock::now() - last_reply).count();
            return loss;
        }
    }
}

/// The last of some replies; nothing when none came.
std::optional<Reply> last_reply_of_some(CheckDesk& desk) {
    std::optional<Reply> last;
    for (int k = 0; k < kQuestions; ++k) {
        const auto heard = desk.falcon.exchange(no_force(Led::red), kPeriod);
        if (heard) last = heard->reply;
    }
    return last;
}

/// Whether firmware and homing survived, as text.
std::string what_survived(CheckDesk& desk, Json& part) {
    const bool answers = desk.falcon.answering();
    part["firmware_kept"] = answers;
    if (!answers) return "the firmware is lost";
    const auto reply = last_reply_of_some(desk);
    if (!reply) return "the firmware answers, but not steadily";
    part["homed"] = reply->homed;
    part["counts"] = reply->encoder;
    return std::string("the firmware stays, ") +
           (homed_axes(reply->homed) == 3 ? "homing stays" : "homing is lost");
}

/// Opens the Falcon that was just plugged in; udev may still be setting its permission.
void open_again(CheckDesk& desk) {
    const auto end = Clock::now() + desk.options.times.reconnect;
    for (;;) {
        try {
            (void)desk.falcon.answers();
            return;
        } catch (const UsbError&) {
            if (Clock::now() > end) throw;
        }
        std::this_thread::sleep_for(kLookEvery);
        (void)desk.falcon.look_again();
    }
}

void wait_until_attached(CheckDesk& desk) {
    while (!desk.falcon.look_again()) {
        desk.answered();
        std::this_thread::sleep_for(kLookEvery);
    }
}

void unplug_usb(CheckDesk& desk, Json& part) {
    desk.guide.ask("Unplug the USB cable, and leave the power adapter in. s = skip, q = quit");
    const UsbError loss = loss_while_talking(desk, part);
    desk.guide.say(loss.what());
    desk.falcon.set_answering(false);
    desk.falcon.let_go();
    desk.guide.ask("Plug the USB cable in again. s = skip, q = quit");
    wait_until_attached(desk);
    open_again(desk);
    const std::string survived = what_survived(desk, part);
    desk.findings.settle(OpenQuestion::usb_unplugged,
                         std::string(libusb_error_name(loss.code())) + "; " + survived);
    desk.guide.say(survived);
}

void load_again(CheckDesk& desk, Json& part) {
    if (desk.falcon.answering() || desk.options.firmware.empty()) return;
    desk.guide.say("loading the firmware again");
    const bool done =
        upload(desk.falcon.port(), desk.options.firmware.bytes, UploadOptions{}, std::stop_token());
    desk.falcon.set_answering(done);
    part["loaded_again"] = done;
}

void unplug_power(CheckDesk& desk, Json& part) {
    desk.guide.ask(
        "Unplug the power adapter from the Falcon, and leave the USB cable in. s = skip, q = quit");
    const UsbError loss = loss_while_talking(desk, part);
    desk.guide.say(loss.what());
    desk.falcon.set_answering(false);
    const bool attached = desk.falcon.look_again();
    part["usb_still_attached"] = attached;
    desk.word("Plug the power adapter in again. Enter = it is in, s = skip, q = quit");
    wait_until_attached(desk);
    open_again(desk);
    const std::string survived = what_survived(desk, part);
    desk.findings.settle(OpenQuestion::power_lost,
                         std::string(libusb_error_name(loss.code())) +
                             (attached ? ", it stays on the USB; " : ", it leaves the USB; ") +
                             survived);
    desk.guide.say(survived);
}

}  // namespace

void check_plugs(CheckDesk& desk, Json& measured) {
    Json& without_usb = measured["usb_unplugged"] = Json::object();
    unplug_usb(desk, without_usb);
    load_again(desk, without_usb);
    if (!desk.falcon.answering()) {
        desk.guide.say("Without firmware in the Falcon, the rest of this step cannot be measured.");
        throw StepSkipped{};
    }
    Json& without_power = measured["power_lost"] = Json::object();
    unplug_power(desk, without_power);
    load_again(desk, without_power);
}

}  // namespace dibhr::falcon
