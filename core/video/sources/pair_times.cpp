// Decides which times colour and depth have, and changes them.
#include "core/video/sources/pair_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace {

constexpr double kSameLength = 0.02;  ///< durations that differ by less are of one recording
constexpr double kHalfFrame = 0.5;
constexpr double kAsSource = std::numeric_limits<double>::quiet_NaN();

/// Rounding of a time that was read twice [s].
constexpr double kRounding_s = 0.1 * kTimeTolerance_s;

double mean_interval_s(const std::vector<double>& times_s) {
    return (times_s.back() - times_s.front()) / static_cast<double>(times_s.size() - 1);
}

}  // namespace

TimeMap::TimeMap(std::vector<double> own_s, std::vector<double> given_s)
    : own_s_(std::move(own_s)), given_s_(std::move(given_s)) {}

double TimeMap::given(double time_s) const {
    if (own_s_.empty()) return time_s * factor_;
    const auto after = std::lower_bound(own_s_.begin(), own_s_.end(), time_s);
    auto nearest = after;
    const bool is_before =
        after == own_s_.end() || (after != own_s_.begin() && time_s - after[-1] < *after - time_s);
    if (is_before) --nearest;
    return given_s_[static_cast<std::size_t>(nearest - own_s_.begin())];
}

double TimeMap::own_at(double time_s) const {
    if (own_s_.empty()) return time_s / factor_;
    const auto later =
        std::upper_bound(given_s_.begin(), given_s_.end(), time_s + kTimeTolerance_s);
    const auto shown = later == given_s_.begin() ? later : std::prev(later);
    return own_s_[static_cast<std::size_t>(shown - given_s_.begin())];
}

double TimeMap::own_from(double time_s) const {
    if (own_s_.empty()) return time_s / factor_ - kRounding_s;
    const auto from = std::lower_bound(given_s_.begin(), given_s_.end(), time_s);
    const auto at = from == given_s_.end() ? std::prev(from) : from;
    return own_s_[static_cast<std::size_t>(at - given_s_.begin())] - kRounding_s;
}

void TimeMap::change(SourceFacts& facts) const {
    if (own_s_.empty()) {
        facts.duration_s *= factor_;
        facts.frames_per_s /= factor_;
        return;
    }
    const double interval_s = mean_interval_s(given_s_);
    facts.frames_per_s = 1.0 / interval_s;
    facts.duration_s = given_s_.back() + interval_s;
    facts.frames = static_cast<std::int64_t>(given_s_.size());
    facts.frames_exact = true;
}

RetimedPictures::RetimedPictures(std::unique_ptr<PictureSource> source, TimeMap times,
                                 Timing timing, double start_s)
    : source_(std::move(source)), times_(std::move(times)), facts_(source_->facts()) {
    times_.change(facts_);
    facts_.timing = std::move(timing);
    if (!std::isnan(start_s)) facts_.start_s = start_s;
}

void RetimedPictures::update_facts() {
    facts_.take_progress(source_->facts());
    times_.change(facts_);
}

std::optional<TimedPicture> RetimedPictures::retimed(std::optional<TimedPicture> taken) {
    if (taken) taken->time_s = times_.given(taken->time_s);
    update_facts();
    return taken;
}

std::optional<TimedPicture> RetimedPictures::next() {
    return retimed(source_->next());
}

std::optional<TimedPicture> RetimedPictures::next_from(double earliest_s) {
    return retimed(source_->next_from(times_.own_from(earliest_s)));
}

void RetimedPictures::seek(double time_s) {
    source_->seek(times_.own_at(time_s));
    update_facts();
}

void RetimedPictures::seek_near(double time_s) {
    source_->seek_near(times_.own_at(time_s));
    update_facts();
}

void RetimedPictures::count_frames(std::int64_t most) {
    source_->count_frames(most);
    update_facts();
}

std::vector<double> RetimedPictures::picture_times_s() const {
    std::vector<double> times_s = source_->picture_times_s();
    for (double& time_s : times_s) time_s = times_.given(time_s);
    return times_s;
}

