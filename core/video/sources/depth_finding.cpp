// Collects all statements on a source's depth, the strongest first, and guesses open facts.
#include "core/video/sources/depth_finding.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_guess.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSampled = 24;
constexpr int kLeastSampled = 4;
constexpr double kPixelsDecoded = 2.4e7;  ///< decoded in about half a second

DepthStatement sidecars_of(const std::vector<fs::path>& places) {
    DepthStatement said;
    for (const fs::path& place : places) {
        if (const auto more = read_sidecar(place)) said.fill_in(*more);
    }
    return said;
}

/// Whether the name holds the whole word: "clip_disp.png" holds "disp", "displacement" does not.
bool has_word(const std::string& name, std::string_view word) {
    const auto is_letter = [&](std::size_t at) {
        return at < name.size() && std::isalpha(static_cast<unsigned char>(name[at])) != 0;
    };
    for (auto at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
        if (!is_letter(at - 1) && !is_letter(at + word.size())) return true;
    }
    return false;
}

DepthStatement statement_by_name(const fs::path& file) {
    DepthStatement said;
    const std::string name = lower_case(file.filename().string());
    if (has_word(name, "disp") || has_word(name, "disparity")) said.unit = DepthUnit::disparity;
    return said;
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

}  // namespace

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

DepthScale find_scale(const Sources& sources, const DepthRequest& request) {
    PictureSource& depth = *sources.depth;
    const SourceFacts& facts = depth.facts();
    const bool said =
        request.command_line != DepthStatement{} || request.recorded != DepthStatement{};
    if (!request.find_out && !said) return DepthScale::as_recorded(facts.bits);
    RankedStatements statements{{Origin::recorded, request.recorded},
                                {Origin::command_line, request.command_line}};
    if (request.find_out) {
        std::vector<fs::path> places{facts.file};
        if (sources.colour) places.push_back(sources.colour->facts().file);
        statements.insert(statements.end(),
                          {{Origin::panel, request.panel},
                           {Origin::sidecar, sidecars_of(places)},
                           {Origin::assumed, sources.assumed},
                           {sources.by_appearance ? Origin::assumed : Origin::found, facts.known},
                           {Origin::found, statement_by_name(facts.file)},
                           {Origin::found, sources.found},
                           {Origin::found, default_statement()}});
    } else {
        statements.emplace_back(Origin::assumed, as_in_file(request, facts.bits));
    }
    DepthMeaning meaning;
    meaning.found_in = facts.known_from;
    merge_by_priority(statements, meaning);
    if (auto& camera = meaning.intrinsics.value)
        camera = in_pixels(*camera, facts.columns, facts.rows);
    // Sampling a video takes long: only where something is left to guess.
    if (!is_all_stated(statements)) guess(sample_pictures(depth), facts.bits, meaning, statements);
    require_range(meaning, facts.bits, facts.file);
    return {meaning, facts.bits};
}

}  // namespace dibhr
