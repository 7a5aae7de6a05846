// `dibhr info`: describes media and session files.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/commands/batch/session_batch.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/info_session.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/frames.hpp"
#include "core/session/session.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

/// The request of `dibhr info`.
struct InfoOptions {
    DepthRequest request{usual_depth_request()};
    bool json{false};
    bool why{false};           ///< prints all findings
    bool must_be_sure{false};  ///< --sure
};

void describe_partner(const fs::path& file) {
    std::string looked_for;
    const std::optional<fs::path> depth = find_depth_beside(file, looked_for);
    if (!looked_for.empty()) looked_for.insert(0, "; looked for ");
    print_fact("depth", depth ? depth->string() : "none found" + looked_for);
}

std::string form_of(const MediaDescription& media) {
    const bool is_colour = media.colour_columns > 0;
    const std::string& codec = is_colour ? media.colour_codec : media.depth_codec;
    return std::string(media.still  ? "image"
                       : media.live ? "live video"
                                    : "video") +
           (codec.empty() ? "" : ", " + codec);
}

std::string levels_text(const MediaDescription& media) {
    std::string used = std::to_string(media.levels_used) + " levels used";
    if (media.has_real_numbers()) return "real numbers, " + used;
    if (media.levels_used > 1 << media.depth_bits) used += ", some between whole numbers";
    return std::to_string(media.depth_bits) + " bits, " + used;
}

std::string list_text(const std::vector<std::string>& words) {
    return words.empty() ? "nothing" : listed(words);
}

/// Empty: colour needs no registration to the depth.
std::string registration_text(const MediaDescription& media) {
    const Registration& moved = media.meaning->registration.value;
    std::string text;
    if (!media.registered_by.empty()) text = "by the " + media.registered_by;
    if (moved == Registration{}) return text;
    return text + (text.empty() ? "" : ", then ") + short_text(moved.right_px) + " px right, " +
           short_text(moved.down_px) + " px down, " + short_text(moved.scale) + " times as large";
}

std::vector<std::string> step_names(const CleaningSteps& steps) {
    std::vector<std::string> names;
    visit_steps(steps, [&names](std::string_view name, bool step) {
        if (step) names.emplace_back(name);
    });
    return names;
}

std::string cleaning_text(const CleaningChoice& choice) {
    return choice.preset == CleaningPreset::own ? list_text(step_names(choice.own))
                                                : std::string(name_of(choice.preset));
}

/// A name, a number or numbers.
template <typename Fact>
Json json_of(const Fact& fact) {
    if constexpr (std::is_enum_v<Fact>)
        return name_of(fact);
    else
        return fact;
}
Json json_of(const DepthRange& range) {
    return {range.near, range.far};
}
Json json_of(const Intrinsics& camera) {
    return {camera.fx, camera.fy, camera.cx, camera.cy};
}
Json json_of(const Registration& registration) {
    return {registration.right_px, registration.down_px, registration.scale};
}

Json json_of(const CleaningChoice& choice) {
    if (choice.preset != CleaningPreset::own) return name_of(choice.preset);
    return step_names(choice.own);
}

/// The facts that it states.
Json json_of(const DepthStatement& statement) {
    Json facts = Json::object();
    visit_facts(statement, statement, [&facts](const char* name, const auto& value, const auto&) {
        if (value) facts[name] = json_of(*value);
    });
    return facts;
}

std::string fact_text(const Json& value) {
    constexpr int kDigits = 8;
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return short_text(value.get<double>(), kDigits);
    std::vector<std::string> parts;
    for (const Json& part : value) parts.push_back(fact_text(part));
    return parts.empty() ? "none" : listed(parts);
}

/// "millimetres", "a level is 0.2 mm", "disparities"; empty: neither is stated.
std::string values_text(const std::optional<DepthUnit>& unit, const std::optional<double>& scale) {
    const double one = scale.value_or(1.0);
    const std::string factor = short_text(one);
    if (!unit) return scale ? "scale " + factor : std::string();
    switch (*unit) {
        case DepthUnit::levels:
            return one == 1.0 ? "levels of no unit" : "levels of no unit x " + factor;
        case DepthUnit::disparity:
            return one == 1.0 ? "disparities" : "disparities, a level is " + factor;
        case DepthUnit::mm:
            return one == 1.0    ? "millimetres"
                   : one == 10.0 ? "centimetres"
                                 : "a level is " + factor + " mm";
        case DepthUnit::m:
            return one == 1.0 ? "metres" : "a level is " + factor + " m";
    }
    return {};
}

