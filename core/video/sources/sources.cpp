// Chooses tracks, halves, pictures or arrays to read, and which files belong together.
#include "core/video/sources/sources.hpp"

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/depth/byte_code.hpp"
#include "core/video/depth/colour_maps.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/level_code.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/bags/ros_bag.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/sources/coded_colours.hpp"
#include "core/video/sources/depth_finding.hpp"
#include "core/video/sources/layouts/layouts.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "core/video/sources/recorder_metadata.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

cv::Size picture_size(const KnownPlace& place) {
    const auto source = place.open(PictureRole::colour);
    return {source->facts().columns, source->facts().rows};
}

/// The stated code of the depth takes the place of the one that was found.
void state_code(PackedForm& form, const DepthStatement& statement) {
    const bool is_hue = statement.code == DepthCode::hue;
    if (!statement.code || (is_hue && form.hue)) return;
    form.hue = is_hue ? std::optional(HueCode{}) : std::nullopt;
    if (is_of_bytes(*statement.code)) form.bytes = *statement.code;
    form.coded = finding_on_code(*statement.code, true);
}

/// The packing in halves by the statement, a recorder's metadata or the name; else nothing.
std::optional<PackedForm> packed_form(const KnownPlace& place, const DepthStatement& statement) {
    std::optional<PackedForm> form;
    if (statement.packing && !is_of_halves(*statement.packing)) return form;
    if (place.is(PictureForm::video)) form = form_by_recorder(place.path, picture_size(place));
    const auto named = packing_by_name(place.path);
    if (!form && named && (named->names_depth || statement.packing))
        form = PackedForm{
            .packing = named->packing,
            .half_size = named->half_size,
            .finding = {{}, Evidence::name, kSurenessOfName, "the last words of its name"}};
    if (!form && statement.packing) {
        form.emplace();
        const std::vector<cv::Mat> first = colour_samples(place.path, 1);
        if (!first.empty()) form->gap_px = gap_between_halves(first.front(), *statement.packing);
    }
    if (!form) return form;
    form->packing = statement.packing.value_or(form->packing);
    state_code(*form, statement);
    return form;
}

/// What the pictures of a place look like; of a bag, which names its topics: nothing.
PictureGuess guess_of(const KnownPlace& place) {
    if (place.is(PictureForm::bag)) return {};
    return guess_kind(colour_samples(place.path, kKindSamples));
}

Sources halves_of(const KnownPlace& place, const PackedForm& form) {
    Sources halves = open_packed(place.path, form);
    halves.reader = &place.reader;
    return halves;
}

/// The halves, where the pictures look packed; else nothing.
std::optional<Sources> halves_as_guessed(const KnownPlace& place, const PictureGuess& guess,
                                         const DepthStatement& statement) {
    if (guess.kind != PictureKind::packed) return std::nullopt;
    PackedForm form = form_by_appearance(guess);
    state_code(form, statement);
    return halves_of(place, form);
}

/// The same, unless a packing is stated.
std::optional<Sources> halves_by_appearance(const KnownPlace& place,
                                            const DepthStatement& statement) {
    if (statement.packing) return std::nullopt;
    return halves_as_guessed(place, guess_of(place), statement);
}

/// Colour and depth of one place; no depth when it does not hold both.
Sources both_in(const KnownPlace& place, const DepthStatement& statement) {
    if (place.reader.open_both == nullptr) return {};
    Sources both = place.reader.open_both(place.path);
    both.reader = &place.reader;
    const bool may_be_coded = both.depth != nullptr &&
                              (place.is(PictureForm::video) || both.depth->facts().channels != 1);
    if (!may_be_coded) return both;
    both = with_decoded_colours(place, std::move(both), statement);
    // Of a film of two angles neither is depth.
    const bool is_of_angles = place.is(PictureForm::video) && !both.not_depth.empty();
    return is_of_angles ? Sources{} : std::move(both);
}

/// The depth of a place that holds no colour.
Sources depth_in(const KnownPlace& place, const DepthStatement& statement) {
    return with_decoded_colours(place, {place.open(PictureRole::depth), nullptr}, statement);
}

/// Whether its name surely says what its levels are, as of heights.
bool names_levels(const SourceFacts& facts) {
    const Findings named = findings_by_name(facts);
    return std::any_of(named.begin(), named.end(), [](const Finding& row) {
        return row.statement.unit && row.sureness >= kSurenessOfName;
    });
}

