// Reads the sessions of a study's trials, interval by interval.
#include "core/study_report/study_motion.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/scratch_folder.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMouse = "mouse";  // in the session's fact "device"

/// A tick counts for at most this time: a program that was stopped did not touch.
constexpr double kLongestUpdate_s = 0.020;

/// Sums over one interval's ticks.
class IntervalSums {
  public:
    void add(const TickRecord& tick, double held_s, double pitch_mm, bool mouse) {
        ++motion_.updates;
        motion_.hand.all += tick.surface ? 1 : 0;
        motion_.hand.mouse_fallback += tick.surface && (mouse || tick.mouse_fallback) ? 1 : 0;
        motion_.moves += tick.moves;
        motion_.duration_s += held_s;
        goals_.push_back(tick.goal);
        proxies_.push_back(tick.proxy);
        contact_.push_back(tick.contact ? 1 : 0);
        if (tick.contact) add_contact(tick, held_s, pitch_mm);
        last_in_contact_ = tick.contact;
    }

    IntervalMotion finish() {
        if (motion_.contact_s > 0.0) {
            motion_.sent_newton /= motion_.contact_s;
            motion_.spring_newton /= motion_.contact_s;
        }
        motion_.turning =
            force_variation(goals_, proxies_, contact_, std::vector<char>(goals_.size(), 0), 0);
        return motion_;
    }

  private:
    void add_contact(const TickRecord& tick, double held_s, double pitch_mm) {
        ++motion_.contact_updates;
        motion_.contact_s += held_s;
        const double sent = glm::length(tick.sent_newton);
        const double spring = glm::length(tick.spring_newton);
        motion_.sent_newton += sent * held_s;
        motion_.spring_newton += spring * held_s;
        motion_.sent_peak_newton = std::max(motion_.sent_peak_newton, sent);
        motion_.spring_peak_newton = std::max(motion_.spring_peak_newton, spring);
        if (last_in_contact_)
            motion_.path_mm += pitch_mm * glm::length(tick.proxy - proxies_[proxies_.size() - 2]);
    }

    IntervalMotion motion_{};
    std::vector<Vec3> goals_{}, proxies_{};
    std::vector<char> contact_{};
    bool last_in_contact_{false};
};

/// A piece of the session, from a mark to the next one of any kind.
struct Piece {
    double from_s{0.0};
    std::optional<std::size_t> interval{};  ///< nothing: a pause, a question
};

std::optional<std::size_t> interval_marked(const std::string& tag, std::size_t intervals) {
    constexpr std::string_view kTag = "interval ";
    if (!tag.starts_with(kTag)) return std::nullopt;
    const auto number = number_of_text(std::string_view(tag).substr(kTag.size()));
    if (!number || *number < 1.0 || *number > static_cast<double>(intervals)) return std::nullopt;
    return static_cast<std::size_t>(*number) - 1;
}

std::vector<Piece> pieces_of(const Session& session, std::size_t intervals) {
    std::vector<Piece> pieces;
    for (const SessionMark& mark : session.marks())
        pieces.push_back({mark.t_s, interval_marked(mark.tag, intervals)});
    return pieces;
}

double weighted(double a, double of_a, double b, double of_b) noexcept {
    return of_a + of_b > 0.0 ? (a * of_a + b * of_b) / (of_a + of_b) : 0.0;
}

HandTicks joined_hand(const HandTicks& a, const HandTicks& b) noexcept {
    return {a.all + b.all, a.mouse_fallback + b.mouse_fallback};
}

/// The place of a row's condition among the protocol's: motion_condition() begins with its name.
std::size_t place_of(const std::string& row_condition, const Protocol& protocol) {
    std::size_t place = protocol.conditions.size();
    std::size_t longest = 0;
    for (std::size_t k = 0; k < protocol.conditions.size(); ++k) {
        const std::string& name = protocol.conditions[k].name;
        if (row_condition != name && !row_condition.starts_with(name + ", ")) continue;
        if (name.size() < longest) continue;
        longest = name.size();
        place = k;
    }
    return place;
}

