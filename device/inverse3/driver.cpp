// The network thread.
#include "device/inverse3/driver.hpp"

#include <exception>
#include <utility>

#include "core/realtime/tick_timer.hpp"
#include "device/inverse3/service_version.hpp"

namespace dibhr::inverse3 {

namespace {

using std::chrono::milliseconds;
using Why = LinkError::Why;

constexpr milliseconds kLookAgainAfter{500};
constexpr milliseconds kRetryOtherServerAfter{5000};  // where another server has the port
constexpr milliseconds kHandshakeTimeout{1000};

}  // namespace

Driver::Driver(ConnectionOptions options, ArmBuffers& buffers)
    : options_(std::move(options)), buffers_(buffers) {
    board_.draft().unguarded = guardian_.fault();
    board_.enter(Stage::looking, "looking for the Haply Inverse Service");
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Driver::~Driver() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
}

void Driver::run(const std::stop_token& stop) {
    // A refusal is shown in the Loop panel, because the haptic thread requests the same.
    (void)become_realtime("dibhr inverse3");
    while (!stop.stop_requested()) {
        pause_ = kLookAgainAfter;
        try {
            find_device(stop);
        } catch (const std::exception& failure) {
            board_.enter_new(Stage::looking,
                             std::string("the Inverse3's thread failed (") + failure.what() +
                                 ") and begins again: close other programs if this happens again",
                             true);
        }
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop, pause_, [] { return false; });
    }
}

void Driver::find_device(const std::stop_token& stop) {
    Status& status = board_.draft();
    status.installed = is_installed(options_);
    const auto version = ask_version(options_);
    status.version = version ? version->text : std::string{};
    if (version && !version->at_least(3, 1)) {
        board_.enter_new(Stage::too_old, sentence_for(Stage::too_old, status), true);
        return;
    }
    try {
        ServiceLink link(options_.port, ServiceLink::Time::clock::now() + kHandshakeTimeout);
        run_exchanges(link, version && version->at_least(3, 5), stop);
    } catch (const LinkError& error) {
        handle_no_service(error);
    }
}

void Driver::run_exchanges(ServiceLink& link, bool newer, const std::stop_token& stop) {
    ExchangeLoop exchange_loop(link, options_, newer, buffers_, board_, driver_state_, guardian_);
    lost_ = true;
    try {
        exchange_loop.run(stop);
    } catch (const LinkError& error) {
        handle_loss(error, exchange_loop);
    }
}

void Driver::handle_loss(const LinkError& error, const ExchangeLoop& exchange_loop) {
    Status& status = board_.draft();
    status.exchanges_per_s = 0.0;
    status.id.clear();
    status.grip.reset();
    if (!exchange_loop.closed_on_force()) {
        driver_state_.dialects_refused = 0;
        board_.enter_new(
            error.why() == Why::too_long ? Stage::not_understood : Stage::looking,
            error.why() == Why::unguarded
                ? "the process that takes the force off when dibhr dies was ended: another one is "
                  "started, and the force comes back"
            : error.why() == Why::program_stalled
                ? "dibhr stood still for a moment and the force was taken off: the force comes back"
                : "the Haply Inverse Service was lost (" + std::string(error.what()) +
                      "): it is looked for again; start it if it has ended",
            true);
        return;
    }
    ++driver_state_.dialects_refused;
    driver_state_.dialect = other(status.dialect.value_or(ForceDialect::vector));
}

/// No connection could be made.
void Driver::handle_no_service(const LinkError& error) {
    const auto [stage, sentence] = service_fault(error, board_.draft());
    if (error.why() == Why::not_the_service) pause_ = kRetryOtherServerAfter;
    // Keeps the sentence about the loss until the service is there again.
    if (lost_ && stage == Stage::looking && error.why() == Why::refused) return;
    board_.enter_new(stage, sentence, stage != Stage::looking);
}

}  // namespace dibhr::inverse3