namespace {

using OwnedSource = std::unique_ptr<PictureSource>;

struct TimesEvidence {
    Evidence evidence;
    double sureness;
};
/// Of times by their origin, in the order of TimesFrom. A source takes the surest of its times.
constexpr std::array<TimesEvidence, 6> kTimesEvidence{{{Evidence::metadata, kSurenessOfMetadata},
                                                       {Evidence::name, kSurenessOfName},
                                                       {Evidence::layout, 0.99},
                                                       {Evidence::layout, 0.93},
                                                       {Evidence::metadata, 0.99},
                                                       {Evidence::numbers, 0.3}}};

const TimesEvidence& evidence_for(TimesFrom from) {
    return kTimesEvidence.at(static_cast<std::size_t>(from));
}

bool is_surer(TimesFrom from, TimesFrom than) {
    return evidence_for(from).sureness > evidence_for(than).sureness;
}

bool has_own_times(const SourceFacts& facts) {
    return is_surer(facts.timing.from, TimesFrom::other);
}

Finding finding_on_times(const std::string& whose, TimesFrom from, const std::string& text) {
    const auto [evidence, sureness] = evidence_for(from);
    return {{}, evidence, sureness, text, "times of the " + whose};
}

/// The times that a source has, and those that it may have by stamps.
void add_times(const PictureSource* source, const std::string& whose, Findings& rows) {
    if (source == nullptr || source->facts().still) return;
    const Timing& timing = source->facts().timing;
    rows.push_back(finding_on_times(whose, timing.from, timing.text));
    if (timing.stamps_s)
        rows.push_back(finding_on_times(whose, timing.stamps_from, timing.stamps_text));
}

/// The name in a sentence: of a folder and of a file.
std::string source_name(const SourceFacts& facts) {
    return shown(without_slash(facts.file).filename());
}

OwnedSource at_stated_rate(OwnedSource source, const Known<double>& frames_per_s) {
    const double nominal_per_s = source->facts().timing.nominal_per_s;
    if (!(frames_per_s.value > 0.0) || !(nominal_per_s > 0.0) || source->facts().still)
        return source;
    Timing timing = source->facts().timing;
    timing.from = TimesFrom::stated;
    timing.text = short_text(frames_per_s.value) + " frames a second (" +
                  std::string(name_of(frames_per_s.origin)) + ")";
    return std::make_unique<RetimedPictures>(std::move(source),
                                             TimeMap(nominal_per_s / frames_per_s.value),
                                             std::move(timing), kAsSource);
}

/// The source, whose pictures have the times `own_s`, at these in order; they begin at `start_s`.
OwnedSource at_times(OwnedSource source, std::vector<double> own_s, std::vector<double> times_s,
                     Timing timing, double start_s) {
    const double first_s = times_s.front();
    for (double& time_s : times_s) time_s -= first_s;
    return std::make_unique<RetimedPictures>(std::move(source),
                                             TimeMap(std::move(own_s), std::move(times_s)),
                                             std::move(timing), start_s);
}

/// By the stamps that were found for pictures without times.
OwnedSource at_stamps(OwnedSource source) {
    Timing timing = source->facts().timing;
    const auto stamps_s = timing.stamps_s;
    const bool may_fit =
        stamps_s && is_surer(timing.stamps_from, timing.from) && stamps_s->size() > 1;
    if (!may_fit) return source;
    std::vector<double> own_s = source->picture_times_s();
    if (own_s.size() != stamps_s->size()) return source;
    timing.from = timing.stamps_from;
    timing.text = timing.stamps_text;
    return at_times(std::move(source), std::move(own_s), *stamps_s, std::move(timing),
                    stamps_s->front());
}

/// Where each picture of a source stands among the frames of another one, in frames.
struct Positions {
    std::vector<double> at{};
    std::string text{};  ///< "frame by frame"
};

/// Every `step`-th frame.
std::vector<double> equal_steps(std::size_t count, double step) {
    std::vector<double> at;
    for (std::size_t k = 0; k < count; ++k) at.push_back(static_cast<double>(k) * step);
    return at;
}

/// Positions by frame numbers. The first frame is 1 where the numbers begin at 1, or have no 0 and
/// end at the number of frames; else 0. Nothing where they go beyond the frames.
std::optional<Positions> by_numbers(const std::vector<double>& numbers, double frames,
                                    double slack) {
    const bool from_1 = numbers.front() == 1.0 || numbers.back() == frames;
    const double base = numbers.front() > 0.0 && from_1 ? 1.0 : 0.0;
    if (numbers.front() < 0.0 || numbers.back() - base > frames - 1.0 + slack) return std::nullopt;
    Positions positions;
    for (const double number : numbers) positions.at.push_back(number - base);
    positions.text =
        base > 0.0 ? "by the numbers in the names, from 1" : "by the numbers in the names, from 0";
    return positions;
}

/// Every n-th frame, or n pictures for each frame, where the counts divide.
std::optional<Positions> by_ratio(std::size_t pictures, std::size_t frames) {
    const bool fewer = pictures < frames;
    const std::size_t most = std::max(pictures, frames);
    const std::size_t least = std::min(pictures, frames);
    const std::size_t ratio = (2 * most + least) / (2 * least);  // rounded
    if (ratio < 2 || (most + ratio - 1) / ratio != least) return std::nullopt;
    const auto step = static_cast<double>(ratio);
    if (fewer)
        return Positions{equal_steps(pictures, step),
                         "one picture for every " + std::to_string(ratio) + " frames"};
    return Positions{equal_steps(pictures, 1.0 / step),
                     std::to_string(ratio) + " pictures for each frame"};
}

/// `lengths_agree`: the pictures' own times last as long as the other source.
std::optional<Positions> positions_of(const Timing& timing, std::size_t pictures,
                                      std::size_t frames, bool lengths_agree) {
    if (pictures == frames) return Positions{equal_steps(pictures, 1.0), "frame by frame"};
    const auto counted = static_cast<double>(frames);
    const double slack = kHalfFrame + kSameLength * counted;
    const bool has_numbers = timing.numbers && timing.numbers->size() == pictures;
    const std::vector<double> numbers = has_numbers ? *timing.numbers : equal_steps(pictures, 1.0);
    std::optional<Positions> numbered = by_numbers(numbers, counted, slack);
    if (numbered && !has_numbers) numbered->text = "frame by frame";
    // Numbers with gaps count something else than these pictures: most likely the frames.
    const bool has_gaps =
        numbers.back() - numbers.front() > static_cast<double>(pictures - 1) + kHalfFrame;
    const bool reaches_end = numbered && numbered->at.back() >= counted - 1.0 - slack;
    if (numbered && (has_gaps || reaches_end)) return numbered;
    if (auto stepped = by_ratio(pictures, frames)) return stepped;
    return lengths_agree ? std::nullopt : numbered;
}

/// The time at a position between frames; beyond the last frame as far apart as the last two.
double time_at(const std::vector<double>& times_s, double position) {
    const auto last = static_cast<double>(times_s.size() - 1);
    const double before = std::floor(std::clamp(position, 0.0, last));
    const auto k = static_cast<std::size_t>(before);
    if (position == before) return times_s[k];
    const std::size_t from = std::min(k, times_s.size() - 2);
    return times_s[from] +
           (position - static_cast<double>(from)) * (times_s[from + 1] - times_s[from]);
}

/// What differs by less lasts as long [s].
double length_tolerance_s(const SourceFacts& a, const SourceFacts& b) {
    const auto interval_s = [](const SourceFacts& facts) {
        return facts.frames_per_s > 0.0 ? 1.0 / facts.frames_per_s : 0.0;
    };
    return kHalfFrame * std::max(interval_s(a), interval_s(b)) +
           kSameLength * std::max(a.duration_s, b.duration_s);
}

bool last_as_long(const SourceFacts& a, const SourceFacts& b) {
    return std::fabs(a.duration_s - b.duration_s) <= length_tolerance_s(a, b);
}

/// Gives `source` the times of the frames of `other`; how much later it then begins than `other`
/// [s], or nothing where no plain relation was found.
std::optional<double> take_times_of(const PictureSource& other, OwnedSource& source) {
    const SourceFacts& facts = source->facts();
    const std::vector<double> times_s = other.picture_times_s();
    std::vector<double> own_s = source->picture_times_s();
    if (times_s.size() < 2 || own_s.size() < 2) return std::nullopt;
    const auto positions = positions_of(facts.timing, own_s.size(), times_s.size(),
                                        last_as_long(facts, other.facts()));
    if (!positions) return std::nullopt;
    std::vector<double> taken_s;
    for (const double position : positions->at) taken_s.push_back(time_at(times_s, position));
    Timing timing = facts.timing;
    timing.from = TimesFrom::other;
    timing.text = "those of " + source_name(other.facts()) + ", " + positions->text;
    const double later_s = taken_s.front();
    source = at_times(std::move(source), std::move(own_s), std::move(taken_s), std::move(timing),
                      other.facts().start_s + later_s);
    return later_s;
}

/// Whether both have times of one clock: stamps of the same time.
bool share_clock(const SourceFacts& a, const SourceFacts& b) {
    return a.start_s < b.start_s + b.duration_s && b.start_s < a.start_s + a.duration_s;
}

/// Whether both have stamps, or times of their files, that never meet.
bool are_of_two_clocks(const SourceFacts& depth, const SourceFacts& colour) {
    const auto is_stamped = [](const SourceFacts& facts) {
        return facts.timing.from == TimesFrom::names || facts.timing.from == TimesFrom::list;
    };
    const bool are_comparable =
        (is_stamped(depth) && is_stamped(colour)) ||
        (depth.timing.from == TimesFrom::file && colour.timing.from == TimesFrom::file);
    return are_comparable && std::isfinite(depth.start_s) && std::isfinite(colour.start_s) &&
           !share_clock(depth, colour);
}

/// A warning where colour and depth cannot both be right; else empty.
std::string contradiction(const SourceFacts& depth, const SourceFacts& colour) {
    if (!(depth.duration_s > 0.0) || !(colour.duration_s > 0.0)) return {};
    if (are_of_two_clocks(depth, colour))
        return "the times of colour and depth are of two clocks: both are taken to begin together; "
               "if they do not, state how much later the depth begins (--depth-offset; on the "
               "panel: Offset)";
    const bool is_paired =  // frame with frame
        depth.timing.from == TimesFrom::other || colour.timing.from == TimesFrom::other;
    if (is_paired || last_as_long(depth, colour)) return {};
    const bool of_files =
        depth.timing.from == TimesFrom::file && colour.timing.from == TimesFrom::file;
    const bool of_stamps = depth.timing.from != TimesFrom::assumed &&
                           colour.timing.from == depth.timing.from && share_clock(depth, colour);
    // Videos may end at different times; as many frames are the same frames at another rate.
    if (of_files ? depth.frames != colour.frames || depth.file == colour.file : of_stamps)
        return {};
    return "the colour lasts " + short_text(colour.duration_s, 4) + " s and the depth " +
           short_text(depth.duration_s, 4) +
           " s: they cannot both be right; state the depth's rate (--depth-fps; on the panel: "
           "Rate) or whose times it has (--depth-times; Times)";
}

/// Where one source has times and the other has none, or where a person states that they are
/// paired. Returns how much later the colour's own beginning then is; nothing: no times were taken.
std::optional<double> take_pair_times(Sources& sources, PairTimes& pair, bool is_stated,
                                      bool find_out) {
    const SourceFacts& depth = sources.depth->facts();
    const SourceFacts& colour = sources.colour->facts();
    const bool depth_has = has_own_times(depth);
    const bool colour_has = has_own_times(colour);
    const bool is_shared =
        depth.timing.from == TimesFrom::other || colour.timing.from == TimesFrom::other;
    // The same number is the same time, unless stated otherwise.
    const bool are_numbered = depth.timing.numbers != nullptr && colour.timing.numbers != nullptr;
    const bool may_differ =
        (is_stated || !are_numbered) && !is_shared && depth.frames != colour.frames;
    const bool is_paired = is_stated && pair.times.value == DepthTimes::paired;
    if (!is_paired && (is_stated || !find_out)) return std::nullopt;
    if (!is_stated && is_shared) pair.times.value = DepthTimes::paired;
    bool depth_takes = !depth_has && colour_has;
    bool colour_takes = depth_has && !colour_has;
    if (!depth_has && !colour_has && may_differ) {
        depth_takes = depth.frames < colour.frames;
        colour_takes = !depth_takes;
    }
    if (depth_has && colour_has) depth_takes = is_paired;
    std::optional<double> colour_later_s;
    if (depth_takes) {
        if (const auto later_s = take_times_of(*sources.colour, sources.depth))
            colour_later_s = -*later_s;
    } else if (colour_takes) {
        colour_later_s = take_times_of(*sources.depth, sources.colour);
    }
    if (!is_stated && colour_later_s) pair.times.value = DepthTimes::paired;
    return colour_later_s;
}

/// Sets how colour and depth with times of their own begin.
void take_beginnings(const SourceFacts& depth, const SourceFacts& colour, PairTimes& pair) {
    const bool is_shared = share_clock(depth, colour);
    if (is_shared) pair.colour_later_s = colour.start_s - depth.start_s;
    if (!has_own_times(depth) || !has_own_times(colour)) return;
    const double apart_s = std::fabs(pair.colour_later_s);
    std::string text = is_shared ? "begins with the depth, by the clock of both"
                                 : "taken to begin with the depth: they have no common clock";
    if (apart_s * colour.frames_per_s > kHalfFrame) {
        text = "begins " + short_text(apart_s, 3) + " s " +
               (pair.colour_later_s > 0.0 ? "after" : "before") +
               " the depth, by the clock of both";
        pair.beginning = "the colour " + text;
    }
    Finding row =
        finding_on_times("colour", is_shared ? colour.timing.from : TimesFrom::assumed, text);
    row.about = "begin of the colour";
    pair.findings.push_back(std::move(row));
}

}  // namespace

