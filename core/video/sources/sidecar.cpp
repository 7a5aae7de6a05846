// Reads and writes the table of what depth means.
#include "core/video/sources/sidecar.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostNoData = 64;

/// The finite numbers between `separator`s; nothing where one is invalid.
std::optional<std::vector<double>> numbers_in(const std::string& text, char separator) {
    std::vector<double> numbers;
    if (text.empty()) return numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        double number = 0.0;
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
        numbers.push_back(number);
        if (stop == end) return numbers;
        if (*stop != separator) return std::nullopt;
        at = stop + 1;
    }
}

std::optional<double> scale_of(const std::vector<double>& numbers) {
    const bool fits = numbers.size() == 1 && numbers.front() > 0.0;
    return fits ? std::optional(numbers.front()) : std::nullopt;
}

std::optional<DepthRange> range_of(const std::vector<double>& ends) {
    if (ends.size() != 2 || ends[0] == ends[1]) return std::nullopt;
    return DepthRange{ends[0], ends[1]};
}

std::optional<Intrinsics> field_of_view(double degrees) {
    if (!(degrees >= 1.0 && degrees < 179.0)) return std::nullopt;
    return Intrinsics{.field_of_view_deg = degrees};
}

std::optional<Intrinsics> intrinsics_of(const std::vector<double>& numbers) {
    if (numbers.size() == 1) return field_of_view(numbers.front());
    if (numbers.size() != 4) return std::nullopt;
    const Intrinsics camera{numbers[0], numbers[1], numbers[2], numbers[3]};
    return is_camera(camera) ? std::optional(camera) : std::nullopt;
}

std::optional<Registration> registration_of(const std::vector<double>& numbers) {
    constexpr double kMost_px = 1e5;
    constexpr double kMostScale = 100.0;
    if (numbers.size() != 3) return std::nullopt;
    const Registration registration{numbers[0], numbers[1], numbers[2]};
    const bool fits = std::fabs(registration.right_px) <= kMost_px &&
                      std::fabs(registration.down_px) <= kMost_px &&
                      registration.scale >= 1.0 / kMostScale && registration.scale <= kMostScale;
    return fits ? std::optional(registration) : std::nullopt;
}

/// The finite numbers of a number, an array, or a text in the command line's syntax.
std::optional<std::vector<double>> numbers_of(const toml::node& node, char separator) {
    if (const auto text = node.value_exact<std::string>()) return numbers_in(*text, separator);
    std::vector<double> numbers;
    const auto take = [&numbers](const toml::node& entry) {
        const auto number = entry.is_number() ? entry.value<double>() : std::nullopt;
        if (!number || !std::isfinite(*number)) return false;
        numbers.push_back(*number);
        return true;
    };
    const toml::array* const array = node.as_array();
    const bool all =
        array == nullptr ? take(node) : std::all_of(array->begin(), array->end(), take);
    return all ? std::optional(numbers) : std::nullopt;
}

std::optional<Intrinsics> intrinsics_of(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return intrinsics_in(*text);
    const auto numbers = numbers_of(node, ',');
    return numbers ? intrinsics_of(*numbers) : std::nullopt;
}

/// The name of a preset, or a list of steps.
std::optional<CleaningChoice> cleaning_of(const toml::node& node) {
    CleaningChoice choice;
    if (const auto word = node.value<std::string_view>()) {
        const auto preset = named<CleaningPreset>(*word);
        if (!preset || preset == CleaningPreset::own) return std::nullopt;
        choice.preset = *preset;
        return choice;
    }
    const toml::array* const names = node.as_array();
    if (names == nullptr) return std::nullopt;
    choice = {CleaningPreset::own, kRawSteps};
    for (const toml::node& name : *names) {
        bool known = false;
        visit_steps(choice.own, [&](std::string_view step_name, bool& step) {
            if (name.value<std::string_view>() == step_name) step = known = true;
        });
        if (!known) return std::nullopt;
    }
    return choice;
}

std::optional<double> finger_of(const std::vector<double>& numbers) {
    const bool fits = numbers.size() == 1 && numbers[0] >= 0.0 && numbers[0] <= kThickestFinger_mm;
    return fits ? std::optional(numbers.front()) : std::nullopt;
}

std::optional<double> offset_of(const std::vector<double>& numbers) {
    constexpr double kMost_s = 86400.0;
    const bool fits = numbers.size() == 1 && std::fabs(numbers[0]) <= kMost_s;
    return fits ? std::optional(numbers.front()) : std::nullopt;
}

/// 0: as the source has it.
std::optional<double> rate_of(const std::vector<double>& numbers) {
    constexpr double kLeast_per_s = 0.001;
    constexpr double kMost_per_s = 10000.0;
    const bool fits =
        numbers.size() == 1 &&
        (numbers[0] == 0.0 || (numbers[0] >= kLeast_per_s && numbers[0] <= kMost_per_s));
    return fits ? std::optional(numbers.front()) : std::nullopt;
}

