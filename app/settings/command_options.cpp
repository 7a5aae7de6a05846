// Command line options that several commands share, made from the table of parameters.
#include "app/settings/command_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

#include "app/settings/settings.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/sidecar.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Placeholder of the option in the help: "N s/m" -> "N_S_PER_M", a ratio -> "MU".
std::string placeholder_of(const TouchNumber& option) {
    if (option.unit.empty()) return "MU";
    std::string name;
    for (const char c : option.unit) {
        if (c == '/') {
            name += "_PER_";
        } else if (c == ' ') {
            name += '_';
        } else {
            name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
    }
    return name;
}

template <typename Values>
std::vector<std::string> names_of(const Values& values) {
    std::vector<std::string> names;
    for (const auto value : values) names.emplace_back(name_of(value));
    return names;
}

[[noreturn]] void refuse_word(const std::string& option, const std::string& word,
                              const std::vector<std::string>& names) {
    throw CLI::ValidationError(option, "'" + word + "' " + none_of(word, names));
}

/// Throws CLI::ValidationError.
template <typename Values>
auto parse_value(const std::string& name, const Values& values, const char* option) {
    for (const auto value : values) {
        if (name == name_of(value)) return value;
    }
    refuse_word(option, name, names_of(values));
}

constexpr std::string_view kAutomatic = "auto";

/// --NAME: stores read(text) in `fact`; auto leaves `fact` empty.
template <typename Fact, typename Read>
void add_fact_option(CLI::App& app, const char* name, std::optional<Fact>& fact, const Read& read,
                     const char* type, const std::string& problem, const std::string& help) {
    app.add_option_function<std::string>(
           name,
           [&fact, read, name, problem](const std::string& text) {
               fact.reset();
               if (text == kAutomatic) return;
               fact = read(text);
               if (!fact) throw CLI::ValidationError(name, "'" + text + "' " + problem);
           },
           help)
        ->type_name(type)
        ->default_str(std::string(kAutomatic));
}

/// --NAME with one of some words, or auto.
template <typename Values>
void add_word_option(CLI::App& app, const char* name, const Values& values,
                     std::optional<typename Values::value_type>& fact, const std::string& help) {
    const auto read = [&values](const std::string& word) {
        const auto found =
            std::ranges::find(values, word, [](auto value) { return name_of(value); });
        return found == values.end() ? std::nullopt : std::optional(*found);
    };
    add_fact_option(app, name, fact, read, "WORD", "is none of " + listed(names_of(values)),
                    help + ": auto, " + listed(names_of(values)));
}

std::string range_of(double lowest, double highest) {
    return short_text(lowest, 7) + " to " + short_text(highest, 7);  // 1000000, not 1e+06
}

/// Throws CLI::ValidationError that names `option`.
double parse_number(const std::string& option, const std::string& text, double lowest,
                    double highest) {
    const auto value = number_of_text(text);
    if (!value) throw CLI::ValidationError(option, "'" + text + "' is not a number");
    if (*value < lowest || *value > highest) {
        throw CLI::ValidationError(option, text + " is not in " + range_of(lowest, highest));
    }
    return *value;
}

/// Parameters of the surface: its shape, texture and pixel pitch.
bool shapes_surface(TouchTopic topic) {
    return topic == TouchTopic::shape || topic == TouchTopic::texture;
}

std::function<void(double)> number_setter(const TouchNumber& option, GivenParameters& given) {
    return [&option, &given](double value) { given.numbers.emplace_back(&option, value); };
}

/// The flag for auto of a number that can be fitted to the media; null: a number that cannot.
bool* fit_flag_of(const TouchNumber& option, GivenParameters& given) {
    TouchParameters any;
    if (&option == &number_of(any.shape.relief_px, any)) return &given.fit_relief;
    if (&option == &number_of(any.coupling.pixel_pitch_mm, any)) return &given.fit_pitch;
    return nullptr;
}

/// A number, or auto.
void add_fitted_option(CLI::App& app, const TouchNumber& option, GivenParameters& given,
                       bool& fits) {
    const std::string name = "--" + std::string(option.name);
    app.add_option_function<std::string>(
           name,
           [&option, &given, &fits, name](const std::string& text) {
               fits = text == kAutomatic;
               if (!fits)
                   number_setter(option,
                                 given)(parse_number(name, text, option.lowest, option.highest));
           },
           std::string(option.help) + ", " + range_of(option.lowest, option.highest) +
               "; auto: as fits the picture")
        ->type_name(placeholder_of(option) + "|auto")
        ->default_str(std::string(kAutomatic));
}

void add_number_of_touch(CLI::App& app, const TouchNumber& option, GivenParameters& given) {
    if (bool* const fits = fit_flag_of(option, given))
        add_fitted_option(app, option, given, *fits);
    else
        add_touch_option(app, option, std::string(option.help), number_setter(option, given));
}

void add_choice_of_touch(CLI::App& app, const TouchChoice& choice, GivenParameters& given,
                         const char* default_text) {
    const std::string name = "--" + std::string(choice.name);
    if (app.get_option_no_throw(name) != nullptr) return;  // it takes several values
    add_choice_option(
        app, name, choice.names(), std::string(choice.help) + ": " + listed(choice.names()),
        [&choice, &given](const std::string& word) { given.words.emplace_back(&choice, word); })
        ->type_name("NAME")
        ->default_str(default_text != nullptr ? default_text : std::string(choice.standard()));
}

void add_switch_of_touch(CLI::App& app, const TouchSwitch& entry, GivenParameters& given,
                         const char* default_text) {
    add_on_off_option(app, "--" + std::string(entry.name), std::string(entry.help),
                      [&entry, &given](bool on) { given.switches.emplace_back(&entry, on); })
        ->default_str(default_text != nullptr ? default_text
                      : entry.standard()      ? "on"
                                              : "off");
}

void add_entries_of_touch(CLI::App& app, GivenParameters& given, const char* default_text,
                          bool (*wanted)(TouchTopic)) {
    for (const TouchChoice& choice : touch_choices())
        if (wanted(choice.topic)) add_choice_of_touch(app, choice, given, default_text);
    for (const TouchSwitch& entry : touch_switches())
        if (wanted(entry.topic)) add_switch_of_touch(app, entry, given, default_text);
    for (const TouchNumber& option : touch_numbers())
        if (wanted(option.topic)) add_number_of_touch(app, option, given);
}

void add_surface_options(CLI::App& app, TouchRequest& request) {
    app.add_option_function<std::string>(
           "--material",
           [&request](const std::string& name) { request.given.material = material_named(name); },
           "What the surface is made of: " + listed(names_of_materials()) +
               ", or a .toml file; a number that has its own option wins over the material")
        ->type_name("NAME");
    app.add_option("--bump", request.given.bump,
                   "Bump map laid over the surface: an 8- or 16-bit image")
        ->type_name("IMAGE");
    add_on_off_option(app, "--maps",
                      "off: without the touch maps beside the recording, NAME_stiffness.png, "
                      "NAME_friction.png and NAME_height.png",
                      request.maps)
        ->default_str("on");
    app.add_flag(
        "--raw-depth", request.raw_depth,
        "Depth as it is in the file: nothing cleaned or found out, relief 255 px and pitch "
        "101.6/720 mm unless given");
    app.add_option_function<std::string>(
           "--cleaning",
           [&request](const std::string& name) {
               request.preset = named<CleaningPreset>(name);
               if (!request.preset || request.preset == CleaningPreset::own)
                   refuse_word("--cleaning", name, {"auto", "raw", "gentle", "sensor"});
               if (request.preset == CleaningPreset::automatic)
                   request.depth.cleaning.emplace();  // overrides a sidecar
           },
           "What is done to the depth: raw (nothing), gentle (holes, spikes, 8-bit steps, teeth of "
           "outlines), sensor (also silhouettes and noise), auto (what buzzes least on the clip)")
        ->type_name("NAME")
        ->default_str("auto");
    add_number_option(app, "--finger", 0.0, kThickestFinger_mm,
                      "Radius of the fingertip [mm]; 0: the paper's point",
                      [&request](double radius_mm) {
                          request.finger_mm = radius_mm;
                          if (!(radius_mm > 0.0)) request.depth.finger_mm = radius_mm;
                      })
        ->type_name("MM")
        ->default_str("0");
    add_depth_options(app, request.depth);
}

}  // namespace