/// "near is bright, levels of no unit, no data is 0"; "nothing" for an empty statement.
std::string statement_text(DepthStatement statement) {
    std::vector<std::string> facts;
    if (statement.near) facts.push_back("near is " + std::string(name_of(*statement.near)));
    if (std::string values = values_text(statement.unit, statement.scale); !values.empty())
        facts.push_back(std::move(values));
    if (statement.no_data)
        facts.push_back(statement.no_data->empty() ? "all levels are data"
                                                   : "no data is " + fact_text(*statement.no_data));
    statement.near.reset();
    statement.unit.reset();
    statement.scale.reset();
    statement.no_data.reset();
    const Json others = json_of(statement);
    for (const auto& [name, value] : others.items()) {
        std::string words = name;
        std::ranges::replace(words, '_', ' ');
        facts.push_back(words + ' ' + fact_text(value));
    }
    return list_text(facts);
}

/// Never 0 or 100 % of what is not certain.
std::string percent_text(double probability) {
    const double percent = 100.0 * probability;
    const bool is_certain = probability <= 0.0 || probability >= 1.0;
    return number_text(is_certain ? percent : std::clamp(percent, 1.0, 99.0), 0) + " %";
}

/// How sure the meaning is, and what else it may be.
void print_sureness(const DepthConclusion& conclusion) {
    const std::string all = percent_text(conclusion.sure);
    const std::string near = percent_text(conclusion.near_sure);
    const std::string unit = percent_text(conclusion.unit_sure);
    print_fact("sure",
               all == near && all == unit ? all : all + " (near " + near + ", unit " + unit + ')');
    for (std::size_t k = 1; k < conclusion.alternatives.size(); ++k) {
        const DepthAlternative& other = conclusion.alternatives[k];
        print_fact("or", statement_text(other.statement) + ", " + percent_text(other.probability));
    }
    if (!conclusion.doubt.empty()) print_fact("or", "no depth: " + conclusion.doubt);
}

std::string says_text(const Finding& finding) {
    return finding.about.empty() ? statement_text(finding.statement) : finding.about;
}

/// Broken behind commas into lines of at most `width` letters, where the parts are not longer.
std::vector<std::string> in_lines(const std::string& text, std::size_t width) {
    std::vector<std::string> lines{""};
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t comma = std::min(text.find(", ", begin), text.size() - 1);
        const std::string part = text.substr(begin, comma + 1 - begin);
        std::string& line = lines.back();
        if (!line.empty() && line.size() + 1 + part.size() > width)
            lines.push_back(part);
        else
            line += (line.empty() ? "" : " ") + part;
        begin = std::min(comma + 2, text.size());
    }
    return lines;
}

/// The table: a row for each finding, then what is concluded.
void print_why(const MediaDescription& media) {
    constexpr std::size_t kMostWidth = 40;
    constexpr int kSureWidth = 5;
    constexpr int kFromWidth = 10;
    struct Row {
        std::vector<std::string> says;
        std::string sure, from, reason;
    };
    std::vector<Row> rows{{{"finding"}, "sure", "from", "because of"}};
    for (const Finding& finding : media.conclusion.findings)
        rows.push_back({in_lines(one_line(says_text(finding)), kMostWidth),
                        percent_text(finding.sureness), std::string(name_of(finding.evidence)),
                        one_line(finding.reason)});
    std::size_t width = 0;
    for (const Row& row : rows)
        for (const std::string& line : row.says) width = std::max(width, line.size());
    std::cout << '\n';
    for (const Row& row : rows) {
        std::cout << "  " << std::left << std::setw(static_cast<int>(width)) << row.says.front()
                  << "  " << std::right << std::setw(kSureWidth) << row.sure << "  " << std::left
                  << std::setw(kFromWidth) << row.from << "  " << row.reason << '\n';
        for (std::size_t k = 1; k < row.says.size(); ++k)
            std::cout << "    " << row.says[k] << '\n';
    }
    const DepthMeaning& meaning = *media.meaning;
    print_fact("so", statement_text({.near = meaning.near.value,
                                     .unit = meaning.unit.value,
                                     .scale = meaning.scale.value,
                                     .no_data = meaning.no_data.value}) +
                         ": " + percent_text(media.conclusion.sure));
    if (!media.timing.empty()) print_fact("so", "times: " + media.timing);
}

