// Collects all findings on a source's depth, and concludes from them once.
#include "core/video/sources/depth_finding.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_guess.hpp"
#include "core/video/depth/depth_words.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/layouts/data_sets.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSampled = 24;
constexpr int kLeastSampled = 4;
constexpr double kPixelsDecoded = 2.4e7;  ///< decoded in about half a second
constexpr double kBeyondNumbers = 0.92;   ///< facts as sure need no numbers

DepthStatement sidecars_of(const std::vector<fs::path>& places) {
    DepthStatement said;
    for (const fs::path& place : places) {
        if (const auto more = read_sidecar(place)) said.fill_in(*more);
    }
    return said;
}

void append(const Findings& more, Findings& rows) {
    rows.insert(rows.end(), more.begin(), more.end());
}

/// The data set of a source, but for one whose levels are decoded, and say it themselves.
std::optional<DataSetFacts> data_set_beside_codes(Sources& sources) {
    auto set = sources.data_set.of(sources.depth->facts());
    if (set && set->finding.statement.code) set.reset();
    return set;
}

bool is_on_kind_by_name(const Finding& row) {
    return row.evidence == Evidence::name && (row.statement.near || row.statement.unit);
}

/// What the name of a folder says; short words count alone: "dem" is a German article.
Findings findings_in_folder(const fs::path& folder, int bits) {
    constexpr std::size_t kShort = 3;
    const std::string name = folder.filename().string();
    const std::vector<std::string> words = words_of_name(name);
    const bool is_short = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return word.size() <= kShort && std::isalpha(static_cast<unsigned char>(word[0])) != 0 &&
               !findings_in_name(word, bits, "").empty();
    });
    if (!named_other(folder).empty() || (is_short && words.size() > 1)) return {};
    return findings_in_name(name, bits, "its folder's name");
}

/// The rows of the table but those of the numbers and of times: of the reader that took the file,
/// of what it and the layout found, of its data set, and of the name. Where the unit is sure, a
/// name that only says "depth" adds nothing.
Findings findings_on(const Sources& sources, const std::optional<DataSetFacts>& set) {
    const SourceFacts& facts = sources.depth->facts();
    Findings rows;
    if (sources.reader != nullptr) rows.push_back(finding_on_form(*sources.reader, facts));
    append(facts.findings, rows);
    append(sources.findings, rows);
    if (set) rows.push_back(set->finding);
    if (has_decoded_levels(facts) || std::any_of(rows.begin(), rows.end(), is_on_kind_by_name))
        return rows;
    const Findings by_name = findings_by_name(facts);
    const bool is_sure = !by_name.empty() && by_name.front().statement.unit;
    if (is_sure || !sure_facts({}, rows).unit) append(by_name, rows);
    if (!set) append(quantities_in_name(facts.picture().stem().string(), "its name"), rows);
    return rows;
}

/// Whether a person or a sure finding states all that the numbers could tell.
bool is_complete(const DepthStatement& known) {
    return known.no_data && known.unit && known.scale && known.near && known.range;
}

/// Whether the middle of the colour pictures is brighter than their sides; nothing: no colour.
std::optional<int> middle_of_colour(const Sources& sources) {
    if (!sources.colour) return {};
    constexpr int kMostColours = 3;
    return SampledLevels(sources.colour->samples(kMostColours), 8).middle_brighter_than_sides();
}

/// The rows on units, but for those of values that another row has usual distances for.
Findings units_beside(const SampledLevels& levels, const Findings& rows) {
    Findings units = levels.units();
    for (const Finding& row : rows)
        if (row.usual.most_m > 0.0)
            std::erase_if(units, [&row](const Finding& unit) {
                return state_same_values(unit.statement, row.statement);
            });
    return units;
}

/// The row on pictures that look like something else than depth, or none. Where a name or metadata
/// state the levels surely, the look of a photograph says nothing: heights of bark are as rough.
Findings findings_on_looks(std::span<const cv::Mat> pictures, int bits,
                           const DepthStatement& known) {
    constexpr std::size_t kMostInspected = 3;
    constexpr double kSurenessOfMask = 0.95;  // a flat shape that is to be felt may be so, too
    pictures = pictures.first(std::min(pictures.size(), kMostInspected));
    if (pictures.empty() || bits > 16) return {};
    const auto row = [](double sureness, const char* reason) {
        return Findings{{{}, Evidence::appearance, sureness, reason, std::string(kNoDepth)}};
    };
    if (std::all_of(pictures.begin(), pictures.end(), is_black_and_white))
        return row(kSurenessOfMask, "it is black and white alone, as a mask is");
    const auto is_photo = [](const cv::Mat& picture) {
        cv::Mat grey;
        cv::cvtColor(grey_of(picture), grey, cv::COLOR_GRAY2BGR);
        return looks_like_photo(grey);
    };
    if (bits > 8 || known.unit || !std::all_of(pictures.begin(), pictures.end(), is_photo))
        return {};
    return row(kSurenessOfAppearance, "it looks like a photograph");
}