/// Whether a single place is depth: by its name, its levels or its appearance, which is a guess.
bool is_depth(const KnownPlace& place, const PictureGuess& guess) {
    if (named_depth(place.path) || place.is(PictureForm::bag)) return true;
    if (place.is(PictureForm::row)) {
        const PictureSet found = pictures_at(place.path);
        if (!found.depth.empty()) return true;
        if (found.unnamed.empty()) return false;
    }
    if (guess.kind != PictureKind::photo && guess.kind != PictureKind::packed) return true;
    const auto source = place.open(PictureRole::depth);
    const SourceFacts& facts = source->facts();
    if (facts.bits > 8) return facts.channels == 1 || level_code_in(source->samples(1));
    // Heights of a material look like any grey picture.
    if (place.is(PictureForm::video) || !named_other(place.path).empty() || !names_levels(facts))
        return false;
    const std::vector<cv::Mat> first = colour_samples(place.path, 1);
    return !first.empty() && !is_coloured(first.front());
}

constexpr const char* kAllTheSame = "; if it is depth all the same, add --depth-code grey";

/// " is named as a mask", by the name of a place or that of the folder of a picture that has only
/// a number; empty: the names say nothing against depth.
std::string no_depth_by_name(const fs::path& place) {
    const std::string own(named_no_depth(place));
    if (!own.empty()) return " is named as " + own;
    const std::string folder(folder_named_no_depth(place));
    return folder.empty() ? folder : " is in a folder named as " + folder;
}

/// Whether one of the two folders above is named depth or the like, and nothing else.
bool is_below_depth(const fs::path& place) {
    const fs::path folder = place.parent_path();
    return (named_depth(folder.filename()) && subject_of(folder.filename()).empty()) ||
           (named_depth(folder.parent_path().filename()) &&
            subject_of(folder.parent_path().filename()).empty());
}

/// " is a colour picture": what a place without depth is, after its name.
std::string content_of_colour(const KnownPlace& place, bool is_grey) {
    const std::string colour = is_grey ? "grey" : "colour";
    if (place.is(PictureForm::video)) return " is a " + colour + " video";
    return place.is(PictureForm::still) ? " is a " + colour + " picture"
                                        : " holds " + colour + " pictures";
}

/// What to do about a picture whose alpha is not the same everywhere, so that it may be its depth.
std::string advice_on_alpha(const KnownPlace& place) {
    if (!place.is(PictureForm::still)) return {};
    const std::vector<cv::Mat> pictures = place.open(PictureRole::depth)->samples(1);
    if (pictures.empty() || pictures.front().channels() != 4) return {};
    cv::Mat alpha;
    cv::extractChannel(pictures.front(), alpha, 3);
    double lowest = 0.0;
    double highest = 0.0;
    cv::minMaxIdx(alpha, &lowest, &highest);
    if (lowest == highest) return {};
    return filled_advice(
        ", take it from its alpha if that is depth (ffmpeg -i {} -vf alphaextract depth.png)",
        place.path);
}

[[noreturn]] void refuse_without_depth(const KnownPlace& place, const std::string& looked_for) {
    const fs::path& colour = place.path;
    constexpr const char* kOrEstimate = ", or let an estimator make it (dibhr help depth)";
    const std::vector<cv::Mat> seen = colour_samples(colour, kKindSamples);
    if (!seen.empty() && has_painted_half(seen.front()))
        throw InputError(shown(colour) +
                         " is a picture beside a painting of its depth, whose colours are no "
                         "numbers: save the depth itself, in grey or as an array (.npy), and give "
                         "it as the second file");
    if (const std::string named = no_depth_by_name(colour); !named.empty())
        throw DepthMissing(shown(colour) + named +
                           ", neither as colour nor as depth: give the depth file, and before it "
                           "the colour file" +
                           kAllTheSame);
    const bool is_grey = !seen.empty() && std::none_of(seen.begin(), seen.end(), is_coloured);
    if (is_grey && !named_colour(colour))
        throw DepthMissing(shown(colour) +
                           " is grey and does not look like depth: if it is depth, add "
                           "--depth-code grey; if it is a photo, it needs a depth file beside it: "
                           "give one as the second file" +
                           kOrEstimate);
    if (!seen.empty() && !is_grey && is_below_depth(colour))
        throw DepthMissing(refusal_of_colours(
            open_picture_source(colour, PictureRole::colour)->facts(), seen.front()));
    if (!seen.empty() && std::all_of(seen.begin(), seen.end(), is_colour_mapped))
        throw DepthMissing(shown(colour) +
                           " is painted in false colours (such as jet or viridis) and needs a "
                           "depth file beside it: give the numbers that it was painted from, as an "
                           "array (.npy) or in grey, as the second file");
    if (const std::string advice = advice_on_depth_within(colour); !advice.empty())
        throw DepthMissing(shown(colour) + advice);
    if (jpeg_has_gain_map(colour)) throw DepthMissing(shown(colour) + kGainMapAlone);
    throw DepthMissing(shown(colour) + content_of_colour(place, is_grey) +
                       " without depth and needs a depth file beside it: give one as the second "
                       "file" +
                       (looked_for.empty() ? "" : " (looked for " + looked_for + ")") +
                       advice_on_alpha(place) + ", name its halves if it holds both (--packing)" +
                       kOrEstimate);
}