Fingertip fingertip_of(double radius_mm, const TouchParameters& parameters) {
    return {radius_mm / parameters.coupling.pixel_pitch_mm, parameters.shape.relief_px};
}

bool TouchRequest::changes_surface() const {
    return !given.bump_file().empty() || raw_depth || preset || finger_mm || in_betweens ||
           !uses_maps();
}

std::shared_ptr<const TouchMaps> TouchRequest::read_maps(const MediaDescription& media) const {
    if (!uses_maps()) return nullptr;
    return read_touch_maps(media.depth_path, media.depth_columns, media.depth_rows);
}

CleaningOptions TouchRequest::cleaning(const TouchParameters& parameters,
                                       const MediaDescription& media) const {
    CleaningOptions options{.preset = preset.value_or(CleaningPreset::automatic)};
    if (raw_depth) options.preset = CleaningPreset::raw;
    options = cleaning_on(media, options);
    const double radius_mm = finger_mm_on(media, finger_mm.value_or(0.0));
    if (radius_mm > 0.0) options.finger = fingertip_of(radius_mm, parameters);
    return options;
}

const double* GivenParameters::value_of(const TouchNumber& number) const {
    const auto last = std::find_if(numbers.rbegin(), numbers.rend(),
                                   [&number](const auto& given) { return given.first == &number; });
    return last == numbers.rend() ? nullptr : &last->second;
}

