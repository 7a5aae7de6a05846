// The device's thread.
#include "device/forcedimension/driver.hpp"

#include <atomic>
#include <exception>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/realtime/tick_timer.hpp"
#include "device/forcedimension/usb_bus.hpp"

namespace dibhr::forcedimension {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLookAgainAfter{1000};
constexpr milliseconds kRetryOthersAfter{5000};  // where an arm is attached and cannot be used
constexpr milliseconds kLastStopLimit{200};

constexpr int kNoArmOpen = -1;

/// Where another thread finds the ID of the open arm.
class OpenMark {
  public:
    OpenMark(std::atomic<int>& place, int id) : place_(place) { place_ = id; }
    ~OpenMark() { place_ = kNoArmOpen; }
    OpenMark(const OpenMark&) = delete;
    OpenMark& operator=(const OpenMark&) = delete;

  private:
    std::atomic<int>& place_;
};

}  // namespace

/// All that the thread uses. The thread owns a part of it: a call that does not return outlives the
/// driver.
class Driver::Search {
  public:
    Search(ConnectionOptions options, FoundCalls found, std::shared_ptr<ArmBuffers> buffers)
        : options_(std::move(options)), buffers_(std::move(buffers)) {
        const UsbBus bus = read_usb_bus(options_.usb_devices);
        if (found.calls == nullptr) {
            const bool refused = !found.trouble.empty();
            board_.enter(Stage::looking, refused ? found.trouble : why_no_library(bus),
                         refused || bus.has_arm);
            return;
        }
        library_ = std::make_shared<Library>(std::move(found.calls));
        board_.draft().library = library_->file() + ", version " + library_->version();
        board_.enter(Stage::looking, "looking for a Force Dimension arm");
    }

    [[nodiscard]] bool can_search() const noexcept { return library_ != nullptr; }
    void run();
    ThreadEnd end{};
    [[nodiscard]] Status status() const { return board_.read(); }
    void agree_to(std::uint64_t offer) {
        offers_.agree_to(offer);
        buffers_->wake.signal();
    }
    /// A last stop from another thread, while a call of the device's thread does not return.
    void stop_arm() const {
        const int id = open_id_;
        if (id != kNoArmOpen) library_->stop(id);
    }

  private:
    void find_arm(const std::stop_token& stop);
    void use(std::unique_ptr<Arm> opened, const std::stop_token& stop);
    void forget_arm();
    void publish_no_arm(const NoArm& why);

    const ConnectionOptions options_;
    const std::shared_ptr<ArmBuffers> buffers_;
    std::shared_ptr<Library> library_{};
    Board board_{};
    Offers offers_{};
    DriverState driver_state_{};
    bool lost_{false};      // the sentence is about a loss
    milliseconds pause_{};  // before the next search
    std::atomic<int> open_id_{kNoArmOpen};
};

void Driver::Search::run() {
    const std::stop_token stop = end.token();
    // A refusal is shown in the Loop panel, because the haptic thread requests the same.
    (void)become_realtime("dibhr forcedim");
    while (!stop.stop_requested()) {
        pause_ = kLookAgainAfter;
        try {
            find_arm(stop);
        } catch (const std::exception& failure) {
            forget_arm();
            board_.enter(Stage::looking,
                         std::string("the thread of the Force Dimension arm failed (") +
                             failure.what() +
                             ") and begins again: close other programs if this happens again",
                         true);
        }
        end.pause(pause_);
    }
}

void Driver::Search::find_arm(const std::stop_token& stop) {
    const UsbBus bus = read_usb_bus(options_.usb_devices);
    ArmSearch search(library_, bus);
    while (auto arm = search.next()) {
        arm->identify(board_.draft());
        if (options_.serial.empty() || board_.draft().serial == options_.serial)
            return use(std::move(arm), stop);
    }
    forget_arm();
    const NoArm why = why_no_arm(search, bus, options_.serial);
    if (why.stage != Stage::looking || !options_.serial.empty()) pause_ = kRetryOthersAfter;
    publish_no_arm(why);
}

void Driver::Search::use(std::unique_ptr<Arm> opened, const std::stop_token& stop) {
    const OpenMark mark(open_id_, opened->id());
    const std::unique_ptr<Arm> arm = std::move(opened);  // stopped and closed before the mark ends
    lost_ = false;
    try {
        ExchangeLoop exchange_loop(*arm, *buffers_, board_, driver_state_, offers_);
        exchange_loop.run(stop);
    } catch (const ArmLost& loss) {
        lost_ = true;
        forget_arm();
        board_.enter(Stage::looking, loss.what(), true);
    }
}

void Driver::Search::forget_arm() {
    Status& status = board_.draft();
    status.type = -1;
    status.serial.clear();
    status.controller_version.reset();
    status.watchdog_ms = 0.0;
    status.unguarded.clear();
    status.exchanges_per_s = 0.0;
}

/// The sentence about a loss stays until something else is attached.
void Driver::Search::publish_no_arm(const NoArm& why) {
    const bool looks = why.stage == Stage::looking;
    if (!(lost_ && looks)) board_.enter_new(why.stage, why.sentence, !looks);
}

Driver::Driver(ConnectionOptions options, FoundCalls found, std::shared_ptr<ArmBuffers> buffers)
    : search_(std::make_shared<Search>(std::move(options), std::move(found), std::move(buffers))) {
    if (search_->can_search()) thread_.emplace(search_);
}

Driver::~Driver() {
    if (!thread_ || thread_->end_within(kLeaveAfter)) return;
    std::thread([search = search_] { search->stop_arm(); }).detach();
    (void)search_->end.comes_within(kLastStopLimit);
}

Status Driver::status() const {
    return search_->status();
}

void Driver::agree_to(std::uint64_t offer) {
    search_->agree_to(offer);
}

}  // namespace dibhr::forcedimension