/// The row that a map or a micrograph may be of no heights, or none: a name or a layout says what
/// its levels are, or they are of terrain.
Findings findings_on_other_quantities(const Findings& rows, const SampledLevels& levels) {
    constexpr double kSurenessOfOthers = 0.85;
    const bool is_named = std::any_of(rows.begin(), rows.end(), [](const Finding& row) {
        const bool says_it = row.evidence == Evidence::name || row.evidence == Evidence::layout;
        return says_it && row.statement.unit && row.sureness >= kSureEnough;
    });
    const auto found = std::find_if(rows.begin(), rows.end(), [&levels](const Finding& row) {
        return row.about == kMicrograph || (row.about == kMap && !levels.may_be_terrain());
    });
    if (is_named || found == rows.end()) return {};
    return {{{}, Evidence::numbers, kSurenessOfOthers, found->reason, std::string(kNoDepth)}};
}

/// Adds the rows of the numbers on facts that nobody states yet, or not surely, and on what other
/// rows state and they contradict. Returns the levels without those that are no data.
SampledLevels add_numbers(const Sources& sources, const RankedStatements& persons, Findings& rows) {
    const int bits = sources.depth->facts().bits;
    const std::vector<cv::Mat> pictures = sample_pictures(*sources.depth);
    SampledLevels levels(pictures, bits);
    const DepthStatement known = sure_facts(persons, rows, kBeyondNumbers);
    append(findings_on_looks(pictures, bits, known), rows);
    const bool names_no_data = std::any_of(rows.begin(), rows.end(), [](const Finding& row) {
        return row.statement.no_data.has_value();
    });
    if (!known.no_data && !names_no_data) append(levels.no_data(), rows);
    DepthMeaning meaning;
    static_cast<void>(conclude(persons, rows, meaning));
    levels.leave_out(meaning.no_data.value);
    append(findings_on_other_quantities(rows, levels), rows);
    const Findings contradictions = levels.contradictions(rows);
    if (!known.unit || !contradictions.empty()) append(units_beside(levels, rows), rows);
    append(contradictions, rows);
    // Where distances or disparities are sure, near is too.
    if (!known.near && known.unit.value_or(DepthUnit::levels) == DepthUnit::levels)
        append(levels.near(levels.middle_brighter_than_sides() == 0 ? std::nullopt
                                                                    : middle_of_colour(sources)),
               rows);
    return levels;
}

/// Levels unchanged, as far as the request does not state otherwise.
DepthStatement as_in_file(const DepthRequest& request, int bits) {
    DepthStatement said = request.recorded;
    said.fill_in(request.command_line);
    const bool is_dark = said.near == NearLevels::dark;
    const double highest = highest_level(bits == kRealBits ? 8 : bits);
    DepthStatement file;
    file.no_data = std::vector<double>{};
    if (said.unit.value_or(DepthUnit::levels) != DepthUnit::levels) return file;
    file.unit = DepthUnit::levels;
    file.near = is_dark ? NearLevels::dark : NearLevels::bright;
    const double last = highest * said.scale.value_or(1.0);
    file.range = is_dark ? DepthRange{0.0, last} : DepthRange{last, 0.0};
    return file;
}

/// The defaults: two files, grey, a relief, aligned, automatic cleaning, touched by a point, at the
/// times of its source.
DepthStatement default_statement() {
    return {.packing = DepthPacking::separate,
            .code = DepthCode::grey,
            .geometry = Geometry::relief,
            .registration = Registration{},
            .cleaning = CleaningChoice{},
            .finger_mm = 0.0,
            .time_offset_s = 0.0,
            .frames_per_s = 0.0};
}

/// Throws InputError for a range that is impossible in its unit, or for 32-bit floats.
void require_range(const DepthMeaning& meaning, int bits, const fs::path& file) {
    constexpr double kMostSteps = 1e12;  // sums and products of them stay numbers in floats
    const DepthRange& range = meaning.range.value;
    const bool falls = range.near > range.far;
    const bool bright = meaning.near.value == NearLevels::bright;
    const bool above_zero = range.near > 0.0 && range.far > 0.0;
    if (meaning.unit.value == DepthUnit::disparity && !above_zero)
        throw InputError(shown(file) +
                         ": a range of disparities lies above 0, near to far; give "
                         "another --depth-range");
    const double steps = highest_level_of(meaning, bits);
    if (!(steps >= 1.0 / kMostSteps && steps <= kMostSteps))
        throw InputError(shown(file) + ": its range, " + short_text(range.near) + " to " +
                         short_text(range.far) +
                         ", is no depth of a scene; give another --depth-range or --depth-scale");
    if (falls != bright)
        throw InputError(shown(file) + ": its range, near to far, " + (falls ? "falls" : "rises") +
                         ", but near is " + std::string(name_of(meaning.near.value)) +
                         "; turn --depth-range or --near around");
}