void print_depth(const MediaDescription& media) {
    print_fact("depth", size_text(media.depth_columns, media.depth_rows) + ", " +
                            media.depth_codec + ", " + levels_text(media));
    if (!media.meaning) return;
    const DepthMeaning& meaning = *media.meaning;
    print_fact("meaning", in_words(meaning));
    if (!meaning.found_in.empty()) print_fact("found in", meaning.found_in);
    print_fact("assumed", list_text(assumed_facts(meaning)));
    print_sureness(media.conclusion);
    print_fact("packing", name_of(meaning.packing.value));
    print_fact("code", name_of(meaning.code.value));
    if (const std::string colour = registration_text(media); !colour.empty())
        print_fact("registered", colour);
    if (meaning.cleaning.value != CleaningChoice{})
        print_fact("cleaning", cleaning_text(meaning.cleaning.value));
    if (meaning.finger_mm.value > 0.0)
        print_fact("finger", short_text(meaning.finger_mm.value) + " mm");
    print_fact("holes", number_text(100.0 * media.holes_share, 1) + " %");
}

/// Reports a doubt about it.
MediaDescription described(const fs::path& file, const fs::path& other,
                           const InfoOptions& options) {
    MediaDescription media;
    {
        const WorkingLine line("Reading " + one_line(file.string()));
        media = describe_media(file, options.request, other);
    }
    report_doubt(media, options.must_be_sure);
    return media;
}

void describe_pictures(const fs::path& file, const fs::path& other, const InfoOptions& options) {
    const MediaDescription media = described(file, other, options);
    const bool is_colour = media.colour_columns > 0;
    const bool has_depth = media.depth_columns > 0;

    std::cout << one_line(file.string()) << '\n';
    print_fact("kind", media.still ? "image" : media.live ? "live video" : "video");
    print_fact("size", is_colour ? size_text(media.colour_columns, media.colour_rows)
                                 : size_text(media.depth_columns, media.depth_rows));
    const std::string& codec = is_colour ? media.colour_codec : media.depth_codec;
    if (!codec.empty()) print_fact("codec", codec);
    if (has_depth) print_depth(media);
    if (media.live) {
        print_fact("rate", number_text(media.frames_per_s, 2) + " frames/s, live");
    } else if (!media.still) {
        print_fact("frames", (media.frames_exact ? "" : "about ") + std::to_string(media.frames));
        print_fact("duration", number_text(media.duration_s, 3) + " s");
        print_fact("rate", number_text(media.frames_per_s, 2) + " frames/s");
        print_fact("times", media.timing);
    }
    if (!media.notice.empty()) print_fact("notice", media.notice);
    if (is_colour && !has_depth) describe_partner(file);
    if (options.why && media.meaning) print_why(media);
}

/// Each fact and its origin; an unknown fact is null.
void add_meaning(Json& json, const std::optional<DepthMeaning>& meaning) {
    const DepthStatement known = meaning ? meaning->statement() : DepthStatement{};
    const DepthMeaning facts = meaning.value_or(DepthMeaning{});
    Json origins = Json::object();
    visit_facts(known, facts, [&](const char* name, const auto& value, const auto& fact) {
        json[name] = value ? json_of(*value) : Json();
        if (value) origins[name] = name_of(fact.origin);
    });
    json["found_in"] = facts.found_in;
    json["assumed"] = meaning ? assumed_facts(facts) : std::vector<std::string>{};
    json["origin"] = origins;
}

/// How sure the meaning is, what else it may be, and all findings where they are asked for.
void add_conclusion(Json& json, const MediaDescription& media, bool why) {
    const DepthConclusion& conclusion = media.conclusion;
    json["sure"] = media.meaning ? Json(conclusion.sure) : Json();
    json["alternatives"] =
        json_list(conclusion.alternatives, [](const DepthAlternative& alternative) {
            Json facts = json_of(alternative.statement);
            facts["probability"] = alternative.probability;
            return facts;
        });
    if (!why) return;
    json["findings"] = json_list(conclusion.findings, [](const Finding& finding) {
        return Json{{"about", finding.about},
                    {"states", json_of(finding.statement)},
                    {"sureness", finding.sureness},
                    {"evidence", name_of(finding.evidence)},
                    {"reason", finding.reason}};
    });
}

