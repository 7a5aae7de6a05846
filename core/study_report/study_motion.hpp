// Motion and forces in a study's trials, from their sessions: forces, speeds, and how the force
// turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/metrics/force_variation.hpp"
#include "core/psychophysics/ranks.hpp"
#include "core/session/session.hpp"
#include "core/study_report/study_findings.hpp"

namespace dibhr {

/// One interval of a trial. Means are over the time in contact, 0 without any.
struct IntervalMotion {
    std::int64_t updates{0};
    std::int64_t contact_updates{0};
    std::int64_t moves{0};  ///< of the proxy from primitive to primitive
    HandTicks hand{};       ///< a mouse that was asked for counts like one that replaced a device
    double duration_s{0.0};
    double contact_s{0.0};
    double sent_newton{0.0}, sent_peak_newton{0.0};
    double spring_newton{0.0}, spring_peak_newton{0.0};
    double path_mm{0.0};  ///< of the proxy
    /// How the force's direction turned from update to update, as in `dibhr experiment`, but
    /// without separating reversals.
    VariationStatistics turning{};

    [[nodiscard]] bool touched() const noexcept { return contact_updates > 0; }
    [[nodiscard]] double contact_share() const noexcept {
        return duration_s > 0.0 ? contact_s / duration_s : 0.0;
    }
    [[nodiscard]] double speed_mm_per_s() const noexcept {
        return contact_s > 0.0 ? path_mm / contact_s : 0.0;
    }
};

/// The intervals of a trial's session, from each mark "interval N" to the next mark of any kind (a
/// person's have "rest" where the force goes off) or to the end; an interval felt once more goes to
/// the same entry. `intervals`: how many there are. Throws InputError for a damaged file.
[[nodiscard]] std::vector<IntervalMotion> motion_in(const Session& session, std::size_t intervals);

/// Both together: sums, and means weighted by time and by updates.
[[nodiscard]] IntervalMotion joined(const IntervalMotion& a, const IntervalMotion& b) noexcept;

/// The motion of one interval, and its place in the study.
struct IntervalRow {
    std::size_t participant{0};  ///< in Study::participants
    int trial{0};
    int interval{0};
    std::string condition{};  ///< with the varied parameter: motion_condition()
    bool practice{false};
    std::string device{};  ///< that was asked for, by the session: "Novint Falcon 1234"
    IntervalMotion motion{};
    std::optional<double> value{};  ///< of the varied parameter; nothing: none varies
};

/// "dibhr"; of a block that varies one: "plain, friction 0.3" or "plain, friction above 0.3".
[[nodiscard]] std::string motion_condition(const Block& block, const StudyInterval& interval);

/// All intervals that were recorded, in order. Throws InputError.
[[nodiscard]] std::vector<IntervalRow> motion_of(const Study& study,
                                                 const std::function<void(double)>& progress);

/// A condition over all participants; without practice.
struct MotionFinding {
    std::string condition{};
    IntervalMotion all{};  ///< of all intervals joined
    int intervals{0};
    // Means over participants, each one's intervals joined; all but the first over those who
    // touched it, not known where nobody did.
    Estimate contact_share{}, sent_newton{}, speed_mm_per_s{}, turning_deg{};
};

/// In the order of the protocol's conditions.
[[nodiscard]] std::vector<MotionFinding> motion_findings(const Protocol& protocol,
                                                         const std::vector<IntervalRow>& rows);

/// With what one participant touched, in all intervals that were recorded.
struct ParticipantHand {
    std::map<std::string, HandTicks> devices{};  ///< "mouse": nothing else was there

    [[nodiscard]] bool used_mouse() const noexcept;
    [[nodiscard]] bool used_only_mouse() const noexcept;  ///< no force was felt
};

/// One for each of the study's participants.
[[nodiscard]] std::vector<ParticipantHand> hands_in(const std::vector<IntervalRow>& rows,
                                                    std::size_t participants);

}  // namespace dibhr
