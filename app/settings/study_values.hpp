// What a condition of a study is felt with, as the command line would have said it.
#pragma once

#include <vector>

#include "app/settings/command_options.hpp"
#include "app/settings/consent.hpp"
#include "core/study/protocol.hpp"

namespace dibhr {

/// Algorithm, numbers, material, bump, cleaning and finger; the media and the stability are
/// TouchValues' own words. Throws InputError for a material that is not there.
[[nodiscard]] TouchRequest request_of(const TouchValues& values);

/// Stability control and the damping that the hand needs, unless the condition has them off.
void take_protections(const TouchValues& values, Settings& settings);

/// What protects the hand less in any interval, to which nobody has agreed here.
[[nodiscard]] std::vector<Doubt> doubts_of(const Protocol& protocol, const Consent& consent);

/// That a surface of these values can be felt, and as they say: throws InputError, in the names of
/// a study's page, where friction contradicts itself, one coefficient would take the other along,
/// or a texture has no bump map. Reads the material.
void require_felt(const TouchValues& values);

}  // namespace dibhr
