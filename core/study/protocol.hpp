// A study as a person writes it on a page: media, conditions, blocks of trials, and what is asked
// in them. Plain data, and its reading from study.toml (README.md describes the keys).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/enum_names.hpp"
#include "core/psychophysics/staircase.hpp"

namespace dibhr {

/// Touch parameters of an interval by the names of the command line. Later values replace earlier
/// ones.
struct TouchValues {
    /// "friction" (both coefficients), "finger" (mm) and the names of touch_numbers().
    std::map<std::string, double> numbers{};
    /// "material", "cleaning", "bump" (a file, absolute), "media" (a name of Protocol::media or
    /// "sample"), the names of touch_choices(), and those of touch_switches(), "in-betweens" and
    /// "stability" ("on", "off").
    std::map<std::string, std::string> words{};

    bool operator==(const TouchValues&) const = default;
};

/// "material bark, friction 0.4"; without values "the program's defaults".
[[nodiscard]] std::string in_words(const TouchValues& values);

/// `base`, with the values of `overrides` in place of its own. In one table a single coefficient
/// has priority over "friction"; "friction" of `overrides` removes both coefficients of `base`.
[[nodiscard]] TouchValues with_overrides(const TouchValues& base, const TouchValues& overrides);

/// Text, a picture, or both; empty: nothing is shown.
struct StudyPage {
    std::string text{};
    std::filesystem::path picture{};  ///< absolute

    [[nodiscard]] bool empty() const noexcept { return text.empty() && picture.empty(); }
};

/// Files and their name. The built-in sample has no files and the name "sample".
struct StudyMedia {
    std::string name{};
    std::filesystem::path colour{};  ///< absolute, as `depth`
    std::filesystem::path depth{};   ///< empty: found beside the colour
};

/// The media that always exists, and is used where none is named.
inline constexpr const char* kSampleMedia = "sample";

/// A condition: the base values, with its own in their place.
struct Condition {
    std::string name{};  ///< of crossed factors "dibhr+smooth"
    TouchValues values{};
    std::map<std::string, std::string> levels{};  ///< its level in each factor, if crossed
};

enum class TrialForm : std::uint8_t { explore, two_interval, three_interval, adjust, rating };
inline constexpr std::array<NamedValue<TrialForm>, 5> kTrialForms{
    {{TrialForm::explore, "explore", "Free exploration"},
     {TrialForm::two_interval, "two-interval", "Two-interval forced choice"},
     {TrialForm::three_interval, "three-interval", "Three-interval oddity"},
     {TrialForm::adjust, "adjust", "Method of adjustment"},
     {TrialForm::rating, "rating", "Rating"}}};

/// How the items of a block follow each other: any order; balanced over participants, each after
/// each other equally often (Williams 1949); or as listed.
enum class TrialOrder : std::uint8_t { random, latin, listed };
inline constexpr std::array<NamedValue<TrialOrder>, 3> kTrialOrders{
    {{TrialOrder::random, "random", "Random"},
     {TrialOrder::latin, "latin", "Latin square"},
     {TrialOrder::listed, "listed", "As listed"}}};

/// What is drawn during an interval. `relief`: the relief, and the point under the hand. `touch`:
/// also goal, proxy and normal, as in the viewer, which shows friction and stiffness.
enum class StudyView : std::uint8_t { relief, blank, touch };
inline constexpr std::array<NamedValue<StudyView>, 3> kStudyViews{
    {{StudyView::relief, "relief", "The relief"},
     {StudyView::blank, "blank", "Nothing"},
     {StudyView::touch, "touch", "The relief and the touch"}}};

[[nodiscard]] constexpr const char* name_of(TrialForm form) noexcept {
    return entry_of(kTrialForms, form).name;
}
[[nodiscard]] constexpr const char* name_of(TrialOrder order) noexcept {
    return entry_of(kTrialOrders, order).name;
}

/// One parameter whose value differs from interval to interval: in the comparison it is
/// `reference` + level. Where `levels` is empty and there is no staircase, nothing varies.
struct Variation {
    std::string parameter{};                   ///< a name of TouchValues::numbers; empty: none
    double reference{0.0};                     ///< its value in the reference interval
    std::vector<double> levels{};              ///< constant stimuli: differences from it
    std::optional<StaircaseRule> staircase{};  ///< adaptive, its levels are differences from it
    int tracks{1};                             ///< interleaved runs of the rule, for each item
    /// Method of adjustment: the range in which the parameter starts and is changed.
    double lowest{0.0}, highest{0.0};

