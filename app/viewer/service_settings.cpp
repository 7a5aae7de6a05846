// Asking the Inverse3's service.
#include "app/viewer/service_settings.hpp"

#include <utility>

namespace dibhr {

void ServiceSettings::follow(const Inverse3Settings& settings,
                             std::optional<Inverse3News>& inverse3) {
    constexpr int kMostTries = 3;
    constexpr std::chrono::seconds kBetween{3};
    if (!inverse3) return;
    Inverse3News& news = *inverse3;
    if (auto kept = asking_.take()) news.kept = std::move(*kept);
    if (asking_.under_way()) return;
    if (news.status.id != device_) {
        device_ = news.status.id;
        news.kept.clear();
        tries_ = 0;
        asked_ = {};
    }
    const auto now = std::chrono::steady_clock::now();
    if (device_.empty() || !news.kept.empty() || tries_ == kMostTries || now < asked_ + kBetween)
        return;
    ++tries_;
    asked_ = now;
    asking_.start([connection = connection_of(settings), device = device_] {
        return ask_kept_settings(connection, device);
    });
}

}  // namespace dibhr
