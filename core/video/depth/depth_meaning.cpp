// Names, and one voice over another.
#include "core/video/depth/depth_meaning.hpp"

#include "core/files/plain_text.hpp"

namespace dibhr {

std::string_view name_of(NearLevels value) noexcept {
    return value == NearLevels::bright ? "bright" : "dark";
}

std::string_view name_of(DepthUnit value) noexcept {
    switch (value) {
        case DepthUnit::levels:
            return "levels";
        case DepthUnit::disparity:
            return "disparity";
        case DepthUnit::mm:
            return "mm";
        case DepthUnit::m:
            return "m";
    }
    return {};
}

std::string_view name_of(DepthPacking value) noexcept {
    switch (value) {
        case DepthPacking::separate:
            return "separate";
        case DepthPacking::left_right:
            return "left-right";
        case DepthPacking::right_left:
            return "right-left";
        case DepthPacking::top_bottom:
            return "top-bottom";
        case DepthPacking::bottom_top:
            return "bottom-top";
        case DepthPacking::tracks:
            return "tracks";
    }
    return {};
}

std::string_view name_of(DepthCode value) noexcept {
    return value == DepthCode::grey ? "grey" : "hue";
}

std::string_view name_of(Geometry value) noexcept {
    return value == Geometry::relief ? "relief" : "true";
}

void DepthStatement::fill_in(const DepthStatement& other) {
    const auto take = [](auto& mine, const auto& theirs) {
        if (!mine) mine = theirs;
    };
    take(near, other.near);
    take(unit, other.unit);
    take(scale, other.scale);
    take(range, other.range);
    take(no_data, other.no_data);
    take(packing, other.packing);
    take(code, other.code);
    take(geometry, other.geometry);
    take(intrinsics, other.intrinsics);
}

std::string_view name_of(Origin value) noexcept {
    switch (value) {
        case Origin::assumed:
            return "assumed";
        case Origin::found:
            return "found";
        case Origin::sidecar:
            return "sidecar";
        case Origin::panel:
            return "panel";
        case Origin::command_line:
            return "command line";
        case Origin::recorded:
            return "recorded";
    }
    return {};
}

DepthStatement DepthMeaning::statement() const {
    DepthStatement all{near.value,    unit.value, scale.value,    range.value, no_data.value,
                       packing.value, code.value, geometry.value, {}};
    if (intrinsics) all.intrinsics = intrinsics->value;
    return all;
}

void hear(const Voices& voices, DepthMeaning& meaning) {
    const auto take = [&voices](auto& fact, auto said) {
        for (const auto& [origin, statement] : voices) {
            const auto& value = statement.*said;
            if (!value) continue;
            fact = {*value, origin};
            return;
        }
    };
    take(meaning.near, &DepthStatement::near);
    take(meaning.unit, &DepthStatement::unit);
    take(meaning.scale, &DepthStatement::scale);
    take(meaning.range, &DepthStatement::range);
    take(meaning.no_data, &DepthStatement::no_data);
    take(meaning.packing, &DepthStatement::packing);
    take(meaning.code, &DepthStatement::code);
    take(meaning.geometry, &DepthStatement::geometry);
    Known<Intrinsics> intrinsics{meaning.intrinsics.value_or(Known<Intrinsics>{})};
    const Intrinsics before = intrinsics.value;
    take(intrinsics, &DepthStatement::intrinsics);
    if (intrinsics.value != before) meaning.intrinsics = intrinsics;
}

double on_the_line(DepthUnit unit, double value) {
    return unit == DepthUnit::disparity ? 1.0 / value : value;
}

double value_at(const DepthMeaning& meaning, double nearness) {
    const DepthUnit unit = meaning.unit.value;
    const double far = on_the_line(unit, meaning.range.value.far);
    const double near = on_the_line(unit, meaning.range.value.near);
    return on_the_line(unit, far + nearness * (near - far));  // its own inverse
}

std::string in_words(const DepthMeaning& meaning) {
    std::string words;
    const DepthRange& range = meaning.range.value;
    const std::string ends = short_text(range.near, 4) + " to " + short_text(range.far, 4);
    switch (meaning.unit.value) {
        case DepthUnit::levels:
            words = "levels " + ends;
            break;
        case DepthUnit::disparity:
            words = "disparity " + ends;
            break;
        case DepthUnit::mm:
            words = "distance " + ends + " mm";
            break;
        case DepthUnit::m:
            words = "distance " + ends + " m";
            break;
    }
    words += ", near is " + std::string(name_of(meaning.near.value));
    if (meaning.no_data.value.empty()) return words;
    words += ", no data is";
    for (const double level : meaning.no_data.value) words += " " + short_text(level);
    return words;
}

std::vector<std::string> assumed_facts(const DepthMeaning& meaning) {
    std::vector<std::string> names;
    const auto add = [&names](const char* name, const auto& fact) {
        if (fact.origin == Origin::assumed) names.emplace_back(name);
    };
    add("near", meaning.near);
    add("unit", meaning.unit);
    add("scale", meaning.scale);
    add("range", meaning.range);
    add("no_data", meaning.no_data);
    add("packing", meaning.packing);
    add("code", meaning.code);
    return names;
}

}  // namespace dibhr