template <typename Values>
auto word_of(const toml::node& node, const Values& values) {
    std::optional<typename Values::value_type> named;
    const auto word = node.value<std::string_view>().value_or("");
    for (const auto value : values)
        if (word == name_of(value)) named = value;
    return named;
}

/// "is none of counted, own, paired".
template <typename Values>
std::string is_none_of(const Values& values) {
    std::string names;
    for (const auto value : values)
        names += (names.empty() ? "" : ", ") + std::string(name_of(value));
    return "is none of " + names;
}

/// "depth-unit", "depth_unit" and "unit" are one name.
std::string plain_name(std::string_view key) {
    std::string name(key);
    std::replace(name.begin(), name.end(), '_', '-');
    constexpr std::string_view kPrefix = "depth-";
    return name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name;
}

/// Stores one fact. Returns what is wrong with it; empty: nothing.
std::string take(const std::string& name, const toml::node& node, DepthStatement& said) {
    const auto keep = [](auto& fact, auto value, const std::string& lacking) -> std::string {
        if (!value) return lacking;
        fact = *value;
        return {};
    };
    const bool automatic = node.value<std::string_view>() == "auto";
    if (automatic) return {};
    if (name == "near")
        return keep(said.near, word_of(node, kNearLevels), "is neither bright nor dark");
    if (name == "unit") return keep(said.unit, word_of(node, kDepthUnits), is_none_of(kDepthUnits));
    if (name == "packing")
        return keep(said.packing, word_of(node, kDepthPackings), is_none_of(kDepthPackings));
    if (name == "code") return keep(said.code, word_of(node, kDepthCodes), is_none_of(kDepthCodes));
    if (name == "geometry")
        return keep(said.geometry, word_of(node, kGeometries), "is neither relief nor true");
    if (name == "times")
        return keep(said.times, word_of(node, kDepthTimes), is_none_of(kDepthTimes));
    if (name == "intrinsics")
        return keep(
            said.intrinsics, intrinsics_of(node),
            "is neither [fx, fy, cx, cy] with fx and fy of 0.001 or more nor a field of view like "
            "\"60deg\"");
    if (name == "cleaning")
        return keep(said.cleaning, cleaning_of(node),
                    "is none of raw, gentle, sensor, auto, nor a list of steps like "
                    "[\"remove-spikes\", \"fill-holes\"]");
    const auto numbers = numbers_of(node, name == "range" ? ':' : ',');
    if (name == "scale")
        return keep(said.scale, numbers ? scale_of(*numbers) : std::nullopt,
                    "is not a number above 0");
    if (name == "range")
        return keep(said.range, numbers ? range_of(*numbers) : std::nullopt,
                    "is not two numbers that differ, [near, far]");
    if (name == "registration")
        return keep(said.registration, numbers ? registration_of(*numbers) : std::nullopt,
                    "is not [right, down, scale] in depth pixels, the scale 0.01 to 100");
    if (name == "finger")
        return keep(said.finger_mm, numbers ? finger_of(*numbers) : std::nullopt,
                    "is not a radius of 0 to 25 mm");
    if (name == "offset")
        return keep(said.time_offset_s, numbers ? offset_of(*numbers) : std::nullopt,
                    "is not a number of seconds, at most a day");
    if (name == "fps")
        return keep(said.frames_per_s, numbers ? rate_of(*numbers) : std::nullopt,
                    "is not a rate of 0.001 to 10000 frames a second");
    if (name == "no-data")
        return keep(said.no_data,
                    numbers && numbers->size() <= kMostNoData ? numbers : std::nullopt,
                    "is not a list of up to 64 levels");
    return "is not a key of the table [depth]";
}

toml::table parsed(const std::string& toml, const std::string& name) {
    try {
        return toml::parse(toml);
    } catch (const toml::parse_error& error) {
        std::ostringstream text;
        text << name << " cannot be understood at line " << error.source().begin.line << " ("
             << error.description() << "): correct or delete it";
        throw InputError(one_line(text.str()));  // it quotes the file
    }
}

std::string content_of(const fs::path& file) {
    if (auto content = small_text_in(file)) return *std::move(content);
    throw InputError(shown(file) + " cannot be read as a sidecar: make it readable or move it");
}

std::optional<fs::path> find_sidecar(const fs::path& media) {
    std::error_code ignored;
    const fs::path longer = without_slash(media).string() + ".toml";
    for (const fs::path& file : {sidecar_of(media), longer})
        if (fs::exists(file, ignored)) return file;
    return std::nullopt;
}

std::string list_of(const std::vector<double>& numbers) {
    std::string list = "[";
    for (const double number : numbers) list += (list.size() > 1 ? ", " : "") + number_text(number);
    return list + "]";
}

std::string text_of(const CleaningChoice& choice) {
    if (choice.preset != CleaningPreset::own)
        return '"' + std::string(name_of(choice.preset)) + '"';
    std::string list = "[";
    visit_steps(choice.own, [&list](std::string_view name, bool step) {
        if (step) list += (list.size() > 1 ? ", \"" : "\"") + std::string(name) + '"';
    });
    return list + "]";
}

}  // namespace

