// The run-time link to one Falcon.
#include "device/falcon/link.hpp"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <new>

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kResendAfter{8};      // README.md, Reply rate
constexpr milliseconds kReplyTimeout{1000};  // README.md, Reply rate
constexpr int kMostCancelWaits = 20;         // of 100 ms: the kernel answers at once
constexpr std::size_t kUsualReplies = 64;    // in one wait, at most

int code_of(libusb_transfer_status status) {
    switch (status) {
        case LIBUSB_TRANSFER_STALL:
            return LIBUSB_ERROR_PIPE;
        case LIBUSB_TRANSFER_NO_DEVICE:
            return LIBUSB_ERROR_NO_DEVICE;
        case LIBUSB_TRANSFER_OVERFLOW:
            return LIBUSB_ERROR_OVERFLOW;
        case LIBUSB_TRANSFER_TIMED_OUT:
            return LIBUSB_ERROR_TIMEOUT;
        default:
            return LIBUSB_ERROR_IO;
    }
}

timespec time_left(Link::Time until, Link::Time now) {
    const auto left = std::max(until - now, Link::Clock::duration::zero());
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    const std::chrono::nanoseconds fraction = left - seconds;
    return {static_cast<time_t>(seconds.count()), static_cast<long>(fraction.count())};
}

}  // namespace

/// The two transfers with their memory, which libusb and the kernel may use until both are idle.
struct Link::Transfers {
    struct Free {
        void operator()(libusb_transfer* transfer) const noexcept {
            libusb_free_transfer(transfer);
        }
    };

    std::unique_ptr<libusb_transfer, Free> in{libusb_alloc_transfer(0)};
    std::unique_ptr<libusb_transfer, Free> out{libusb_alloc_transfer(0)};
    std::array<std::uint8_t, kUsbPacketBytes> in_bytes{};
    Packet out_bytes{};
    bool in_busy{false};
    bool out_busy{false};
    Link* owner;  // null once the link has ended, while the kernel may still use a transfer

    Transfers(libusb_device_handle* handle, Link* link) : owner(link) {
        if (!in || !out) throw std::bad_alloc();
        libusb_fill_bulk_transfer(in.get(), handle, kInEndpoint, in_bytes.data(),
                                  static_cast<int>(in_bytes.size()), &Transfers::in_done, this, 0);
        libusb_fill_bulk_transfer(out.get(), handle, kOutEndpoint, out_bytes.data(),
                                  static_cast<int>(out_bytes.size()), &Transfers::out_done, this,
                                  0);
    }
    Transfers(const Transfers&) = delete;
    Transfers& operator=(const Transfers&) = delete;

    /// 0, or libusb's error.
    static int submit(libusb_transfer* transfer, bool& busy) {
        const int code = libusb_submit_transfer(transfer);
        busy = code == 0;
        return code;
    }
    int submit_in() { return submit(in.get(), in_busy); }
    int submit_out() { return submit(out.get(), out_busy); }

    // An exception must not pass through libusb, so these two callbacks allocate nothing.
    static void LIBUSB_CALL in_done(libusb_transfer* transfer) {
        auto& self = *static_cast<Transfers*>(transfer->user_data);
        self.in_busy = false;
        if (self.owner == nullptr) return;
        if (transfer->status != LIBUSB_TRANSFER_COMPLETED) {
            self.owner->note_loss(code_of(transfer->status));
            return;
        }
        self.owner->take({transfer->buffer, static_cast<std::size_t>(transfer->actual_length)});
        if (const int code = self.submit_in(); code != 0) self.owner->note_loss(code);
    }
    static void LIBUSB_CALL out_done(libusb_transfer* transfer) {
        auto& self = *static_cast<Transfers*>(transfer->user_data);
        self.out_busy = false;
        if (self.owner == nullptr) return;
        if (transfer->status != LIBUSB_TRANSFER_COMPLETED) {
            self.owner->note_loss(code_of(transfer->status));
        }
    }
};

Link::Link(const UsbContext& usb, FtdiPort& port, const Wake& wake)
    : usb_(usb),
      falcon_(port.falcon()),
      wake_(wake),
      transfers_(std::make_unique<Transfers>(port.handle(), this)),
      last_reply_at_(Clock::now()) {
    replies_.reserve(kUsualReplies);
    libusb_set_pollfd_notifiers(
        usb_.get(),
        [](int, short, void* link) { static_cast<Link*>(link)->descriptors_changed_ = true; },
        [](int, void* link) { static_cast<Link*>(link)->descriptors_changed_ = true; }, this);
    if (const int code = transfers_->submit_in(); code != 0) lose(code);
}

