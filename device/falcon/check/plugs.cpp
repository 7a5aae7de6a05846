// Step 9: which error comes when a cable is unplugged, and what is lost by it.
#include <libusb.h>

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "device/falcon/bring_up.hpp"
#include "device/falcon/check/context.hpp"
#include "device/falcon/homing_watch.hpp"

namespace dibhr::falcon {

namespace {

using Clock = CheckedFalcon::Clock;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{10};
constexpr milliseconds kLookEvery{100};
constexpr int kQuestions = 20;  // the first replies may be older than the homing bit

/// Exchanges packets until the USB reports an error.
UsbError wait_for_loss(CheckContext& context, Json& part) {
    auto last_reply = Clock::now();
    for (;;) {
        context.answered();
        try {
            const auto received = context.falcon.exchange(no_force(Led::blue), kPeriod);
            if (received) last_reply = received->at;
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
std::optional<Reply> last_reply_of_some(CheckContext& context) {
    std::optional<Reply> last;
    for (int k = 0; k < kQuestions; ++k) {
        const auto received = context.falcon.exchange(no_force(Led::red), kPeriod);
        if (received) last = received->reply;
    }
    return last;
}

/// Whether firmware and homing survived, as text.
std::string state_after_loss(CheckContext& context, Json& part) {
    const bool answers = context.falcon.answering();
    part["firmware_kept"] = answers;
    if (!answers) return "the firmware is lost";
    const auto reply = last_reply_of_some(context);
    if (!reply) return "the firmware answers, but not steadily";
    part["homed"] = reply->homed;
    part["counts"] = reply->encoder;
    return std::string("the firmware stays, ") +
           (homed_axes(reply->homed) == 3 ? "homing stays" : "homing is lost");
}

/// Opens the Falcon that was just plugged in; udev may still be setting its permission.
void open_again(CheckContext& context) {
    const auto end = Clock::now() + context.options.times.reconnect;
    for (;;) {
        try {
            (void)context.falcon.answers();
            return;
        } catch (const UsbError&) {
            if (Clock::now() > end) throw;
        }
        std::this_thread::sleep_for(kLookEvery);
        (void)context.falcon.find_again();
    }
}

void wait_until_attached(CheckContext& context) {
    while (!context.falcon.find_again()) {
        context.answered();
        std::this_thread::sleep_for(kLookEvery);
    }
}

void unplug_usb(CheckContext& context, Json& part) {
    context.console.ask("Unplug the USB cable, and leave the power adapter in. s = skip, q = quit");
    const UsbError loss = wait_for_loss(context, part);
    context.console.print(loss.what());
    context.falcon.set_answering(false);
    context.falcon.release_force();
    context.console.ask("Plug the USB cable in again. s = skip, q = quit");
    wait_until_attached(context);
    open_again(context);
    const std::string survived = state_after_loss(context, part);
    context.findings.record_answer(OpenQuestion::usb_unplugged,
                                   std::string(libusb_error_name(loss.code())) + "; " + survived);
    context.console.print(survived);
}

void load_again(CheckContext& context, Json& part) {
    if (context.falcon.answering() || context.options.firmware.empty()) return;
    context.console.print("loading the firmware again");
    const bool done = upload(context.falcon.port(), context.options.firmware.bytes, UploadOptions{},
                             std::stop_token());
    context.falcon.set_answering(done);
    part["loaded_again"] = done;
}

void unplug_power(CheckContext& context, Json& part) {
    context.console.ask(
        "Unplug the power adapter from the Falcon, and leave the USB cable in. s = skip, q = quit");
    const UsbError loss = wait_for_loss(context, part);
    context.console.print(loss.what());
    context.falcon.set_answering(false);
    const bool attached = context.falcon.find_again();
    part["usb_still_attached"] = attached;
    context.word("Plug the power adapter in again. Enter = it is in, s = skip, q = quit");
    wait_until_attached(context);
    open_again(context);
    const std::string survived = state_after_loss(context, part);
    context.findings.record_answer(
        OpenQuestion::power_lost,
        std::string(libusb_error_name(loss.code())) +
            (attached ? ", it stays on the USB; " : ", it leaves the USB; ") + survived);
    context.console.print(survived);
}

}  // namespace

void check_plugs(CheckContext& context, Json& measured) {
    Json& without_usb = measured["usb_unplugged"] = Json::object();
    unplug_usb(context, without_usb);
    load_again(context, without_usb);
    if (!context.falcon.answering()) {
        context.console.print(
            "Without firmware in the Falcon, the rest of this step cannot be measured.");
        throw StepSkipped{};
    }
    Json& without_power = measured["power_lost"] = Json::object();
    unplug_power(context, without_power);
    load_again(context, without_power);
}

}  // namespace dibhr::falcon
