// Chooses tracks, halves, pictures or arrays to read, and which files belong together.
#include "core/video/sources/sources.hpp"

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/formats/ros_bag.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/sources/layouts.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "core/video/sources/recorder_metadata.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kKindSamples = 6;  ///< pictures used to guess their kind

/// A place and its reader.
struct Place {
    explicit Place(const fs::path& named) : path(named), reader(reader_of(named)) {}

    [[nodiscard]] bool is(PictureForm form) const { return reader.form == form; }

    const fs::path& path;
    const Reader& reader;
};

cv::Size picture_size(const fs::path& place) {
    const auto source = open_picture_source(place, PictureRole::colour);
    return {source->facts().columns, source->facts().rows};
}

/// Opens a place as colour pictures; of a video that track.
std::unique_ptr<PictureSource> open_as_colour(const fs::path& place, int track = 0) {
    if (track > 0) return std::make_unique<VideoFile>(place, PictureRole::colour, track);
    return open_picture_source(place, PictureRole::colour);
}

/// Sample pictures of a place as colour; none of depth in real numbers, which has no colours.
std::vector<cv::Mat> colour_samples(const fs::path& place, int most, int track = 0) {
    try {
        return open_as_colour(place, track)->samples(most);
    } catch (const InputError&) {
        return {};  // depth in a form without colours
    }
}

/// The packing in halves by the statement, a recorder's metadata or the name; else nothing.
std::optional<PackedForm> packed_form(const Place& place, const DepthStatement& statement) {
    std::optional<PackedForm> form;
    if (statement.packing && !is_of_halves(*statement.packing)) return form;
    if (place.is(PictureForm::video)) form = form_by_recorder(place.path, picture_size(place.path));
    const auto named = packing_by_name(place.path);
    if (!form && named && (named->names_depth || statement.packing))
        form = PackedForm{
            .packing = named->packing, .half_size = named->half_size, .known_from = "its name"};
    if (!statement.packing) return form;
    if (!form) {
        form.emplace();
        const std::vector<cv::Mat> first = colour_samples(place.path, 1);
        if (!first.empty()) form->gap_px = gap_between_halves(first.front(), *statement.packing);
    }
    form->packing = *statement.packing;
    if (statement.code == DepthCode::hue && !form->hue) form->hue.emplace();
    if (statement.code == DepthCode::grey) form->hue.reset();
    return form;
}

/// The halves, where the pictures look packed; else nothing.
std::optional<Sources> halves_by_appearance(const fs::path& place, const PictureGuess& guess) {
    if (guess.kind != PictureKind::packed) return std::nullopt;
    PackedForm form{.packing = guess.packing, .gap_px = guess.gap_px, .known_from = "its pictures"};
    if (guess.code == DepthCode::hue) form.hue.emplace();
    Sources sources = open_packed(place, form);
    sources.assumed = std::exchange(sources.found, {});
    sources.by_appearance = true;
    return sources;
}

/// Whether the first picture has colours, so that more pictures are worth sampling.
bool begins_in_colours(const fs::path& place, int track) {
    constexpr double kMostColoured = 0.01;  // share of pixels that compression colours
    const std::vector<cv::Mat> first = colour_samples(place, 1, track);
    return !first.empty() && picture_statistics(first.front()).coloured > kMostColoured;
}

/// Decodes depth coded as colours: as the statement says, else as the pictures look.
Sources decoded(const Place& place, Sources sources, const DepthStatement& statement) {
    const int track = sources.depth_track;
    const bool may_be_coded = statement.code != DepthCode::hue &&
                              sources.depth->facts().channels != 1 &&
                              (place.is(PictureForm::video) || place.is(PictureForm::still)) &&
                              begins_in_colours(place.path, track);
    PictureKind kind = PictureKind::grey_depth;
    if (may_be_coded) kind = guess_kind(colour_samples(place.path, kKindSamples, track)).kind;
    if (statement.code && kind == PictureKind::hue_depth) kind = PictureKind::grey_depth;
    sources.by_appearance = kind == PictureKind::hue_depth || kind == PictureKind::ramp_depth;
    const bool is_hue = statement.code == DepthCode::hue || kind == PictureKind::hue_depth;
    if (is_hue) {
        sources.depth = hue_decoded(open_as_colour(place.path, track), HueCode{}, "its hues");
        sources.assumed.code = DepthCode::hue;
    } else if (kind == PictureKind::ramp_depth) {
        sources.depth = ramp_decoded(open_as_colour(place.path, track), "its colours");
    }
    return sources;
}

/// Colour and depth of one place; no depth when it does not hold both.
Sources both_in(const Place& place, const DepthStatement& statement) {
    if (place.reader.open_both == nullptr) return {};
    Sources both = place.reader.open_both(place.path);
    if (both.depth == nullptr || !place.is(PictureForm::video)) return both;
    return decoded(place, std::move(both), statement);
}

/// The depth of a place that holds no colour.
Sources depth_in(const Place& place, const DepthStatement& statement) {
    return decoded(place, {open_picture_source(place.path, PictureRole::depth), nullptr},
                   statement);
}