Link::~Link() {
    libusb_set_pollfd_notifiers(usb_.get(), nullptr, nullptr, nullptr);
    transfers_->owner = nullptr;
    if (transfers_->in_busy) libusb_cancel_transfer(transfers_->in.get());
    if (transfers_->out_busy) libusb_cancel_transfer(transfers_->out.get());
    for (int k = 0; k < kMostCancelWaits && (transfers_->in_busy || transfers_->out_busy); ++k) {
        timeval limit{0, 100'000};
        libusb_handle_events_timeout_completed(usb_.get(), &limit, nullptr);
    }
    // The kernel may still write to them, and libusb end them later.
    if (transfers_->in_busy || transfers_->out_busy) (void)transfers_.release();
}

void Link::look_up_descriptors() {
    descriptors_changed_ = false;
    descriptors_.assign(1, pollfd{wake_.descriptor(), POLLIN, 0});
    const libusb_pollfd** list = libusb_get_pollfds(usb_.get());
    if (list == nullptr) throw std::bad_alloc();
    for (const auto* const* item = list; *item != nullptr; ++item) {
        descriptors_.push_back({(*item)->fd, (*item)->events, 0});
    }
    libusb_free_pollfds(list);
}

void Link::wait(Time until) {
    replies_.clear();
    if (loss_) return;
    if (descriptors_changed_) look_up_descriptors();
    const timespec limit = time_left(until, Clock::now());
    const int ready = ppoll(descriptors_.data(), descriptors_.size(), &limit, nullptr);
    if (ready < 0 && errno != EINTR) {
        loss_ = UsbError(LIBUSB_ERROR_OTHER, "the system does not let dibhr wait for " +
                                                 full_name_of(falcon_) + " (" +
                                                 std::strerror(errno) + "): close other programs");
        return;
    }
    if (ready > 0) {
        if (descriptors_.front().revents != 0) wake_.clear();
        const bool usb_has_something =
            std::any_of(descriptors_.begin() + 1, descriptors_.end(),
                        [](const pollfd& descriptor) { return descriptor.revents != 0; });
        timeval at_once{0, 0};
        if (usb_has_something) {
            libusb_handle_events_timeout_completed(usb_.get(), &at_once, nullptr);
        }
    }
    if (lost_code_ != 0) lose(lost_code_);
    const Time now = Clock::now();
    if (!loss_ && !idle() && now - last_reply_at_ > kReplyTimeout) loss_ = timeout_error(now);
}

UsbError Link::timeout_error(Time now) const {
    // Only if the pending command is old: one that was sent again just now proves nothing.
    if (transfers_->out_busy && now - sent_ > kReplyTimeout / 2) {
        return {LIBUSB_ERROR_TIMEOUT,
                "the USB took no command for " + full_name_of(falcon_) +
                    " for a second: plug the Falcon in again, into another USB socket if this "
                    "happens again; until then the mouse touches"};
    }
    return {LIBUSB_ERROR_TIMEOUT, full_name_of(falcon_) +
                                      " has not answered for a second: check its power adapter; "
                                      "until then the mouse touches"};
}

bool Link::idle() const noexcept {
    return !awaits_reply_ && !transfers_->out_busy;
}

bool Link::can_send(Time now) const noexcept {
    return !loss_ && !transfers_->out_busy && (!awaits_reply_ || now >= sent_ + kResendAfter);
}

Link::Time Link::retry_at() const noexcept {
    return transfers_->out_busy ? last_reply_at_ + kReplyTimeout + milliseconds(1)
                                : sent_ + kResendAfter;
}

void Link::send(const Packet& packet, Time now) {
    counts_.resent += awaits_reply_ ? 1U : 0U;
    transfers_->out_bytes = packet;
    awaits_reply_ = true;
    sent_ = now;
    if (const int code = transfers_->submit_out(); code != 0) lose(code);
}

LinkCounts Link::counts() const noexcept {
    LinkCounts counts = counts_;
    counts.bytes_discarded = stream_.discarded();
    return counts;
}

void Link::lose(int code) {
    if (!loss_) loss_ = usb_error(code, falcon_);
}

void Link::take(std::span<std::uint8_t> packet) {
    const Payload payload = payload_of(packet);
    auto bytes = payload.bytes;
    counts_.line_errors += payload.faulty_packets;
    if (payload.line_errors != 0) stream_.clear();  // its other half is lost
    // A misread byte may still look like a valid one.
    if ((payload.line_errors & (kParityError | kFramingError)) != 0) bytes = {};
    while (const auto reply = stream_.add(bytes)) {
        replies_.push_back(*reply);
        awaits_reply_ = false;
        last_reply_at_ = Clock::now();
    }
}

}  // namespace dibhr::falcon