    [[nodiscard]] bool any() const noexcept { return !parameter.empty(); }
};

/// What is asked at a trial's end.
struct Question {
    std::string text{};
    /// Of `explore`: names of the answers, the first of which counts as a hit ("yes").
    std::vector<std::string> answers{};
    /// Of `rating`: whole numbers, both ends included, and what the ends are called.
    int lowest{1}, highest{7};
    std::string lowest_label{}, highest_label{};
};

/// Two conditions side by side, or one: then both are the same number.
struct StudyItem {
    std::size_t reference{0};  ///< in Protocol::conditions
    std::size_t comparison{0};

    bool operator==(const StudyItem&) const = default;
};

/// Trials of one form.
struct Block {
    std::string name{};
    bool practice{false};  ///< its answers are not counted
    bool feedback{false};  ///< shows right or wrong after each answer; default in practice
    TrialForm form{TrialForm::explore};
    /// `explore` and `rating`: one condition each. The others: pairs.
    std::vector<StudyItem> items{};
    Variation variation{};
    int repetitions{1};  ///< of each item (and each constant level); not of staircases
    TrialOrder order{TrialOrder::random};
    Question question{};
    StudyPage instructions{};
    StudyView view{StudyView::relief};
    bool again{false};       ///< at the question, an interval may be felt once more
    double interval_s{0.0};  ///< longest interval; 0: until the person goes on
    double answer_s{0.0};    ///< longest time to answer, after which none is recorded; 0: any
    int break_after{0};      ///< trials between pauses; 0: none within the block

    /// Intervals of a trial: 1, 2 or 3; of `adjust` 2, the second is the one that is turned.
    [[nodiscard]] int intervals() const noexcept;
    /// Its number of trials; with staircases the largest possible.
    [[nodiscard]] int most_trials() const noexcept;
};

/// A whole study.
struct Protocol {
    std::string title{};
    int version{1};
    std::uint64_t seed{1};
    StudyPage instructions{};
    StudyPage thanks{};
    std::vector<StudyMedia> media{};  ///< the sample comes first
    std::vector<std::string> factors{};
    std::vector<Condition> conditions{};  ///< crossed ones in order, the last factor the fastest
    std::vector<Block> blocks{};
    std::string text{};    ///< as it was read
    std::string sha256{};  ///< of that text

    [[nodiscard]] int most_trials() const noexcept;
    /// Null: none has that name.
    [[nodiscard]] const Condition* condition_named(const std::string& name) const noexcept;
};

/// The values of an interval: the condition's, with the varied parameter at `value`.
[[nodiscard]] TouchValues interval_values(const Condition& condition, const Variation& vary,
                                          double value);

/// Checks by other rooms, which make surfaces and open files. Each throws Error with what is wrong
/// (a number's name first); the reader adds the line. Empty: not checked.
struct StudyChecks {
    /// Called with each condition, and with each value that a block gives it.
    std::function<void(const TouchValues&)> values{};
    std::function<void(const StudyMedia&)> media{};
    std::function<void(const std::filesystem::path&)> picture{};  ///< of a StudyPage
    std::function<void(const std::filesystem::path&)> bump{};
};

/// The names that a protocol may use, from other rooms: passed in, so that none is included.
struct AllowedNames {
    /// Nothing: the page is from a study file. Any name is then accepted, and checks that only
    /// protect a future study are skipped, so that recorded answers stay readable.
    std::optional<std::vector<std::string>> materials{};
    std::vector<std::string> cleanings{"auto", "raw", "gentle", "sensor"};
    double thickest_finger_mm{25.0};
    StudyChecks checks{};
};

/// Reads and checks a page. Relative files are beside `file`. Throws InputError of one line:
/// "FILE:LINE: what is wrong, and what is allowed".
[[nodiscard]] Protocol read_protocol(const std::filesystem::path& file, const AllowedNames& names);

/// The same for a text; `file` gives its name and folder.
[[nodiscard]] Protocol protocol_of(const std::string& text, const std::filesystem::path& file,
                                   const AllowedNames& names);

}  // namespace dibhr
