// Takes a condition's values by their names.
#include "app/settings/study_values.hpp"

#include "app/settings/material.hpp"
#include "core/video/cleaning/cleaning_options.hpp"

namespace dibhr {

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
    const auto word = [&values](const char* name) {
        const auto found = values.words.find(name);
        return found == values.words.end() ? std::string() : found->second;
    };
    given.algorithm = algorithm_named(word("algorithm"));
    if (const auto carry = word("carry"); !carry.empty()) given.carry = carry == "on";
    if (const auto moves = word("in-betweens"); !moves.empty()) request.in_betweens = moves == "on";
    if (const auto material = word("material"); !material.empty())
        given.material = material_called(material);
    given.bump = word("bump");
    request.preset = cleaning_named(word("cleaning"));
    request.raw_depth = request.preset == CleaningPreset::raw;
    return request;
}

}  // namespace dibhr