/// Unknown values are null.
Json json_of(const fs::path& file, const MediaDescription& media, bool why) {
    const bool has_colour = media.colour_columns > 0;
    const bool has_depth = media.depth_columns > 0;
    const auto known = [](bool is_known, auto value) { return is_known ? Json(value) : Json(); };
    Json json{{"path", file.string()},
              {"form", form_of(media)},
              {"columns", known(has_depth, media.depth_columns)},
              {"rows", known(has_depth, media.depth_rows)},
              {"colour_columns", known(has_colour, media.colour_columns)},
              {"colour_rows", known(has_colour, media.colour_rows)},
              {"bits", known(has_depth, media.depth_bits)},
              {"levels_used", known(has_depth, media.levels_used)},
              {"holes_share", known(has_depth, media.holes_share)},
              {"frames", known(!media.live, media.frames)},
              {"duration_s", known(!media.live, media.duration_s)}};
    add_meaning(json, media.meaning);
    add_conclusion(json, media, why);
    json["registered_by"] = media.registered_by;
    json["timing"] =
        media.timing.empty() ? Json() : Json{{"from", media.times_from}, {"text", media.timing}};
    json["notice"] = media.notice;
    return json;
}

void describe(const fs::path& file, const fs::path& other, const InfoOptions& options) {
    if (is_session_file(file)) {
        Session session(file);
        session.rescue_if_damaged();
        print_warning(session.warning());
        describe_session(session, options.json);
    } else if (options.json) {
        const MediaDescription media = described(file, other, options);
        std::cout << json_line(json_of(file, media, options.why)) << '\n';
    } else {
        describe_pictures(file, other, options);
    }
}

/// The other one of two places that may be colour and depth; empty: none.
fs::path other_of(const fs::path& file, const std::vector<std::string>& files) {
    if (files.size() != 2) return {};
    const fs::path other = file == files.front() ? files.back() : files.front();
    return other == file || is_session_file(other) ? fs::path() : other;
}

/// 1 when any of them cannot be read.
int describe_all(const std::vector<std::string>& files, const InfoOptions& options) {
    int exit_code = 0;
    for (const fs::path file : files) {
        try {
            describe(file, other_of(file, files), options);
        } catch (const Error& error) {
            std::cout.flush();
            print_error_line(error.what());
            exit_code = 1;
        }
    }
    return exit_code;
}

bool is_folder_of_sessions(const fs::path& place) {
    std::error_code missing;
    return fs::is_directory(place, missing) && holds_sought(place, sought_sessions());
}

}  // namespace

int run_info(CLI::App& app, const Arguments& arguments) {
    std::vector<std::string> files;
    app.add_option("FILE", files,
                   "Videos, images, session files and folders of them, cameras and streams")
        ->type_name("")
        ->required();
    InfoOptions options;
    app.add_flag("--json", options.json,
                 "One JSON object for each file, on a line of its own; null: not known");
    app.add_flag("--why", options.why,
                 "Also all that was found out about the depth: what each finding states, how sure "
                 "it is, and where it comes from");
    add_depth_options(app, options.request.command_line);
    add_sure_option(app, options.must_be_sure);
    BatchOptions batch;
    add_batch_options(app, batch,
                      "Folder that keeps what each session holds, and info.csv, a row for each");
    app.footer(
        "Of two files, one of colour and one of depth, the depth is described as they open.\n"
        "Examples:\n"
        "  dibhr info color.mp4 depth.mp4 mine.dibhr\n"
        "  dibhr info depth.png --why\n"
        "  dibhr info scan/ --json\n"
        "  dibhr info recordings --out described");
    if (!parse(app, arguments)) return 0;
    const bool kept = batch.is_batch();
    const bool folders = std::ranges::any_of(files, is_folder_of_sessions);
    if (!kept && !folders) return describe_all(files, options);
    std::vector<std::string> media;
    for (const std::string& file : files) {
        const bool session = is_folder_of_sessions(file) || is_session_file(file);
        if (session)
            batch.given.emplace_back(file);
        else
            media.push_back(file);
    }
    const int of_media = describe_all(media, options);
    if (batch.given.empty()) return of_media;
    const int of_sessions = run_batch(
        app,
        {.command = "info",
         .title = "Describing",
         .table = !options.json,
         .work = [json = options.json](
                     const GivenFile& file, const fs::path& /*folder*/,
                     const WorkProgress& /*progress*/) { return describe_in_batch(file, json); }},
        batch);
    return std::max(of_media, of_sessions);
}

}  // namespace dibhr
