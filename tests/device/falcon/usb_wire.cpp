// Queues, frames and the thread that moves them.
#include "tests/device/falcon/usb_wire.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <optional>
#include <span>

namespace dibhr::test::falcon {

namespace {

constexpr unsigned kInEndpoint = 0x81;
constexpr unsigned kOutEndpoint = 0x02;
constexpr std::size_t kPacketBytes = 64;
constexpr std::size_t kSetupBytes = 8;
constexpr Moment kFrame = std::chrono::milliseconds(1);

std::span<std::uint8_t> bytes_of(const usbdevfs_urb& urb) {
    return {static_cast<std::uint8_t*>(urb.buffer), static_cast<std::size_t>(urb.buffer_length)};
}

std::uint16_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8U);
}

}  // namespace

UsbWire::UsbWire(std::string serial) : model_(std::move(serial)) {
    thread_ = std::thread([this] { run(); });
}

UsbWire::~UsbWire() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

Moment UsbWire::now() {
    return std::chrono::duration_cast<Moment>(std::chrono::steady_clock::now().time_since_epoch());
}

void UsbWire::set_realtime(bool realtime) {
    with([realtime](FalconModel& model) { model.realtime = realtime; });
}

void UsbWire::end(const Pending& pending, int status) {
    pending.urb->status = status;
    if (pending.waited_for) {
        ended_.notify_all();
        return;
    }
    pending.file->done.push_back(pending.urb);
    if (pending.file->done.size() == 1) pending.file->pipe.ready();
}

int UsbWire::submit(UsbFile& file, usbdevfs_urb* urb) {
    const std::lock_guard lock(mutex_);
    return queue({&file, urb});
}

int UsbWire::queue(const Pending& pending) {
    if (pending.file->gone) return -ENODEV;
    usbdevfs_urb* const urb = pending.urb;
    urb->actual_length = 0;
    urb->status = -EINPROGRESS;
    if (urb->type == USBDEVFS_URB_TYPE_CONTROL) {
        if (bytes_of(*urb).size() < kSetupBytes) return -EINVAL;
        control_.push_back(pending);
    } else if (urb->type == USBDEVFS_URB_TYPE_BULK && urb->endpoint == kInEndpoint) {
        in_.push_back(pending);
    } else if (urb->type == USBDEVFS_URB_TYPE_BULK && urb->endpoint == kOutEndpoint) {
        out_.push_back(pending);
    } else {
        return -ENOENT;
    }
    const Moment moment = now();
    service(moment, !model_.realtime);
    if (next_event(moment) < wakes_) changed_.notify_one();
    return 0;
}

int UsbWire::bulk(UsbFile& file, unsigned endpoint, std::span<std::uint8_t> bytes,
                  std::chrono::milliseconds limit) {
    usbdevfs_urb urb{};
    urb.type = USBDEVFS_URB_TYPE_BULK;
    urb.endpoint = static_cast<std::uint8_t>(endpoint);
    urb.buffer = bytes.data();
    urb.buffer_length = static_cast<int>(bytes.size());
    std::unique_lock lock(mutex_);
    if (const int refused = queue({&file, &urb, true}); refused != 0) return refused;
    // By its address: clang does not capture what has a flexible array.
    const usbdevfs_urb* const waited = &urb;
    const auto has_ended = [waited] { return waited->status != -EINPROGRESS; };
    if (limit == limit.zero()) {
        ended_.wait(lock, has_ended);
    } else if (!ended_.wait_for(lock, limit, has_ended)) {
        for (auto* waiting : {&in_, &out_}) {
            std::erase_if(*waiting, [waited](const Pending& each) { return each.urb == waited; });
        }
        return -ETIMEDOUT;
    }
    return urb.status == 0 ? urb.actual_length : urb.status;
}

void UsbWire::service(Moment now, bool send) {
    while (!control_.empty() && model_.faults.frozen_control == 0) {
        const Pending pending = control_.front();
        control_.pop_front();
        service_control(pending, now);
    }
    while (send && !out_.empty() && model_.faults.frozen_out == 0) {
        const Pending pending = out_.front();
        out_.pop_front();
        model_.out(bytes_of(*pending.urb), now);
        pending.urb->actual_length = pending.urb->buffer_length;
        end(pending, 0);
        if (model_.realtime) last_frame_ = now / kFrame;
        send = !model_.realtime;
    }
    if (model_.faults.frozen_in == 0) service_in(now);
}