cv::Mat grey_picture(const cv::Mat& picture) {
    cv::Mat grey;
    cv::cvtColor(grey_of(picture), grey, cv::COLOR_GRAY2BGR);
    return grey;
}

/// What a place that is given as the depth of a colour picture is instead, after its name; empty:
/// nothing says so.
std::string other_than_depth(const fs::path& place, Sources& sources) {
    const SourceFacts& facts = sources.depth->facts();
    if (named_depth(place) || has_decoded_levels(facts)) return {};
    if (!named_no_depth(place).empty()) return no_depth_by_name(place) + ", not as depth";
    const bool is_known = named_depth(place.parent_path().filename()) ||
                          sources.data_set.of(facts) || names_levels(facts);
    if (facts.bits > 8 || is_known) return {};
    const std::vector<cv::Mat> depth = sources.depth->samples(1);
    const std::vector<cv::Mat> colour = sources.colour->samples(1);
    if (depth.empty() || colour.empty()) return {};
    const cv::Mat seen = grey_picture(depth.front());
    const std::string named = no_depth_by_name(place);
    if (!named.empty() && !may_be_grey_depth(seen)) return named + ", and does not look like depth";
    if (is_black_and_white(seen))
        return " is black and white alone, as a mask is, and not as depth";
    if (is_photo_of_scene(colour.front(), seen))
        return " looks like a photograph of what the first file shows (a grey copy, the other "
               "picture of a stereo pair, infrared), not like its depth";
    return {};
}

/// Keeps a refusal where the depth that was given beside colour is something else, and no person
/// says what its levels are.
void inspect_second_place(const fs::path& place, const DepthStatement& statement,
                          Sources& sources) {
    const bool is_stated = statement.code || statement.near || statement.unit;
    if (is_stated || !sources.not_depth.empty()) return;
    const std::string what = other_than_depth(place, sources);
    if (!what.empty())
        sources.not_depth = shown(place) + what + ": give the file of the depth" + kAllTheSame;
}

bool is_row(const fs::path& place) {
    return names_pictures(place) && !is_ros_bag(place, head_of(place));
}

/// Opens colour and depth of two places, each a file, a folder, a list or a pattern.
Sources of_two_places(const fs::path& colour, const fs::path& depth,
                      const DepthStatement& statement) {
    Sources sources;
    if (is_row(colour) && is_row(depth)) {
        sources = with_decoded_colours(KnownPlace(depth), rows_of_two(colour, depth), statement);
    } else {
        // First, so that an error of the colour file is not reported as one of the depth.
        auto colour_source = open_picture_source(colour, PictureRole::colour);
        sources = depth_in(KnownPlace(depth), statement);
        sources.colour = std::move(colour_source);
    }
    if (colour != depth) inspect_second_place(depth, statement, sources);
    return sources;
}

/// The halves as the form states. Where nothing states how depth is coded, a half in colours is
/// looked at.
Sources open_halves(const KnownPlace& place, PackedForm form, const DepthStatement& statement) {
    Sources sources = halves_of(place, form);
    if (form.hue || statement.code) return sources;
    const ColoursOfDepth colours = colours_of_depth(place, sources, &form);
    if (colours.kind == PictureKind::grey_depth) return sources;
    if (colours.kind == PictureKind::hue_depth) {
        form.hue.emplace();
        form.coded = finding_on_code(DepthCode::hue, false);
    } else if (colours.kind == PictureKind::byte_depth) {
        form.bytes = colours.bytes;
        form.coded = finding_on_code(colours.bytes, false);
    } else {
        refuse_colours(place, &form, sources);
        return sources;
    }
    return halves_of(place, form);
}