/// Mean and standard deviation of both groups of pairs together.
VariationStatistics joined_turning(const VariationStatistics& a, const VariationStatistics& b) {
    const auto of_a = static_cast<double>(a.pairs);
    const auto of_b = static_cast<double>(b.pairs);
    VariationStatistics both{.mean_deg = weighted(a.mean_deg, of_a, b.mean_deg, of_b),
                             .pairs = a.pairs + b.pairs};
    const auto square = [&both](const VariationStatistics& one) {
        const double off = one.mean_deg - both.mean_deg;
        return one.sd_deg * one.sd_deg + off * off;
    };
    both.sd_deg = std::sqrt(weighted(square(a), of_a, square(b), of_b));
    return both;
}

}  // namespace

std::vector<IntervalMotion> motion_in(const Session& session, std::size_t intervals) {
    const std::vector<Piece> pieces = pieces_of(session, intervals);
    const double pitch_mm = session.parameters().empty()
                                ? kPaperPitch_mm
                                : session.parameters().front().touch.coupling.pixel_pitch_mm;
    const bool mouse = session.fact("device") == kMouse;
    std::vector<IntervalMotion> motion(intervals);
    std::vector<IntervalSums> sums(pieces.size());
    constexpr double kSameMoment_s = 1e-6;
    std::size_t next_piece = 0;
    Session::Ticks ticks(session);
    TickRecord tick;
    TickRecord next;
    for (bool more = ticks.next(tick); more; tick = next) {
        more = ticks.next(next);
        while (next_piece < pieces.size() && pieces[next_piece].from_s <= tick.t_s + kSameMoment_s)
            ++next_piece;
        const bool counts = next_piece > 0 && pieces[next_piece - 1].interval;
        if (!counts) continue;  // before the first mark, or in a pause
        const double held_s = more ? next.t_s - tick.t_s : tick.dt_s;
        sums[next_piece - 1].add(tick, std::clamp(held_s, 0.0, kLongestUpdate_s), pitch_mm, mouse);
    }
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (!pieces[k].interval) continue;
        IntervalMotion& of = motion[*pieces[k].interval];
        of = joined(of, sums[k].finish());
    }
    return motion;
}

IntervalMotion joined(const IntervalMotion& a, const IntervalMotion& b) noexcept {
    return {.updates = a.updates + b.updates,
            .contact_updates = a.contact_updates + b.contact_updates,
            .moves = a.moves + b.moves,
            .hand = joined_hand(a.hand, b.hand),
            .duration_s = a.duration_s + b.duration_s,
            .contact_s = a.contact_s + b.contact_s,
            .sent_newton = weighted(a.sent_newton, a.contact_s, b.sent_newton, b.contact_s),
            .sent_peak_newton = std::max(a.sent_peak_newton, b.sent_peak_newton),
            .spring_newton = weighted(a.spring_newton, a.contact_s, b.spring_newton, b.contact_s),
            .spring_peak_newton = std::max(a.spring_peak_newton, b.spring_peak_newton),
            .path_mm = a.path_mm + b.path_mm,
            .turning = joined_turning(a.turning, b.turning)};
}

std::string motion_condition(const Block& block, const StudyInterval& interval) {
    if (!interval.value) return interval.condition;
    const Variation& vary = block.variation;
    const char* const where = *interval.value > vary.reference   ? " above "
                              : *interval.value < vary.reference ? " below "
                                                                 : " ";
    return interval.condition + ", " + vary.parameter + where + short_text(vary.reference, 4);
}

