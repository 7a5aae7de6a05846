// The bus between a program and one simulated unit: transfers queue, 1 ms frames pass, and the
// cable can be pulled.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include <linux/usbdevice_fs.h>

#include "tests/device/falcon/falcon_model.hpp"
#include "tests/device/falcon/poll_pipe.hpp"

namespace dibhr::test::falcon {

/// What one open file of a program has on the bus.
struct UsbFile {
    PollPipe pipe{};
    std::deque<usbdevfs_urb*> done{};  ///< ended, to be reaped
    bool gone{false};                  ///< its unit was pulled: for good, also when it is back
};

/// Thread-safe; the unit behind it is reached through with().
class UsbWire {
  public:
    explicit UsbWire(std::string serial);
    ~UsbWire();
    UsbWire(const UsbWire&) = delete;
    UsbWire& operator=(const UsbWire&) = delete;

    /// Runs `use(FalconModel&)` with the unit's time brought up to now and the bus standing still.
    template <typename Use>
    decltype(auto) with(Use&& use) {
        const std::lock_guard lock(mutex_);
        model_.advance(now());
        Wake wake(*this);
        return std::forward<Use>(use)(model_);
    }
    /// Serial line and USB frames take their time, or none.
    void set_realtime(bool realtime);

    /// As the ioctls: 0, or a negative errno.
    int submit(UsbFile& file, usbdevfs_urb* urb);
    int discard(UsbFile& file, usbdevfs_urb* urb);
    int clear_halt(UsbFile& file, unsigned endpoint);
    /// A transfer that is waited for, behind those that are pending on its endpoint: the bytes that
    /// went; -ETIMEDOUT: not all of them in time (0: no limit).
    int bulk(UsbFile& file, unsigned endpoint, std::span<std::uint8_t> bytes,
             std::chrono::milliseconds limit);
    /// A transfer that has ended; -EAGAIN: none, -ENODEV: none and the cable is out.
    int reap(UsbFile& file, usbdevfs_urb*& urb);
    /// What the file still has on the bus is forgotten.
    void forget(UsbFile& file);

    void unplug();
    void plug();
    [[nodiscard]] bool gone(const UsbFile& file);
    /// Registers an open file, which is notified when the cable is pulled. 0, or -ENODEV.
    int open(UsbFile& file);
    /// Whether its last descriptor is closed.
    [[nodiscard]] bool abandoned(const UsbFile& file);

    [[nodiscard]] static Moment now();

  private:
    struct Pending {
        UsbFile* file;
        usbdevfs_urb* urb;
        bool waited_for{false};  // in a bulk(), not to be reaped
    };
    /// After a test has changed something, the bus looks again.
    struct Wake {
        explicit Wake(UsbWire& wire) : wire_(wire) {}
        ~Wake() { wire_.changed_.notify_one(); }
        Wake(const Wake&) = delete;
        Wake& operator=(const Wake&) = delete;
        UsbWire& wire_;
    };

    void run();
    void service(Moment now, bool send);
    void service_control(const Pending& pending, Moment now);
    void service_in(Moment now);
    [[nodiscard]] Moment next_event(Moment now) const;
    int queue(const Pending& pending);
    void end(const Pending& pending, int status);
    [[nodiscard]] std::array<std::deque<Pending>*, 3> queues() noexcept {
        return {&control_, &in_, &out_};
    }

    std::mutex mutex_{};
    std::condition_variable changed_{};
    std::condition_variable ended_{};  // a transfer that is waited for
    FalconModel model_;
    std::deque<Pending> in_{};
    std::deque<Pending> out_{};
    std::deque<Pending> control_{};
    std::deque<UsbFile*> files_{};
    std::int64_t last_frame_{0};  // whose turn to send has been used
    Moment wakes_{kNever};        // when the thread looks again
    bool in_halted_{false};
    bool gone_{false};
    bool stopping_{false};
    std::thread thread_{};
};

}  // namespace dibhr::test::falcon
