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
constexpr milliseconds kBotherStrangerAfter{5000};  // where another server has the port
constexpr milliseconds kHandshakeTakes{1000};

}  // namespace

Driver::Driver(ConnectionOptions options, Exchange& exchange)
    : options_(std::move(options)), exchange_(exchange) {
    board_.draft().unguarded = guardian_.fault();
    board_.enter(Stage::looking, "looking for the Haply Inverse Service");
    thread_ = std::jthread([this](const std::stop_token& stop) { live(stop); });
}

Driver::~Driver() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
}

void Driver::live(const std::stop_token& stop) {
    // A refusal is shown in the Loop panel, because the haptic thread requests the same.
    (void)become_realtime("dibhr inverse3");
    while (!stop.stop_requested()) {
        pause_ = kLookAgainAfter;
        try {
            look(stop);
        } catch (const std::exception& failure) {
            tell(Stage::looking,
                 std::string("the Inverse3's thread failed (") + failure.what() +
                     ") and begins again: close other programs if this happens again",
                 true);
        }
        std::unique_lock lock(mutex_);
        news_.wait_for(lock, stop, pause_, [] { return false; });
    }
}

void Driver::look(const std::stop_token& stop) {
    Status& status = board_.draft();
    status.installed = is_installed(options_);
    const auto version = ask_version(options_);
    status.version = version ? version->text : std::string{};
    if (version && !version->at_least(3, 1)) {
        tell(Stage::too_old, sentence_for(Stage::too_old, status), true);
        return;
    }
    try {
        ServiceLink link(options_.port, ServiceLink::Time::clock::now() + kHandshakeTakes);
        talk(link, version && version->at_least(3, 5), stop);
    } catch (const LinkError& error) {
        miss(error);
    }
}

void Driver::talk(ServiceLink& link, bool newer, const std::stop_token& stop) {
    Conversation conversation(link, options_, newer, exchange_, board_, memory_, guardian_);
    lost_ = true;
    try {
        conversation.run(stop);
    } catch (const LinkError& error) {
        lose(error, conversation);
    }
}

void Driver::lose(const LinkError& error, const Conversation& conversation) {
    Status& status = board_.draft();
    status.exchanges_per_s = 0.0;
    status.id.clear();
    status.grip.reset();
    if (!conversation.closed_on_force()) {
        memory_.dialects_refused = 0;
        tell(
            error.why() == Why::too_long ? Stage::not_understood : Stage::looking,
            error.why() == Why::unguarded
                ? "the process that takes the force off when dibhr dies was ended: another one is "
                  "started, and the force comes back"
            : error.why() == Why::stood_still
                ? "dibhr stood still for a moment and the force was taken off: the force comes back"
                : "the Haply Inverse Service was lost (" + std::string(error.what()) +
                      "): it is looked for again; start it if it has ended",
            true);
        return;
    }
    ++memory_.dialects_refused;
    memory_.dialect = other(status.dialect.value_or(ForceDialect::vector));
}

/// No connection could be made.
void Driver::miss(const LinkError& error) {
    const auto [stage, sentence] = why_unheard(error, board_.draft());
    if (error.why() == Why::not_the_service) pause_ = kBotherStrangerAfter;
    // Keeps the sentence about the loss until the service is there again.
    if (lost_ && stage == Stage::looking && error.why() == Why::refused) return;
    tell(stage, sentence, stage != Stage::looking);
}

void Driver::tell(Stage stage, const std::string& sentence, bool trouble) {
    const Status& told = board_.draft();
    if (told.stage == stage && told.sentence == sentence) return;
    board_.enter(stage, sentence, trouble);
}

}  // namespace dibhr::inverse3