fs::path GivenParameters::bump_file() const {
    if (!bump.empty() || !material) return bump;
    return material->map;
}

std::shared_ptr<const BumpMap> GivenParameters::read_bumps() const {
    if (!bump.empty()) return std::make_shared<const BumpMap>(read_bump_map(bump));
    return material ? material->bumps : nullptr;
}

void ensure_roughness(TouchParameters& parameters) {
    constexpr double kFelt_px = 4.0;  // half a millimetre at the paper's pitch
    double& roughness_px = parameters.shape.roughness_px;
    if (!(roughness_px > 0.0)) roughness_px = kFelt_px;
}

bool GivenParameters::gives_damping() const {
    return std::ranges::any_of(touch_numbers(), [this](const TouchNumber& number) {
        return number.topic == TouchTopic::damper && value_of(number) != nullptr;
    });
}

void GivenParameters::apply_texture(TouchParameters& parameters) const {
    if (material) lay_texture(*material, parameters);
    const auto* const roughness = value_of(number_of(parameters.shape.roughness_px, parameters));
    const auto* const size = value_of(number_of(parameters.shape.bump_size_px, parameters));
    if (roughness != nullptr) parameters.shape.roughness_px = *roughness;
    if (size != nullptr) parameters.shape.bump_size_px = *size;
    if (roughness == nullptr && !bump_file().empty()) ensure_roughness(parameters);
}

void GivenParameters::apply(TouchParameters& parameters) const {
    for (const auto& [choice, word] : words) static_cast<void>(choice->choose(word, parameters));
    for (const auto& [entry, on] : switches) entry->in(parameters) = on;
    if (material) apply_material(*material, parameters);
    if (friction) parameters.friction = {*friction, *friction};
    for (const auto& [option, value] : numbers) option->in(parameters) = value;
    apply_texture(parameters);
    const double* const dynamic =
        value_of(number_of(parameters.friction.dynamic_coefficient, parameters));
    if (dynamic != nullptr && *dynamic > parameters.friction.static_coefficient) {
        throw UsageError("--dynamic-friction " + short_text(*dynamic) +
                         " is above the static friction " +
                         short_text(parameters.friction.static_coefficient) +
                         ": give --static-friction of at least as much, or --friction for both");
    }
    keep_in_range(parameters);
}

void GivenParameters::fit(const MediaDescription& media, bool raw,
                          TouchParameters& parameters) const {
    const auto is_free = [&](const double& number, bool as_auto) {
        return as_auto || (!raw && value_of(number_of(number, parameters)) == nullptr);
    };
    const Fit fit = fit_of(media);
    if (is_free(parameters.shape.relief_px, fit_relief)) parameters.shape.relief_px = fit.relief_px;
    if (is_free(parameters.coupling.pixel_pitch_mm, fit_pitch))
        parameters.coupling.pixel_pitch_mm = fit.pixel_pitch_mm;
    if (material) apply_texture(parameters);
    keep_in_range(parameters);
}

