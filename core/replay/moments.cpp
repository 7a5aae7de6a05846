// The moments of a session.
#include "core/replay/moments.hpp"

#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kRunIn_s = 1.0;

}  // namespace

bool names_session(const std::filesystem::path& file) {
    if (file.extension() == ".dibhr") return true;
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(file, unknown)) return false;
    constexpr std::string_view kMagic = "SQLite format 3";  // SQLite's file format, section 1.3
    std::array<char, kMagic.size()> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return stream.gcount() == static_cast<std::streamsize>(head.size()) &&
           std::string_view(head.data(), head.size()) == kMagic;
}

OpenedSession::OpenedSession(const std::filesystem::path& file, bool any_media)
    : session(file), frames((session.check(), session), {.any_media = any_media, .colour = true}) {
    if (session.rows() == 0 || session.sources().empty()) {
        throw InputError(file.string() + ": holds no tick over a video; record a longer one");
    }
}

void SessionMoments::begin(double from_s, const std::optional<TouchParameters>& other) {
    std::vector<ParameterChange> changes;
    if (other) changes.push_back([other](TouchParameters& parameters) { parameters = *other; });
    computes_ = other.has_value();
    from_s_ = from_s;
    replay_.emplace(opened_.session, opened_.frames, std::move(changes),
                    computes_ ? from_s - kRunIn_s : from_s);
}

std::optional<SessionMoment> SessionMoments::next(const std::atomic<bool>& given_up) {
    while (replay_ && !given_up && replay_->next()) {
        const TickRecord& tick = replay_->recorded();
        if (tick.t_s >= from_s_) return moment_of(tick);
    }
    return {};
}

double SessionMoments::time_before(std::int64_t tick) const {
    SessionReader::Query query(
        opened_.session.reader(),
        "SELECT t FROM tick WHERE tick < " + std::to_string(tick) + " ORDER BY tick DESC LIMIT 1");
    return query.next() ? query.real(0) : opened_.session.begin_s();
}

SessionMoment SessionMoments::moment_of(const TickRecord& tick) {
    if (replay_->frames()) frames_ = replay_->frames();
    SessionMoment moment;
    moment.tick = tick;
    moment.frames = frames_;
    moment.parameters = opened_.session.parameters_of(tick.settings);
    if (moment.parameters != nullptr) moment.bump = opened_.frames.bump(*moment.parameters);
    if (computes_) {
        moment.computed = replay_->touch(0);
        moment.update_us = replay_->update_us(0);
    }
    return moment;
}

}  // namespace dibhr