/// Whether a single place is depth: by its name, its levels or its appearance, which is a guess.
bool is_depth(const Place& place, const PictureGuess& guess) {
    if (named_depth(place.path) || place.is(PictureForm::bag)) return true;
    if (place.is(PictureForm::row)) {
        const PictureSet found = pictures_at(place.path);
        if (!found.depth.empty()) return true;
        if (found.unnamed.empty()) return false;
    }
    if (guess.kind == PictureKind::grey_depth || guess.kind == PictureKind::hue_depth ||
        guess.kind == PictureKind::ramp_depth)
        return true;
    const auto source = open_picture_source(place.path, PictureRole::depth);
    return source->facts().bits > 8 && source->facts().channels == 1;
}

[[noreturn]] void refuse_without_depth(const fs::path& colour, const std::string& looked_for) {
    const std::vector<cv::Mat> first = colour_samples(colour, 1);
    if (!first.empty() && has_painted_half(first.front()))
        throw InputError(shown(colour) +
                         " is a picture beside a painting of its depth, whose colours are no "
                         "numbers: save the depth itself, in grey or as an array (.npy), and give "
                         "it as the second file");
    throw DepthMissing(shown(colour) +
                       " needs a depth file beside it: give one as the second file (looked for " +
                       looked_for +
                       "), say how the depth is in it with --packing, or let an estimator make it "
                       "(dibhr help depth)");
}

bool is_row(const fs::path& place) {
    return names_pictures(place) && !is_ros_bag(place, head_of(place));
}

/// Opens colour and depth of two places, each a file, a folder, a list or a pattern.
Sources of_two_places(const fs::path& colour, const fs::path& depth,
                      const DepthStatement& statement) {
    if (is_row(colour) && is_row(depth)) return rows_of_two(colour, depth);
    // First, so that an error of the colour file is not reported as one of the depth.
    auto colour_source = open_picture_source(colour, PictureRole::colour);
    Sources sources = depth_in(Place(depth), statement);
    sources.colour = std::move(colour_source);
    return sources;
}

/// Colour and depth of one place by its tracks, names or metadata, or by the statement; no depth
/// where these give none.
Sources both_as_stated(const Place& place, const DepthStatement& statement) {
    if (!statement.packing || !is_of_halves(*statement.packing)) {
        if (Sources both = both_in(place, statement); both.depth) return both;
    }
    if (place.is(PictureForm::bag)) return {};
    const auto form = packed_form(place, statement);
    return form ? open_packed(place.path, *form) : Sources{};
}

/// Guesses the content of a place from its pictures: halves, depth alone, or colour alone.
Sources guessed_content(const Place& place, const DepthStatement& statement) {
    PictureGuess guess;
    if (!place.is(PictureForm::bag)) guess = guess_kind(colour_samples(place.path, kKindSamples));
    if (!statement.packing) {
        if (auto halves = halves_by_appearance(place.path, guess)) return std::move(*halves);
    }
    if (is_depth(place, guess) || statement.code == DepthCode::hue)
        return depth_in(place, statement);
    return {nullptr, open_picture_source(place.path, PictureRole::colour)};
}

/// The same place was given twice: it holds both, else its pictures are colour and depth at once.
Sources of_the_same_place(const fs::path& place, const DepthStatement& statement) {
    if (Sources both = both_as_stated(Place(place), statement); both.depth) return both;
    const PictureGuess guess = guess_kind(colour_samples(place, kKindSamples));
    if (auto halves = halves_by_appearance(place, guess)) return std::move(*halves);
    return of_two_places(place, place, statement);
}

/// One place was given: it holds both, or depth is beside it, or it is depth alone.
Sources of_one_place(const Place& place, const DepthStatement& statement) {
    if (Sources both = both_as_stated(place, statement); both.depth) return both;
    std::string looked_for;
    if (const auto depth = find_depth_beside(place.path, looked_for))
        return of_two_places(place.path, *depth, statement);
    Sources sources = guessed_content(place, statement);
    if (!sources.depth) refuse_without_depth(place.path, looked_for);
    return sources;
}

}  // namespace

Sources find_sources(const fs::path& colour, const fs::path& depth,
                     const DepthStatement& statement) {
    set_up_libraries();
    const MediaPlaces places = places_for(colour, depth);
    Sources sources;
    if (places.depth.empty())
        sources = of_one_place(Place(places.colour), statement);
    else if (places.depth == places.colour)
        sources = of_the_same_place(places.colour, statement);
    else
        sources = of_two_places(places.colour, places.depth, statement);
    add_clause(sources.notice, places.notice);
    return sources;
}

Sources find_depth(const fs::path& place, const DepthStatement& statement) {
    set_up_libraries();
    const fs::path found = depth_place_for(place);
    const Place depth(found);
    Sources sources = both_as_stated(depth, statement);
    if (!sources.depth) sources = depth_in(depth, statement);
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
        const Place only(places.colour);
        sources = both_as_stated(only, statement);
        if (!sources.depth) sources = guessed_content(only, statement);
    }
    add_clause(sources.notice, places.notice);
    return sources;
}

}  // namespace dibhr