void UsbWire::service_control(const Pending& pending, Moment now) {
    const auto bytes = bytes_of(*pending.urb);
    const ControlSetup setup{bytes[0], bytes[1], word(bytes, 2), word(bytes, 4), word(bytes, 6)};
    const auto data =
        bytes.subspan(kSetupBytes, std::min<std::size_t>(setup.length, bytes.size() - kSetupBytes));
    // Clear feature, endpoint halt: how a kernel clears one.
    if (setup.type == 0x02 && setup.request == 1 && setup.index == kInEndpoint) in_halted_ = false;
    const auto answer = model_.control(setup, data, now);
    const bool to_host = (setup.type & 0x80U) != 0;
    if (answer) pending.urb->actual_length = to_host ? static_cast<int>(*answer) : setup.length;
    end(pending, answer ? 0 : -EPIPE);
}

void UsbWire::service_in(Moment now) {
    while (!in_.empty()) {
        const Pending pending = in_.front();
        usbdevfs_urb& urb = *pending.urb;
        if (!in_halted_ && strikes(model_.faults.stalled_reads)) in_halted_ = true;
        if (in_halted_) {
            in_.pop_front();
            end(pending, -EPIPE);
            continue;
        }
        std::array<std::uint8_t, kPacketBytes> packet{};
        const std::size_t size = model_.in(packet, now);
        if (size == 0) return;
        const auto room = bytes_of(urb).subspan(static_cast<std::size_t>(urb.actual_length));
        const std::size_t kept = std::min(size, room.size());
        std::copy_n(packet.begin(), kept, room.begin());
        urb.actual_length += static_cast<int>(kept);
        // A short packet ends a transfer, and so does a full buffer.
        if (size == kPacketBytes && kept < room.size()) continue;
        in_.pop_front();
        end(pending, size > room.size() ? -EOVERFLOW : 0);
    }
}

Moment UsbWire::next_event(Moment now) const {
    Moment next = kNever;
    if (!out_.empty() && model_.realtime) next = (last_frame_ + 1) * kFrame;
    if (!in_.empty() && model_.faults.frozen_in == 0) next = std::min(next, model_.next_in());
    return next == kNever ? kNever : std::max(next, now);
}

void UsbWire::run() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        const Moment moment = now();
        service(moment, !model_.realtime || moment / kFrame > last_frame_);
        wakes_ = next_event(moment);
        if (wakes_ == kNever) {
            changed_.wait(lock);
        } else if (wakes_ > now()) {
            changed_.wait_until(lock, std::chrono::steady_clock::time_point(wakes_));
        }
    }
}

int UsbWire::discard(UsbFile& file, usbdevfs_urb* urb) {
    const std::lock_guard lock(mutex_);
    for (auto* waiting : queues()) {
        const auto found = std::ranges::find_if(
            *waiting, [&](const Pending& each) { return each.file == &file && each.urb == urb; });
        if (found == waiting->end()) continue;
        const Pending pending = *found;
        waiting->erase(found);
        end(pending, -ENOENT);
        return 0;
    }
    return -EINVAL;
}

int UsbWire::clear_halt(UsbFile& file, unsigned endpoint) {
    const std::lock_guard lock(mutex_);
    if (file.gone) return -ENODEV;
    if (endpoint == kInEndpoint) in_halted_ = false;
    return 0;
}

int UsbWire::reap(UsbFile& file, usbdevfs_urb*& urb) {
    const std::lock_guard lock(mutex_);
    if (file.done.empty()) return file.gone ? -ENODEV : -EAGAIN;
    urb = file.done.front();
    file.done.pop_front();
    if (file.done.empty()) file.pipe.not_ready();
    return 0;
}

int UsbWire::open(UsbFile& file) {
    const std::lock_guard lock(mutex_);
    if (gone_) return -ENODEV;
    files_.push_back(&file);
    return 0;
}

bool UsbWire::abandoned(const UsbFile& file) {
    const std::lock_guard lock(mutex_);
    return file.pipe.abandoned();
}

void UsbWire::forget(UsbFile& file) {
    const std::lock_guard lock(mutex_);
    for (auto* waiting : queues()) {
        std::erase_if(*waiting, [&](const Pending& each) { return each.file == &file; });
    }
    std::erase(files_, &file);
    in_halted_ = false;
}

void UsbWire::unplug() {
    const std::lock_guard lock(mutex_);
    gone_ = true;
    for (auto* waiting : queues()) {
        for (const Pending& each : *waiting) end(each, -ESHUTDOWN);
        waiting->clear();
    }
    for (UsbFile* file : files_) {
        file->gone = true;
        file->pipe.hang_up();
    }
}

void UsbWire::plug() {
    const std::lock_guard lock(mutex_);
    gone_ = false;
    in_halted_ = false;
    model_.reconnect();
}

bool UsbWire::gone(const UsbFile& file) {
    const std::lock_guard lock(mutex_);
    return file.gone;
}

}  // namespace dibhr::test::falcon