/// The kept answer for the files of this folder, where the file leaves open what it states, and it
/// is one of the likely ones; empty: there is none.
DepthStatement folder_choice(const DepthConclusion& conclusion, const DepthRequest& request,
                             const fs::path& file) {
    const std::vector<DepthAlternative>& all = conclusion.alternatives;
    if (all.empty()) return {};
    DepthStatement kept = kept_folder_choice(request, file);
    const bool is_likely = std::any_of(all.begin(), all.end(), [&](const auto& alternative) {
        return alternative.statement == kept;
    });
    return is_likely ? kept : DepthStatement{};
}

/// Of the answers those that a stated range allows; none, where that leaves no choice.
void keep_that_fit(const DepthRange& range, std::vector<DepthAlternative>& alternatives) {
    const NearLevels near = range.near > range.far ? NearLevels::bright : NearLevels::dark;
    std::erase_if(alternatives, [near](const DepthAlternative& alternative) {
        return alternative.statement.near != near;
    });
    if (alternatives.size() < 2) alternatives.clear();
}

}  // namespace

Findings findings_by_name(const SourceFacts& facts) {
    if (facts.live) return findings_in_name(facts.file.filename().string(), facts.bits, "its name");
    std::error_code failed;
    const auto place_of = [&failed](const fs::path& place) {
        const fs::path whole = fs::absolute(place, failed).lexically_normal();
        return whole.has_filename() ? whole : whole.parent_path();
    };
    const fs::path picture = place_of(facts.picture());
    Findings rows;
    if (named_other(picture).empty())
        rows = findings_in_name(picture.stem().string(), facts.bits, "its name");
    bool is_silent = rows.empty() && !named_depth(picture);
    const fs::path opened = is_folder(facts.file) ? place_of(facts.file) : fs::path();
    for (const fs::path& folder : {picture.parent_path(), opened}) {
        Findings more = findings_in_folder(folder, facts.bits);
        const bool has_scale = !more.empty() && more.front().statement.scale;
        const bool is_weak = !rows.empty() && !rows.front().statement.unit;
        if (is_silent || (is_weak && has_scale)) rows = std::move(more);
        is_silent = is_silent && rows.empty() && !named_depth(folder);
    }
    return rows;
}

std::vector<cv::Mat> sample_pictures(PictureSource& source) {
    const double pixels = static_cast<double>(source.facts().columns) * source.facts().rows;
    const double most =
        std::clamp<double>(kPixelsDecoded / std::max(pixels, 1.0), kLeastSampled, kMostSampled);
    return source.samples(static_cast<int>(most));
}

DepthStatement statement_for(const fs::path& depth, const fs::path& colour,
                             const DepthRequest& request) {
    DepthStatement said = request.recorded;
    said.fill_in(request.command_line);
    if (!request.find_out) return said;
    said.fill_in(with_kept_choice(request, depth).panel);
    said.fill_in(sidecars_of({depth, colour}));
    return said;
}

FoundScale find_scale(Sources& sources, const DepthRequest& request) {
    PictureSource& depth = *sources.depth;
    const SourceFacts& facts = depth.facts();
    const bool said =
        request.command_line != DepthStatement{} || request.recorded != DepthStatement{};
    if (!request.find_out && !said) return {DepthScale::as_recorded(facts.bits)};
    RankedStatements persons{{Origin::recorded, request.recorded},
                             {Origin::command_line, request.command_line}};
    Findings rows;
    DepthMeaning meaning;
    if (request.find_out) {
        std::vector<fs::path> places{facts.file};
        if (sources.colour) places.push_back(sources.colour->facts().file);
        persons.insert(persons.end(),
                       {{Origin::panel, request.panel}, {Origin::sidecar, sidecars_of(places)}});
        rows = findings_on(sources, data_set_beside_codes(sources));
        merge_by_priority({{Origin::found, default_statement()}}, meaning);
    } else {
        persons.emplace_back(Origin::assumed, as_in_file(request, facts.bits));
    }
    // Sampling a video takes long: only where something is left to find out.
    std::optional<SampledLevels> levels;
    if (!is_complete(sure_facts(persons, rows, kBeyondNumbers)))
        levels = add_numbers(sources, persons, rows);
    DepthConclusion conclusion = conclude(persons, rows, meaning);
    const DepthStatement of_folder = folder_choice(conclusion, request, facts.file);
    if (!(of_folder == DepthStatement{})) {
        persons.emplace_back(Origin::folder, of_folder);
        conclusion = conclude(persons, rows, meaning);
    }
    if (auto& camera = meaning.intrinsics.value)
        camera = in_pixels(*camera, facts.columns, facts.rows);
    const bool states_range =
        std::any_of(conclusion.findings.begin(), conclusion.findings.end(),
                    [](const Finding& finding) { return finding.statement.range.has_value(); });
    if (levels && !states_range) meaning.range = {levels->range(meaning), Origin::found};
    if (states_range) keep_that_fit(meaning.range.value, conclusion.alternatives);
    for (DepthAlternative& alternative : conclusion.alternatives)
        alternative.range = levels && !states_range
                                ? levels->range(meaning_by(alternative, meaning))
                                : meaning.range.value;
    require_range(meaning, facts.bits, facts.file);
    return {DepthScale(meaning, facts.bits), std::move(conclusion)};
}

}  // namespace dibhr
