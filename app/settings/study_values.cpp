// Converts a condition's values by their names.
#include "app/settings/study_values.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "app/settings/material.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr {

namespace {

/// A message about options with the names used on a study's page: without "--".
std::string as_on_a_page(std::string words) {
    for (auto at = words.find("--"); at != std::string::npos; at = words.find("--", at))
        words.erase(at, 2);
    return words;
}

/// Static friction given alone must not lower the dynamic friction unseen.
void require_dynamic_below(const GivenParameters& given) {
    TouchParameters any;
    const double* const fixed = given.value_of(number_of(any.friction.static_coefficient, any));
    if (fixed == nullptr || given.value_of(number_of(any.friction.dynamic_coefficient, any)))
        return;
    GivenParameters without = given;
    without.numbers.clear();
    TouchParameters parameters;
    without.apply(parameters);
    const double dynamic = parameters.friction.dynamic_coefficient;
    if (*fixed < dynamic)
        throw InputError("static-friction " + short_text(*fixed) +
                         " is below the dynamic friction " + short_text(dynamic) +
                         ", which it would lower, too: give dynamic-friction of at most as much, "
                         "or friction for both");
}

void require_bump(const GivenParameters& given) {
    if (!given.bump_file().empty()) return;
    for (const char* const name : {"roughness", "bump-size"}) {
        const double* const number = given.value_of(*touch_number(name));
        if (number != nullptr && *number > 0.0)
            throw InputError(std::string(name) + ' ' + short_text(*number) +
                             " changes nothing without a bump map: it needs bump = \"FILE\" or a "
                             "material that has one");
    }
}

}  // namespace

TouchRequest request_of(const TouchValues& values) {
    TouchRequest request;
    GivenParameters& given = request.given;
    for (const auto& [name, number] : values.numbers) {
        if (name == "friction")
            given.friction = number;
        else if (name == "finger")
            request.finger_mm = number;
        else if (const TouchNumber* const known = touch_number(name))
            given.numbers.emplace_back(known, number);
    }
    const auto word = [&values](std::string_view name) {
        const auto found = values.words.find(std::string(name));
        return found == values.words.end() ? std::string() : found->second;
    };
    for (const TouchChoice& choice : touch_choices())
        if (auto chosen = word(choice.name); !chosen.empty())
            given.words.emplace_back(&choice, std::move(chosen));
    for (const TouchSwitch& entry : touch_switches())
        if (const auto on = word(entry.name); !on.empty())
            given.switches.emplace_back(&entry, on == "on");
    if (const auto moves = word("in-betweens"); !moves.empty())
        request.in_betweens = named<InBetweens>(moves);
    if (const auto material = word("material"); !material.empty())
        given.material = material_named(material);
    given.bump = word("bump");
    request.preset = named<CleaningPreset>(word("cleaning"));
    return request;
}

void apply_protections(const TouchValues& values, Settings& settings) {
    const auto stability = values.words.find("stability");
    settings.stability = stability == values.words.end() || stability->second != "off";
    settings.damping_as_needed = !request_of(values).given.gives_damping();
}

std::vector<UnsafeSetting> unsafe_settings_of(const Protocol& protocol, const Consent& consent) {
    Settings least;
    for (const Condition& condition : protocol.conditions) {
        Settings worn;
        apply_protections(condition.values, worn);
        least.stability = least.stability && worn.stability;
        least.damping_as_needed = least.damping_as_needed && worn.damping_as_needed;
    }
    for (const Block& block : protocol.blocks)
        if (const TouchNumber* const varied = touch_number(block.variation.parameter))
            least.damping_as_needed =
                least.damping_as_needed && varied->topic != TouchTopic::damper;
    return consent.replace_unsafe(least);
}

void validate_values(const TouchValues& values) {
    const GivenParameters given = request_of(values).given;
    TouchParameters parameters;
    try {
        given.apply(parameters);
    } catch (const UsageError& error) {
        throw InputError(as_on_a_page(error.what()));
    }
    require_dynamic_below(given);
    require_bump(given);
}

}  // namespace dibhr