std::vector<IntervalRow> motion_of(const Study& study,
                                   const std::function<void(double)>& progress) {
    std::vector<IntervalRow> rows;
    const ScratchFolder scratch("the sessions are read from there");
    const fs::path trial_file = scratch.path() / "trial.dibhr";
    for (std::size_t participant = 0; participant < study.participants.size(); ++participant) {
        const StudyRecord& record = study.participants[participant];
        for (std::size_t k = 0; k < record.answered.size(); ++k) {
            const Trial& trial = record.answered[k].trial;
            if (record.session_bytes[k] == 0) continue;
            if (!write_study_session(record.file, trial.number, trial_file)) continue;
            const Session session(trial_file);
            const std::vector<IntervalMotion> motion = motion_in(session, trial.intervals.size());
            const Block& block = study.protocol.blocks[static_cast<std::size_t>(trial.block)];
            for (std::size_t n = 0; n < motion.size(); ++n)
                rows.push_back({participant, trial.number, static_cast<int>(n),
                                motion_condition(block, trial.intervals[n]), trial.practice,
                                session.fact("device"), motion[n], trial.intervals[n].value});
            if (progress)
                progress(
                    (static_cast<double>(participant) +
                     static_cast<double>(k + 1) / static_cast<double>(record.answered.size())) /
                    static_cast<double>(study.participants.size()));
        }
    }
    return rows;
}

std::vector<MotionFinding> motion_findings(const Protocol& protocol,
                                           const std::vector<IntervalRow>& rows) {
    using Name = std::pair<std::size_t, std::string>;  // in the protocol's order
    std::map<Name, std::map<std::size_t, IntervalMotion>> by_condition;
    std::map<Name, int> intervals;
    for (const IntervalRow& row : rows) {
        if (row.practice) continue;
        const Name name{place_of(row.condition, protocol), row.condition};
        ++intervals[name];
        IntervalMotion& of = by_condition[name][row.participant];
        of = joined(of, row.motion);
    }
    std::vector<MotionFinding> findings;
    for (const auto& [name, by_participant] : by_condition) {
        MotionFinding found{.condition = name.second, .intervals = intervals[name]};
        const auto& people = by_participant;
        for (const auto& [participant, motion] : people) found.all = joined(found.all, motion);
        const auto mean = [&people](const auto& quantity, const auto& is_known) {
            std::vector<double> values;
            for (const auto& [participant, motion] : people)
                if (is_known(motion)) values.push_back(quantity(motion));
            return mean_of(values);
        };
        const auto any = [](const IntervalMotion&) { return true; };
        const auto touched = [](const IntervalMotion& m) { return m.touched(); };
        const auto turned = [](const IntervalMotion& m) { return m.turning.pairs > 0; };
        found.contact_share = mean([](const auto& m) { return m.contact_share(); }, any);
        found.sent_newton = mean([](const auto& m) { return m.sent_newton; }, touched);
        found.speed_mm_per_s = mean([](const auto& m) { return m.speed_mm_per_s(); }, touched);
        found.turning_deg = mean([](const auto& m) { return m.turning.mean_deg; }, turned);
        findings.push_back(std::move(found));
    }
    return findings;
}

bool ParticipantHand::used_mouse() const noexcept {
    return std::ranges::any_of(devices,
                               [](const auto& device) { return device.second.mouse_fallback > 0; });
}

bool ParticipantHand::used_only_mouse() const noexcept {
    return !devices.empty() && std::ranges::all_of(devices, [](const auto& device) {
        return device.second.is_mouse_only();
    });
}

std::vector<ParticipantHand> hands_in(const std::vector<IntervalRow>& rows,
                                      std::size_t participants) {
    std::vector<ParticipantHand> hands(participants);
    for (const IntervalRow& row : rows) {
        const HandTicks& ticks = row.motion.hand;
        if (ticks.all == 0) continue;
        HandTicks& of = hands[row.participant].devices[ticks.is_mouse_only() ? kMouse : row.device];
        of = joined_hand(of, ticks);
    }
    return hands;
}

}  // namespace dibhr