DepthRequest TouchRequest::depth_request() const {
    DepthRequest request = raw_depth ? DepthRequest{} : usual_depth_request();
    request.command_line = depth;
    request.decoder = decoder;
    if (raw_depth) {  // raw depth is never cleaned
        request.command_line.cleaning.reset();
        request.command_line.finger_mm.reset();
    }
    return request;
}

std::string roughness_warning(const GivenParameters& given, bool has_bump) {
    TouchParameters any;
    const double* const roughness = given.value_of(number_of(any.shape.roughness_px, any));
    if (has_bump || roughness == nullptr || *roughness == 0.0) return {};
    return "--roughness changes nothing without a bump map; give one with --bump IMAGE, or a "
           "--material";
}

CLI::Option* add_number_option(CLI::App& app, const std::string& name, double lowest,
                               double highest, const std::string& help,
                               const std::function<void(double)>& take) {
    const std::string option = name.substr(0, name.find(','));
    return app.add_option_function<std::string>(
        name, [=](const std::string& text) { take(parse_number(option, text, lowest, highest)); },
        help + ", " + range_of(lowest, highest));
}

CLI::Option* add_touch_option(CLI::App& app, const TouchNumber& number, const std::string& help,
                              const std::function<void(double)>& take) {
    return add_number_option(app, "--" + std::string(number.name), number.lowest, number.highest,
                             help, take)
        ->type_name(placeholder_of(number))
        ->default_str(short_text(number.standard()));
}

void add_algorithms_option(CLI::App& app, std::vector<Algorithm>& algorithms) {
    app.add_option_function<std::vector<std::string>>(
           "--algorithm",
           [&algorithms](const std::vector<std::string>& names) {
               for (const std::string& name : names)
                   algorithms.push_back(parse_value(name, all_algorithms(), "--algorithm"));
           },
           "How the proxy follows the goal, once or several times: " +
               listed(names_of(all_algorithms())))
        ->type_name("NAME")
        ->allow_extra_args(false);
}

CLI::Option* add_plot_format_option(CLI::App& app, std::vector<PlotFormat>& formats) {
    return app
        .add_option_function<std::vector<std::string>>(
            "--plot-format",
            [&formats](const std::vector<std::string>& names) {
                formats.clear();
                for (const std::string& name : names) {
                    formats.push_back(parse_value(name, kPlotFormats, "--plot-format"));
                }
            },
            "How the pictures are written, one or several with commas: " +
                listed(names_of(kPlotFormats)) + "; SVG and PDF are for papers")
        ->type_name("FORMAT")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->default_str("png");
}

CLI::Option* add_on_off_option(CLI::App& app, const std::string& name, const std::string& help,
                               const std::function<void(bool)>& take) {
    const auto check = [name, take](const std::string& word) {
        if (word != "on" && word != "off")
            throw CLI::ValidationError(name, "'" + word + "' is neither on nor off");
        take(word == "on");
    };
    return app.add_option_function<std::string>(name, check, help)->type_name("on|off");
}

CLI::Option* add_on_off_option(CLI::App& app, const std::string& name, const std::string& help,
                               std::optional<bool>& on) {
    return add_on_off_option(app, name, help, [&on](bool is_on) { on = is_on; });
}

CLI::Option* add_choice_option(CLI::App& app, const std::string& name,
                               const std::vector<std::string>& names, const std::string& help,
                               const std::function<void(const std::string&)>& take) {
    const auto check = [name, names, take](const std::string& word) {
        if (std::ranges::find(names, word) == names.end()) refuse_word(name, word, names);
        take(word);
    };
    return app.add_option_function<std::string>(name, check, help)
        ->type_name(CLI::detail::join(names, "|"))
        ->default_str(names.front());
}

void add_decoder_option(CLI::App& app, Decoder& decoder) {
    add_words_option<Decoder>(app, "--decoder",
                              "What decodes videos: auto (a device of this machine that gives the "
                              "same pictures), software",
                              [&decoder](Decoder chosen) { decoder = chosen; });
}

