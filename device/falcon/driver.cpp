// The USB thread.
#include "device/falcon/driver.hpp"

#include <libusb.h>

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/realtime/tick_timer.hpp"
#include "device/falcon/bring_up.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLookAgainAfter{500};
constexpr milliseconds kLoadAgainAfter{2000};  // so that the user can read the failure
constexpr milliseconds kAskAgainAfter{2000};   // so that another program can load firmware

}  // namespace

Driver::Driver(ConnectionOptions options, FirmwareImage firmware, ThreadBuffers& buffers)
    : options_(std::move(options)), buffers_(buffers), firmware_(std::move(firmware)) {
    board_.draft().unguarded = guardian_.fault();
    board_.enter(Stage::looking, "looking for a Falcon");
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Driver::~Driver() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
}

void Driver::use_firmware(FirmwareImage image) {
    {
        const std::lock_guard lock(mutex_);
        firmware_ = std::move(image);
        new_firmware_ = true;
    }
    changed_.notify_all();
}

FirmwareImage Driver::firmware() {
    const std::lock_guard lock(mutex_);
    new_firmware_ = false;
    return firmware_;
}

void Driver::run(const std::stop_token& stop) {
    // A refusal is shown in the Loop panel, because the haptic thread requests the same.
    (void)become_realtime("dibhr falcon");
    std::optional<UsbContext> usb;
    while (!stop.stop_requested()) {
        pause_ = kLookAgainAfter;
        try {
            if (!usb) usb.emplace();
            find_device(*usb, stop);
        } catch (const UsbError& failure) {
            board_.enter(Stage::cannot_open, failure.what(), true);
        } catch (const std::exception& failure) {
            handle_loss(std::string("the Falcon's thread failed (") + failure.what() +
                        ") and begins again: close other programs if this happens again");
        }
        wait_to_look_again(stop);
    }
}

void Driver::wait_to_look_again(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    // The flag ends only one wait: without a Falcon, firmware() would not reset it for long.
    if (changed_.wait_for(lock, stop, pause_, [this] { return new_firmware_; }))
        new_firmware_ = false;
}

void Driver::find_device(const UsbContext& usb, const std::stop_token& stop) {
    const std::vector<AttachedFalcon> attached = attached_falcons(usb);
    const auto falcon = choose(attached, options_.serial);
    board_.draft().serial = falcon ? falcon->serial : "";
    if (falcon) {
        use(usb, *falcon, stop);
        return;
    }
    const bool lost = !trouble_.empty();
    board_.enter(Stage::looking, lost ? trouble_ : why_none(attached, options_.serial),
                 lost || !attached.empty());
}

void Driver::use(const UsbContext& usb, const AttachedFalcon& falcon, const std::stop_token& stop) {
    std::optional<FtdiPort> port;
    try {
        port.emplace(usb, falcon);
    } catch (const UsbError& refusal) {
        // The Falcon was unplugged just now: the next search finds none.
        const bool going = refusal.code() == LIBUSB_ERROR_IO && !trouble_.empty();
        if (!refusal.unplugged() && !going) board_.enter(Stage::cannot_open, refusal.what(), true);
        return;
    }
    try {
        bring_up_and_run(usb, *port, stop);
    } catch (const UsbError& loss) {
        if (loss.code() == LIBUSB_ERROR_PIPE) port->clear_stall();
        handle_loss(loss.what());
    } catch (const UploadError& failure) {
        trouble_ = failure.what();
        pause_ = kLoadAgainAfter;
        board_.enter(Stage::looking, trouble_, true);
    }
}

void Driver::bring_up_and_run(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop) {
    const FirmwareImage image = firmware();
    UploadOptions upload_options;
    upload_options.slower = options_.slower_upload;
    upload_options.on_progress = [&](double part, int number) {
        board_.draft().loaded = part;
        board_.draft().load_try = number;
        board_.enter(Stage::loading, trouble_.empty() ? "loading " + image.name : trouble_,
                     !trouble_.empty());
    };
    switch (bring_up(port, image, upload_options, stop)) {
        case BroughtUp::answers:
            trouble_.clear();
            run_exchanges(usb, port, stop);
            break;
        case BroughtUp::no_firmware:
            trouble_.clear();
            pause_ = kAskAgainAfter;
            board_.enter(Stage::no_firmware, missing_firmware_advice(port.falcon()));
            break;
        case BroughtUp::stopped:
            break;
    }
}

void Driver::run_exchanges(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop) {
    // Guarded until the last packet is sent.
    const Guarded guarded(guardian_, port.descriptor(usb), stop_packet());
    board_.draft().unguarded = guardian_.fault();
    std::optional<UsbError> loss;
    try {
        port.request(options_.event_character ? kFlushOnReplyEnd : kNoEventCharacter);
        ExchangeLoop exchange_loop(usb, port, buffers_, board_, driver_state_, guardian_);
        loss = exchange_loop.run(stop);
    } catch (...) {
        send_stop_packets(port);
        throw;
    }
    if (loss && loss->code() == LIBUSB_ERROR_PIPE) port.clear_stall();
    if (!loss || !loss->unplugged()) send_stop_packets(port);
    if (loss) handle_loss(loss->what());
    if (guardian_.died()) {
        handle_loss(
            "the process that takes the force off when dibhr dies was ended: another one is "
            "started, and the force comes back");
    }
}

void Driver::handle_loss(const std::string& why) {
    trouble_ = why;
    board_.draft().replies_per_s = 0.0;
    board_.draft().reply = {};
    board_.enter(Stage::looking, trouble_, true);
}

}  // namespace dibhr::falcon
