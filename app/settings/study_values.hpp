// The values of a study's condition, as options of the command line.
#pragma once

#include <vector>

#include "app/settings/command_options.hpp"
#include "app/settings/consent.hpp"
#include "core/study/protocol.hpp"

namespace dibhr {

/// Algorithm, numbers, material, bump map, cleaning and finger, but not media and stability. Throws
/// InputError for a material that does not exist.
[[nodiscard]] TouchRequest request_of(const TouchValues& values);

/// Sets stability control and damping as needed on, unless the condition has them off.
void apply_protections(const TouchValues& values, Settings& settings);

/// The settings of any interval that protect the hand less, without consent here.
[[nodiscard]] std::vector<UnsafeSetting> unsafe_settings_of(const Protocol& protocol,
                                                            const Consent& consent);

/// Validates the values; reads the material. Throws InputError, with the names used on a study's
/// page, where dynamic friction is above static friction, one coefficient would change the other
/// unseen, or a texture has no bump map.
void validate_values(const TouchValues& values);

}  // namespace dibhr
