// A session in the window.
#include "app/viewer/replay.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace dibhr {

namespace {

/// Whether a person went to another moment: fewer ticks are left out by a recorder that was late.
bool is_jump(std::int64_t from_tick, std::int64_t to_tick) {
    constexpr std::int64_t kMostLeftOut = 100;
    return to_tick < from_tick || to_tick > from_tick + kMostLeftOut;
}

/// A session stores the cell; the proxy's place in it gives the TRIANGLE or EDGE.
Primitive recorded_primitive(const TickRecord& tick) {
    Primitive primitive{
        .kind = static_cast<PrimitiveKind>(tick.primitive), .i = tick.i, .j = tick.j};
    const double right = std::abs(tick.proxy.x - tick.i);
    const double down = std::abs(tick.proxy.y - tick.j);
    if (primitive.kind == PrimitiveKind::triangle && right + down > 1.0)
        primitive.side = TriangleSide::far_corner;
    if (primitive.kind == PrimitiveKind::edge) {
        const double to_diagonal = std::abs(right + down - 1.0);
        primitive.direction = down <= std::min(right, to_diagonal) ? EdgeDirection::along_row
                              : right <= to_diagonal               ? EdgeDirection::along_column
                                                                   : EdgeDirection::diagonal;
    }
    return primitive;
}

Touch recorded_touch(const TickRecord& tick) {
    Touch touch;
    touch.goal = tick.goal;
    touch.proxy.position = tick.proxy;
    touch.proxy.active = recorded_primitive(tick);
    touch.proxy.moves = tick.moves;
    touch.proxy.contact = tick.contact;
    touch.proxy.bound_met = tick.catching_up;
    touch.spring_force_newton = tick.spring_newton;
    touch.sent_force_newton = tick.sent_newton;
    touch.cut = static_cast<SafetyCut>(tick.cut);
    return touch;
}

Touch touch_of(const SessionMoment& moment) {
    return moment.computed ? *moment.computed : recorded_touch(moment.tick);
}

}  // namespace

void ViewerReplay::begin(std::unique_ptr<OpenedSession> opened, const GivenParameters& given,
                         ViewerState& state) {
    if (!player_) {
        touch_ = state.settings.touch;
        cleaning_ = state.settings.cleaning;
        in_betweens_ = state.settings.in_betweens;
        bump_ = state.touch.bump;
        bump_file_ = state.touch.bump_file;
    }
    const Session& session = opened->session;
    // On if any moving source had them; still pairs have none.
    const bool moves = std::any_of(session.sources().begin(), session.sources().end(),
                                   [](const SessionSource& one) { return one.source.in_betweens; });
    state.settings.in_betweens = moves ? InBetweens::on : InBetweens::off;
    state.touch.replay = ReplayInfo{.file = session.file(),
                                    .participant = session.fact("participant"),
                                    .note = session.fact("note"),
                                    .started = session.fact("started"),
                                    .device = session.fact("device"),
                                    .marks = session.marks()};
    state.media.describe(opened->frames.description);
    state.touch.strips = {};
    state.touch.haptic = {};
    recorded_ =
        session.parameters().empty() ? TouchParameters{} : session.parameters().front().touch;
    TouchParameters wanted = recorded_;
    given.apply(wanted);
    chosen_.reset();
    if (!(wanted == recorded_)) chosen_ = wanted;
    state.settings.touch = wanted;
    outline_ = std::make_unique<ContactBandReader>(*opened);
    player_ = std::make_unique<SessionPlayer>(std::move(opened));
    state.touch.replay->playback = player_->playback();  // for a key in this picture
    if (chosen_) player_->compute(chosen_);
}

void ViewerReplay::end(ViewerState& state) {
    if (!player_) return;
    player_.reset();
    outline_.reset();
    state.touch.replay.reset();
    state.settings.touch = touch_;
    state.settings.cleaning = cleaning_;
    state.settings.in_betweens = in_betweens_;
    state.touch.bump = std::exchange(bump_, nullptr);
    state.touch.bump_file = bump_file_;
    state.touch.haptic = {};
    state.touch.others.clear();
    state.touch.strips = {};
}

void ViewerReplay::advance(ViewerState& state, SessionPlayer::Time now) {
    player_->advance(now, [&state, this](const SessionMoment& moment) {
        const Touch touch = touch_of(moment);
        const TickRecord& tick = moment.tick;
        const bool goes_on =
            tick.tick == passed_tick_ + 1 && !tick.from_zero && !tick.releases_contact;
        const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
        if (is_jump(passed_tick_, tick.tick)) state.touch.strips = {};
        state.touch.strips.add(
            strip_of(passed_, touch, goes_on ? tick.dt_s : 0.0, tick.lateness_us, pitch_mm));
        passed_ = touch;
        passed_tick_ = tick.tick;
        if (moment.tick.surface && touch.proxy.bound_met) ++state.touch.haptic.bounds_met;
    });
    state.touch.replay->playback = player_->playback();
    state.touch.replay->contacts = outline_->band();
    state.touch.replay->computes = chosen_.has_value();
    if (player_->moment() != nullptr) show(*player_->moment(), state);
}

void ViewerReplay::show(const SessionMoment& moment, ViewerState& state) {
    const TickRecord& tick = moment.tick;
    state.touch.replay->tick = tick;
    state.touch.replay->tick_count = moment.count;
    state.touch.replay->computed = moment.computed.has_value();
    state.touch.haptic.touch = touch_of(moment);
    state.touch.haptic.touchable = tick.surface;
    state.touch.others = moment.others;
    state.touch.haptic.hand = {.goal_in_grid = tick.goal,
                               .buttons = tick.buttons,
                               .ready = tick.device_ready,
                               .mouse_fallback = tick.mouse_fallback};
    state.touch.bump = moment.bump;
    if (moment.parameters != nullptr) {
        recorded_ = moment.parameters->touch;
        state.touch.bump_file = moment.parameters->bump.file;
    }
    if (!chosen_) state.settings.touch = recorded_;
    state.touch.haptic.shape = state.settings.touch.shape;
    const FrameSource& source = tick.frames.source;
    if (tick.surface) {
        const FrameCleaning cleaning = cleaning_of(source);
        state.settings.cleaning = {
            .preset = CleaningPreset::own, .own = cleaning.steps, .finger = cleaning.finger};
    }
}

void ViewerReplay::follow_panels(const ViewerState& state) {
    player_->compare(state.settings.others);
    if (state.settings.touch == (chosen_ ? *chosen_ : recorded_)) return;
    chosen_ = state.settings.touch;
    player_->compute(chosen_);
}

void ViewerReplay::restore_recorded(ViewerState& state) {
    if (!player_) return;
    chosen_.reset();
    state.settings.touch = recorded_;
    player_->compute({});
}

DepthBlend ViewerReplay::shown() const {
    const SessionMoment* moment = player_->moment();
    if (moment == nullptr || !moment->frames) return {};
    return {&moment->frames->from, &moment->frames->to, moment->tick.blend};
}

Settings ViewerReplay::settings_to_save(const ViewerState& state) const {
    Settings settings = state.settings;
    if (player_) {
        settings.touch = touch_;
        settings.cleaning = cleaning_;
        settings.in_betweens = in_betweens_;
    }
    return settings;
}

}  // namespace dibhr
