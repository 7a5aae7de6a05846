// What is found out about a depth source: one table of findings, and the conclusion from all.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Where a finding comes from, the most reliable first. A person's statement is always right.
/// `magic`: the first bytes of the file. `layout`: which files lie where. `code`: pictures in
/// colours decode as numbers, without contradiction.
enum class Evidence { person, magic, metadata, layout, code, name, appearance, numbers };

/// "person", "magic", "metadata", "layout", "code", "name", "appearance", "numbers".
[[nodiscard]] std::string_view name_of(Evidence value) noexcept;

// The sureness of common kinds of evidence.
inline constexpr double kSurenessOfMetadata = 0.995;  ///< also of magic, and a data set's layout
/// Of 400 coloured pictures that are no depth (coloured_pictures_test.cpp) none decodes, so that 3
/// in 400 may, at most. Where one coloured depth in ten is a code and the others are paintings, of
/// those that decode 0.1 / (0.1 + 0.9 x 3 / 400) are of the code.
inline constexpr double kSurenessOfCode = 0.94;
inline constexpr double kSurenessOfName = 0.97;
inline constexpr double kSurenessOfAppearance = 0.85;
/// From here on a fact counts as found; below, it is assumed, and a person is asked.
inline constexpr double kSureEnough = 0.9;

/// The distances that depth usually has where a statement on its unit and scale is right; others
/// contradict it.
struct UsualDistances {
    std::string of{};                  ///< whose they are: "KITTI depth completion"
    double least_m{0.0}, most_m{0.0};  ///< 0, 0: any
    double reach_m{0.0};   ///< a scene that reaches as far may begin nearer; 0: none may
    bool is_dense{false};  ///< without holes
};

/// One row of the table: facts that one piece of evidence states.
struct Finding {
    Finding() = default;
    /// No aggregate: of one, GCC 12 destroys members of the nested statement twice where a text
    /// behind it throws.
    Finding(DepthStatement stated, Evidence from, double sure, std::string why,
            std::string subject = {}, UsualDistances expected = {})
        : statement(std::move(stated)),
          evidence(from),
          sureness(sure),
          reason(std::move(why)),
          about(std::move(subject)),
          usual(std::move(expected)) {}

    DepthStatement statement{};
    Evidence evidence{Evidence::numbers};
    double sureness{1.0};    ///< probability in (0, 1) that the statement is right, from this alone
    std::string reason{};    ///< for people, a few words: "'height' in its name"
    std::string about{};     ///< what a row without statement is about: "form PNG"; else empty
    UsualDistances usual{};  ///< of a statement on the unit
};

using Findings = std::vector<Finding>;

/// What a row is about that says that the pictures look like something else than depth. It lowers
/// the probability of every meaning, as the pictures were given or named as depth.
inline constexpr std::string_view kNoDepth = "no depth";

/// What a row is about that says that the file is of a kind that holds heights, and other
/// quantities as well; the numbers of terrain tell a map of heights, and names tell either.
inline constexpr std::string_view kMap = "map";
inline constexpr std::string_view kMicrograph = "micrograph";

/// What the metadata of a file state.
[[nodiscard]] Finding finding_of_metadata(const DepthStatement& statement,
                                          const std::string& reason);

/// Whether both state the same unit and scale; a scale that is not stated is 1.
[[nodiscard]] bool state_same_values(const DepthStatement& one, const DepthStatement& other);

/// A kind of values, with its probability from all findings; near and unit belong together (a
/// distance is near where dark, a disparity where bright).
struct DepthHypothesis {
    NearLevels near{NearLevels::bright};
    DepthUnit unit{DepthUnit::levels};
    double scale{1.0};
    double probability{0.0};  ///< in [0, 1]; over all hypotheses the sum is 1
};

/// The hypotheses by falling probability. Independent findings are combined (naive Bayes): a single
/// one gives its statement the probability `sureness`; with several, a hypothesis gains
/// log(sureness / p) of each finding that it agrees with, and log((1 - sureness) / (1 - p)) of each
/// that it contradicts, where p is the share of all such hypotheses before any finding. A sureness
/// below p is evidence against the statement. A distance of no stated scale has scale 1; 0.2 mm and
/// 0.0002 m are the same.
[[nodiscard]] std::vector<DepthHypothesis> weigh(const Findings& findings);

/// One of the answers that are possible: near, unit and scale, all stated.
struct DepthAlternative {
    DepthStatement statement{};
    double probability{0.0};
    DepthRange range{};  ///< that the depth has by this answer
};

/// The meaning by one of the answers, with its range; the other facts stay.
[[nodiscard]] DepthMeaning meaning_by(const DepthAlternative& answer, DepthMeaning meaning);

/// The table, and how sure the meaning concluded from it is.
struct DepthConclusion {
    Findings findings{};    ///< those of persons first
    double sure{1.0};       ///< probability that near, unit and scale are all right
    double near_sure{1.0};  ///< of near alone
    double unit_sure{1.0};  ///< of unit and scale
    /// Why the pictures may be no depth, for people: "it looks like a photograph"; empty: nothing
    /// says so, or a person states what the levels are.
    std::string doubt{};
    /// The likeliest two to four answers, by falling probability; the first one is the meaning's.
    /// Empty where it is sure enough, or a person stated near, unit or range.
    std::vector<DepthAlternative> alternatives{};
};

/// The facts that a person states, or a finding of at least that sureness.
[[nodiscard]] DepthStatement sure_facts(const RankedStatements& persons, const Findings& findings,
                                        double least = kSureEnough);

/// The reasons of the sure findings that state facts, but of those that look at pictures alone:
/// "array 'disparity', array 'K'".
[[nodiscard]] std::string origins_of(const Findings& findings);

/// Concludes all facts but the range, which it only takes where it is stated, and `found_in`.
/// Persons' statements beat all findings. Near, unit and scale are weighed; of the other facts the
/// surest finding counts. A fact of probability kSureEnough or more gets the origin `found`, others
/// `assumed`; facts without any statement stay as they are in `meaning`.
[[nodiscard]] DepthConclusion conclude(const RankedStatements& persons, const Findings& findings,
                                       DepthMeaning& meaning);

}  // namespace dibhr