/// Colour and depth of one place by its tracks, names or metadata, or by the statement; no depth
/// where these give none.
Sources both_as_stated(const KnownPlace& place, const DepthStatement& statement) {
    if (!statement.packing || !is_of_halves(*statement.packing)) {
        if (Sources both = both_in(place, statement); both.depth) return both;
    }
    if (place.is(PictureForm::bag)) return {};
    const auto form = packed_form(place, statement);
    return form ? open_halves(place, *form, statement) : Sources{};
}

/// Guesses the content of a place from its pictures: halves, depth alone, or colour alone.
Sources guessed_content(const KnownPlace& place, const DepthStatement& statement) {
    const PictureGuess guess = guess_of(place);
    if (!statement.packing) {
        if (auto halves = halves_as_guessed(place, guess, statement)) return std::move(*halves);
    }
    if (is_depth(place, guess) || statement.code) {
        Sources depth = depth_in(place, statement);
        // Bytes that carry as those of numbers, but are lost, are the colours of a photo.
        if (guess.kind != PictureKind::byte_depth || depth.not_depth.empty()) return depth;
    }
    return {nullptr, place.open(PictureRole::colour)};
}

/// The same place was given twice: it holds both, else its pictures are colour and depth at once.
Sources of_the_same_place(const KnownPlace& place, const DepthStatement& statement) {
    if (Sources both = both_as_stated(place, statement); both.depth) return both;
    auto halves = halves_by_appearance(place, statement);
    return halves ? std::move(*halves) : of_two_places(place.path, place.path, statement);
}

/// Throws InputError for an array that is by its name a mask, confidence, ..., unless a person says
/// what its levels are.
void require_no_other_content(const KnownPlace& place, const DepthStatement& statement) {
    const std::string_view other = named_other(place.path);
    if (!place.is(PictureForm::arrays) || other.empty() || statement.near || statement.unit) return;
    // First, as an array of another shape is refused with the step that mends it.
    const int channels = place.open(PictureRole::depth)->facts().channels;
    throw InputError(shown(place.path) + " is by its name " + std::string(other) +
                     " and no depth: give the depth that it belongs to" +
                     (channels > 1 ? "" : ", or add what its levels are (--near, --depth-unit)"));
}

/// One place was given: it holds both, or depth is beside it, or it is depth alone.
Sources of_one_place(const KnownPlace& place, const DepthStatement& statement) {
    if (Sources both = both_as_stated(place, statement); both.depth) return both;
    std::string looked_for;
    if (const auto depth = find_depth_beside(place.path, looked_for))
        return of_two_places(place.path, *depth, statement);
    require_no_other_content(place, statement);
    Sources sources = guessed_content(place, statement);
    if (!sources.depth) refuse_without_depth(place, looked_for);
    return sources;
}

}  // namespace

Sources find_sources(const fs::path& colour, const fs::path& depth,
                     const DepthStatement& statement) {
    set_up_libraries();
    const MediaPlaces places = places_for(colour, depth);
    Sources sources;
    if (places.depth.empty())
        sources = of_one_place(KnownPlace(places.colour), statement);
    else if (places.depth == places.colour)
        sources = of_the_same_place(KnownPlace(places.colour), statement);
    else
        sources = of_two_places(places.colour, places.depth, statement);
    add_clause(sources.notice, places.notice);
    return sources;
}

Sources find_depth(const fs::path& place, const DepthStatement& statement) {
    set_up_libraries();
    const fs::path found = depth_place_for(place);
    const KnownPlace depth(found);
    Sources sources = both_as_stated(depth, statement);
    if (!sources.depth) {
        require_no_other_content(depth, statement);
        auto halves = halves_by_appearance(depth, statement);
        sources = halves ? std::move(*halves) : depth_in(depth, statement);
    }
    sources.colour.reset();
    return sources;
}

Sources find_content(const fs::path& place, const DepthStatement& statement) {
    set_up_libraries();
    const MediaPlaces places = places_for(place, {});
    Sources sources;
    if (!places.depth.empty()) {
        sources = of_two_places(places.colour, places.depth, statement);
    } else {
        const KnownPlace only(places.colour);
        sources = both_as_stated(only, statement);
        if (!sources.depth) {
            require_no_other_content(only, statement);
            sources = guessed_content(only, statement);
        }
    }
    add_clause(sources.notice, places.notice);
    return sources;
}

}  // namespace dibhr