PairTimes pair_times(Sources& sources, const DepthMeaning& meaning, bool find_out) {
    PairTimes pair{.times = meaning.times, .offset_s = meaning.time_offset_s.value};
    const bool is_stated = meaning.times.origin != Origin::assumed;
    if (!is_stated) pair.times = {find_out ? DepthTimes::own : DepthTimes::counted, Origin::found};
    if (sources.depth->facts().live) return pair;
    add_times(sources.depth.get(), "depth", pair.findings);
    add_times(sources.colour.get(), "colour", pair.findings);
    sources.depth = at_stated_rate(std::move(sources.depth), meaning.frames_per_s);
    if (pair.times.value != DepthTimes::counted) {
        sources.depth = at_stamps(std::move(sources.depth));
        if (sources.colour) sources.colour = at_stamps(std::move(sources.colour));
    }
    if (!sources.colour || sources.colour->facts().still || sources.depth->facts().still)
        return pair;
    const auto taken_later_s = take_pair_times(sources, pair, is_stated, find_out);
    const SourceFacts& depth = sources.depth->facts();
    const SourceFacts& colour = sources.colour->facts();
    if (taken_later_s) {
        pair.colour_later_s = *taken_later_s;
        const bool of_depth = depth.timing.from == TimesFrom::other;
        pair.findings.push_back(
            finding_on_times(of_depth ? "depth" : "colour", TimesFrom::other,
                             of_depth ? depth.timing.text : colour.timing.text));
    } else {
        take_beginnings(depth, colour, pair);
    }
    pair.notice = contradiction(depth, colour);
    return pair;
}

}  // namespace dibhr
