// Which code the levels have: stated by a person or a data set, or shown by the levels themselves.
#include "core/video/sources/coded_levels.hpp"

#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/depth/findings.hpp"
#include "core/video/depth/level_code.hpp"
#include "core/video/sources/depth_finding.hpp"
#include "core/video/sources/layouts/data_sets.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace {

void decode_as(Sources& sources, DepthCode code, const InverseLevels& law, const Finding& coded) {
    sources.depth = level_decoded(std::move(sources.depth), code, law, coded);
    sources.not_depth.clear();
}

/// As a person says.
void decode_as_stated(Sources& sources, DepthCode code) {
    const auto& set = sources.data_set.of(sources.depth->facts());
    const bool is_of_set = set && set->finding.statement.code == code;
    if (code == DepthCode::stereo && !is_of_set)
        throw InputError(shown(sources.depth->facts().file) +
                         " has no calib.txt beside it, which --depth-code stereo needs: put that "
                         "of the data set there, or give --depth-unit disparity");
    if (is_of_set)
        decode_as(sources, code, set->law, set->finding);
    else
        decode_as(sources, code, kKinectLevels, finding_on_code(code, true));
}

/// The unit of the levels as they are, where metadata, a layout or a name state it.
std::optional<DepthUnit> stated_unit(const SourceFacts& facts) {
    const auto by_reader = sure_facts({}, facts.findings).unit;
    return by_reader ? by_reader : sure_facts({}, findings_by_name(facts)).unit;
}

/// As its data set says, where the levels do not contradict it; else as the levels themselves show.
/// What their bits show counts only where nothing states something else.
void decode_as_found(Sources& sources) {
    const SourceFacts facts = sources.depth->facts();
    const auto& set = sources.data_set.of(facts);
    const auto code = set ? set->finding.statement.code : std::nullopt;
    if (code && is_of_levels(*code)) {
        if (may_be_of(sources.depth->samples(kKindSamples), *code))
            decode_as(sources, *code, set->law, set->finding);
        return;
    }
    const bool may_show = facts.bits == 16 ? facts.channels == 1 : facts.channels == 3;
    if (!may_show) return;
    const auto seen = level_code_in(sources.depth->samples(1));
    if (seen && has_whole_numbers(*seen)) {
        const auto unit = stated_unit(facts);
        const bool agrees = seen == DepthCode::depth16 && unit == DepthUnit::mm;
        const bool is_of_set = set && set->finding.sureness >= kSureEnough;
        if (is_of_set || (unit && !agrees)) return;
    }
    if (seen) decode_as(sources, *seen, kKinectLevels, finding_on_code(*seen, false));
}

}  // namespace

void decode_levels(Sources& sources, const DepthStatement& statement, bool find_out) {
    const SourceFacts& facts = sources.depth->facts();
    if (has_decoded_levels(facts)) return;
    if (statement.code) {
        if (is_of_levels(*statement.code)) decode_as_stated(sources, *statement.code);
        return;
    }
    const bool means_own =
        statement.unit == DepthUnit::levels || statement.unit == DepthUnit::disparity;
    if (find_out && !means_own && !facts.live && facts.bits >= 16) decode_as_found(sources);
}

}  // namespace dibhr