fs::path sidecar_of(const fs::path& media) {
    return without_slash(media).replace_extension(".toml");
}

std::optional<DepthStatement> read_sidecar(const fs::path& media) {
    if (media.empty()) return std::nullopt;
    const auto file = find_sidecar(media);
    return file ? read_statement(*file) : std::nullopt;
}

std::optional<DepthStatement> read_statement(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return std::nullopt;
    return statement_in(content_of(file), shown(file));
}

void write_sidecar(const fs::path& media, const DepthStatement& statement) {
    const fs::path file = find_sidecar(media).value_or(sidecar_of(media));
    std::error_code ignored;
    toml::table root;
    if (fs::exists(file, ignored)) root = parsed(content_of(file), shown(file));
    root.insert_or_assign("depth", parsed(toml_of(statement), "")["depth"]);
    std::ostringstream text;
    text << root << '\n';
    write_file(file, text.str());
}

std::string toml_of(const DepthStatement& said) {
    std::string toml = "[depth]\n";
    const auto line = [&toml](const char* name, const std::string& value) {
        toml += std::string(name) + " = " + value + "\n";
    };
    const auto word = [&line](const char* name, const auto& fact) {
        if (fact) line(name, '"' + std::string(name_of(*fact)) + '"');
    };
    word("near", said.near);
    word("unit", said.unit);
    if (said.scale) line("scale", number_text(*said.scale));
    if (said.range) line("range", list_of({said.range->near, said.range->far}));
    if (said.no_data) line("no-data", list_of(*said.no_data));
    word("packing", said.packing);
    word("code", said.code);
    word("geometry", said.geometry);
    if (said.intrinsics) line("intrinsics", '"' + text_of(*said.intrinsics) + '"');
    if (said.registration)
        line("registration", list_of({said.registration->right_px, said.registration->down_px,
                                      said.registration->scale}));
    if (said.cleaning) line("cleaning", text_of(*said.cleaning));
    if (said.finger_mm) line("finger", number_text(*said.finger_mm));
    word("times", said.times);
    if (said.time_offset_s) line("offset", number_text(*said.time_offset_s));
    if (said.frames_per_s) line("fps", number_text(*said.frames_per_s));
    return toml;
}

DepthStatement statement_in(const std::string& toml, const std::string& name) {
    DepthStatement said;
    const toml::table root = parsed(toml, name);
    const toml::table* const depth = root["depth"].as_table();
    if (depth == nullptr) return said;
    for (const auto& [key, node] : *depth) {
        const std::string lacking = take(plain_name(key.str()), node, said);
        if (lacking.empty()) continue;
        std::ostringstream text;
        text << name << ", line " << node.source().begin.line << ": " << key.str() << " " << lacking
             << "; correct or delete it";
        throw InputError(one_line(text.str()));  // a name may hold anything
    }
    return said;
}

std::optional<std::vector<double>> levels_in(const std::string& text) {
    auto levels = numbers_in(text, ',');
    return levels && levels->size() <= kMostNoData ? levels : std::nullopt;
}

std::optional<double> scale_in(const std::string& text) {
    const auto numbers = numbers_in(text, ',');
    return numbers ? scale_of(*numbers) : std::nullopt;
}

std::optional<DepthRange> range_in(const std::string& text) {
    const auto ends = numbers_in(text, ':');
    return ends ? range_of(*ends) : std::nullopt;
}

std::optional<Intrinsics> intrinsics_in(const std::string& text) {
    std::string_view number = text;
    bool is_angle = false;
    for (const std::string_view unit : {"deg", "\u00b0"}) {
        if (is_angle || !number.ends_with(unit)) continue;
        number.remove_suffix(unit.size());
        is_angle = true;
    }
    while (is_angle && number.ends_with(' ')) number.remove_suffix(1);
    const auto numbers = numbers_in(std::string(number), ',');
    if (!numbers || (is_angle && numbers->size() != 1)) return std::nullopt;
    return intrinsics_of(*numbers);
}

std::string text_of(const Intrinsics& said) {
    if (said.field_of_view_deg > 0.0) return number_text(said.field_of_view_deg) + "deg";
    return number_text(said.fx) + ',' + number_text(said.fy) + ',' + number_text(said.cx) + ',' +
           number_text(said.cy);
}

std::optional<double> offset_in(const std::string& text) {
    const auto numbers = numbers_in(text, ',');
    return numbers ? offset_of(*numbers) : std::nullopt;
}

std::optional<double> rate_in(const std::string& text) {
    const auto numbers = numbers_in(text, ',');
    return numbers ? rate_of(*numbers) : std::nullopt;
}

std::optional<Registration> registration_in(const std::string& text) {
    const auto numbers = numbers_in(text, ',');
    return numbers ? registration_of(*numbers) : std::nullopt;
}

}  // namespace dibhr