void add_in_betweens_option(CLI::App& app, TouchRequest& touch) {
    add_words_option<InBetweens>(app, "--in-betweens",
                                 "on: between two frames, moving things are on their way instead "
                                 "of fading; auto: only with --carry on",
                                 [&touch](InBetweens moved) { touch.in_betweens = moved; });
}

void add_level_options(CLI::App& app, DepthStatement& depth) {
    add_word_option(app, "--near", kNearLevels, depth.near, "Which levels are near");
    add_word_option(app, "--depth-unit", kDepthUnits, depth.unit,
                    "Unit of a level times the scale");
    add_fact_option(app, "--depth-scale", depth.scale, scale_in, "NUMBER",
                    "is not a number above 0",
                    "One level in that unit (TUM: --depth-unit m --depth-scale 0.0002)");
    add_fact_option(app, "--depth-range", depth.range, range_in, "NEAR:FAR",
                    "is not two numbers that differ, NEAR:FAR",
                    "The nearest and the farthest, in that unit; auto: as far as most of the clip "
                    "reaches");
    add_fact_option(app, "--no-data", depth.no_data, levels_in, "LEVELS",
                    "is not a list of up to 64 levels like 0,65535",
                    "Levels that stand for missing data");
}

void add_depth_options(CLI::App& app, DepthStatement& depth) {
    add_level_options(app, depth);
    add_word_option(app, "--packing", kDepthPackings, depth.packing,
                    "How colour and depth lie in the picture, colour first");
    add_word_option(app, "--depth-code", kDepthCodes, depth.code, "How a picture holds depth");
    add_word_option(app, "--geometry", kGeometries, depth.geometry,
                    "relief: the picture plane plus elevation; true: the shape in mm");
    add_fact_option(app, "--intrinsics", depth.intrinsics, intrinsics_in, "FX,FY,CX,CY|DEG",
                    "is neither FX,FY,CX,CY with focal lengths of 0.001 or more nor a field of "
                    "view like 60deg",
                    "Of the camera, in depth pixels; or its horizontal field of view, as in "
                    "60deg");
    add_fact_option(app, "--registration", depth.registration, registration_in, "RIGHT,DOWN,SCALE",
                    "is not RIGHT,DOWN,SCALE in depth pixels, the scale 0.01 to 100",
                    "How the colour lies over the depth: moved by RIGHT and DOWN depth pixels, and "
                    "SCALE times as large");
    add_word_option(app, "--depth-times", kDepthTimes, depth.times,
                    "When pictures without times are shown: 30 a second, by stamps in their names "
                    "or beside them, or with the frames of the other source");
    add_fact_option(app, "--depth-offset", depth.time_offset_s, offset_in, "SECONDS",
                    "is not a number of seconds, at most a day",
                    "How much later the depth is than its times say");
    add_fact_option(app, "--depth-fps", depth.frames_per_s, rate_in, "RATE",
                    "is not a rate of 0.001 to 10000 frames a second",
                    "Frames of depth a second, instead of what its source says");
}

void add_sure_option(CLI::App& app, bool& sure) {
    app.add_flag("--sure", sure,
                 "Fails where the meaning of the depth is likely but not sure; without this option "
                 "one line on stderr says so, where no window asks");
}

void add_shape_options(CLI::App& app, TouchRequest& request) {
    add_entries_of_touch(app, request.given, nullptr, &shapes_surface);
    add_surface_options(app, request);
}

void add_touch_options(CLI::App& app, TouchRequest& request, const char* default_text) {
    // The range is that of the two coefficients.
    TouchParameters any;
    const TouchNumber& coefficient = number_of(any.friction.static_coefficient, any);
    add_number_option(
        app, "--friction", coefficient.lowest, coefficient.highest,
        "Both coefficients of friction; --static-friction and --dynamic-friction win over it",
        [&request](double mu) { request.given.friction = mu; })
        ->type_name("MU");
    add_entries_of_touch(app, request.given, default_text, [](TouchTopic) { return true; });
    add_surface_options(app, request);
}

}  // namespace dibhr
