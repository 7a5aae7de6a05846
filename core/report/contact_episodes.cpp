// Contact episodes, one tick after the other.
#include "core/report/contact_episodes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

constexpr double kRounding_s = 1e-9;  // times are sums of milliseconds

void add_force(ForceSummary& sum, const Vec3& newton, double held_s) {
    const double length = glm::length(newton);
    if (!std::isfinite(length)) return;
    sum.mean_newton += length * held_s;
    sum.peak_newton = std::max(sum.peak_newton, length);
}

void add_primitive(PrimitiveShares& sum, std::uint8_t primitive, double held_s) {
    const auto kind = static_cast<PrimitiveKind>(primitive);
    if (kind == PrimitiveKind::triangle) sum.triangle += held_s;
    if (kind == PrimitiveKind::edge) sum.edge += held_s;
    if (kind == PrimitiveKind::vertex) sum.vertex += held_s;
}

constexpr double kLongestWindow_s = 3.0 * kSpeedWindow_s;  // longer: ticks are missing

}  // namespace

std::vector<std::size_t> longest_first(const std::vector<Episode>& episodes) {
    std::vector<std::size_t> order(episodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&episodes](std::size_t k) { return episodes[k].contact_s; });
    return order;
}

void ContactEpisodes::add(const TickRecord& tick, double held_s, double pitch_mm) {
    if (open_ && (tick.releases_contact ||
                  (tick.surface && tick.frames.source.media != open_->episode.media))) {
        end();
    }
    if (!touches(tick)) return;
    const bool gap = open_ && tick.tick != open_->last_tick + 1;
    if (gap && tick.t_s - open_->episode.end_s >= kJoinedGap_s - kRounding_s) end();
    if (open_)
        extend(tick, gap ? 0.0 : pitch_mm);
    else
        begin(tick);
    Episode& episode = open_->episode;
    episode.end_s = tick.t_s + held_s;
    episode.video_end_s = tick.video_s;
    episode.contact_s += held_s;
    episode.centre_px += held_s * Vec2(tick.proxy);
    add_force(episode.sent, tick.sent_newton, held_s);
    add_force(episode.spring, tick.spring_newton, held_s);
    add_primitive(episode.shares, tick.primitive, held_s);
    open_->last_tick = tick.tick;
    open_->last_proxy_px = tick.proxy;
}

std::vector<Episode> ContactEpisodes::finish() {
    if (open_) end();
    return std::move(episodes_);
}

void ContactEpisodes::begin(const TickRecord& tick) {
    open_.emplace();
    open_->episode.begin_s = tick.t_s;
    open_->episode.video_begin_s = tick.video_s;
    open_->episode.media = tick.frames.source.media;
}

/// A force that begins from zero again follows a jump of the video or of the surface, which is no
/// path.
void ContactEpisodes::extend(const TickRecord& tick, double pitch_mm) {
    if (tick.from_zero) return;
    open_->episode.path_mm += pitch_mm * glm::length(tick.proxy - open_->last_proxy_px);
}

void ContactEpisodes::end() {
    Episode& episode = open_->episode;
    if (episode.contact_s > 0.0) {
        const double share = 1.0 / episode.contact_s;
        episode.centre_px *= share;
        episode.sent.mean_newton *= share;
        episode.spring.mean_newton *= share;
        episode.shares.triangle *= share;
        episode.shares.edge *= share;
        episode.shares.vertex *= share;
    }
    episodes_.push_back(episode);
    open_.reset();
}

std::optional<Speeds> SpeedWindow::add(const TickRecord& tick, double pitch_mm) {
    const Place now{tick.t_s, tick.goal, tick.proxy};
    // No speed is measured across a jump.
    if (!tick.surface || tick.releases_contact || tick.from_zero) places_.clear();
    if (!tick.surface || !is_finite(now.goal_px) || !is_finite(now.proxy_px)) return std::nullopt;
    places_.push_back(now);
    const double begin_s = now.t_s - kSpeedWindow_s + kRounding_s;
    while (places_.size() > 1 && places_[1].t_s <= begin_s) places_.pop_front();
    const Place& then = places_.front();
    const double between_s = now.t_s - then.t_s;
    if (then.t_s > begin_s || between_s > kLongestWindow_s) return std::nullopt;
    const double mm_per_s_of_px = pitch_mm / between_s;
    return Speeds{glm::length(now.goal_px - then.goal_px) * mm_per_s_of_px,
                  glm::length(now.proxy_px - then.proxy_px) * mm_per_s_of_px};
}

}  // namespace dibhr
