// Chooses what to read: tracks, halves, pictures, arrays, and which file belongs to which.
#include "core/video/sources.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_missing.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/formats/array_file.hpp"
#include "core/video/formats/ros_bag.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/layouts.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media.hpp"
#include "core/video/media_names.hpp"
#include "core/video/packed.hpp"
#include "core/video/picture_folder.hpp"
#include "core/video/picture_kind.hpp"
#include "core/video/recorder_metadata.hpp"
#include "core/video/video_file.hpp"
#include "core/video/video_packets.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kLookedAt = 6;  ///< pictures that tell of what kind they are

/// The two of a file's tracks that belong together.
struct ColourAndDepth {
    int colour;
    int depth;
};

/// Where a file's own words say it: one track has depth in its title, or is coded without colours
/// beside one that has them; of several such the one of the most bits. Nothing when none does.
std::optional<ColourAndDepth> colour_and_depth_tracks(const fs::path& file) {
    if (names_pictures(file) || is_ros_bag(file)) return std::nullopt;
    require_readable(file);
    if (is_still(file)) return std::nullopt;
    const std::vector<VideoTrack> tracks = video_tracks(file);
    constexpr int kTitled = 100;  // says more than any number of bits
    const auto likelihood_of_depth = [](const VideoTrack& track) {
        if (lower_case(track.title).find("depth") != std::string::npos) return kTitled;
        return track.grey ? track.bits : 0;
    };
    const auto depth = std::max_element(tracks.begin(), tracks.end(),
                                        [&](const VideoTrack& a, const VideoTrack& b) {
                                            return likelihood_of_depth(a) < likelihood_of_depth(b);
                                        });
    if (depth == tracks.end() || likelihood_of_depth(*depth) == 0) return std::nullopt;
    const auto colour = std::find_if(tracks.begin(), tracks.end(), [&](const VideoTrack& track) {
        return likelihood_of_depth(track) == 0;
    });
    if (colour == tracks.end()) return std::nullopt;
    return ColourAndDepth{static_cast<int>(colour - tracks.begin()),
                          static_cast<int>(depth - tracks.begin())};
}

/// Pictures of one kind, where they were found.
struct PlacedRow {
    fs::path place{};
    PictureRow pictures{};
    LayoutFacts said{};
};

std::unique_ptr<PictureSource> sequence(const PlacedRow& row, const PictureRow& other,
                                        PictureRole role) {
    return std::make_unique<PictureSequence>(
        row.place, row.pictures, times_s(row.pictures, other, kPicturesPerSecond), role, row.said);
}

/// The pictures of that role, or those whose names say nothing. Throws InputError when there are
/// none.
PlacedRow row_of(const fs::path& place, PictureRole role) {
    PictureSet found = pictures_at(place);
    const bool is_depth = role == PictureRole::depth;
    PictureRow& named = is_depth ? found.depth : found.colour;
    PictureRow& row = named.empty() ? found.unnamed : named;
    const bool has_others = !found.colour.empty() || !found.depth.empty();
    const std::string kind = !has_others ? "" : is_depth ? "depth " : "colour ";
    if (row.empty())
        throw InputError(shown(place) + (is_folder(place) ? " is a folder" : " is a list") +
                         " without " + kind +
                         "pictures: give the folder or the file that holds them");
    return {place, std::move(row), std::move(found.facts)};
}

Sources pair_of(PlacedRow colour, const PlacedRow& depth) {
    colour.pictures = nearest_in_time(colour.pictures, depth.pictures);
    return {sequence(depth, colour.pictures, PictureRole::depth),
            sequence(colour, depth.pictures, PictureRole::colour)};
}

Sources halves_of(const fs::path& place, const PackedForm& form) {
    UnpackedSources halves = open_packed(place, form);
    Sources sources{std::move(halves.depth), std::move(halves.colour)};
    DepthStatement& found = sources.found;
    found.packing = form.packing;
    found.code = form.hue ? DepthCode::hue : DepthCode::grey;
    return sources;
}

cv::Size picture_size(const fs::path& place) {
    const auto source = open_picture_source(place, PictureRole::colour);
    return {source->facts().columns, source->facts().rows};
}

/// A place as it looks; of a video that track.
std::unique_ptr<PictureSource> open_look(const fs::path& place, int track = 0) {
    if (track > 0) return std::make_unique<VideoFile>(place, PictureRole::colour, track);
    return open_picture_source(place, PictureRole::colour);
}

/// Pictures of a place as they look; none of what does not look like anything (real numbers).
std::vector<cv::Mat> looks_of(const fs::path& place, int most, int track = 0) {
    try {
        return open_look(place, track)->samples(most);
    } catch (const InputError&) {
        return {};  // it is depth of a form that has no colours
    }
}

/// What somebody says of halves, or a recorder's metadata, or the name; nothing when none does.
std::optional<PackedForm> packed_form(const fs::path& place, const DepthStatement& said) {
    std::optional<PackedForm> form;
    if (said.packing && !is_of_halves(*said.packing)) return form;
    if (!names_pictures(place) && !is_still(place))
        form = form_by_recorder(place, picture_size(place));
    const auto named = packing_by_name(place);
    if (!form && named && (named->says_depth || said.packing))
        form = PackedForm{
            .packing = named->packing, .half_size = named->half_size, .known_from = "its name"};
    if (!said.packing) return form;
    if (!form) form.emplace();
    form->packing = *said.packing;
    if (said.code == DepthCode::hue && !form->hue) form->hue.emplace();
    if (said.code == DepthCode::grey) form->hue.reset();
    return form;
}

/// As its pictures look, in halves; nothing when they do not.
std::optional<Sources> halves_by_look(const fs::path& place, const PictureGuess& look) {
    if (look.kind != PictureKind::packed) return std::nullopt;
    PackedForm form{.packing = look.packing, .known_from = "its pictures"};
    if (look.code == DepthCode::hue) form.hue.emplace();
    Sources sources = halves_of(place, form);
    sources.assumed = std::exchange(sources.found, {});
    sources.by_look = true;
    return sources;
}

/// Whether it is worth while to look at more pictures.
bool begins_in_colours(const fs::path& place, int track) {
    constexpr double kGrey = 0.01;  // share of pixels that compression colours
    const std::vector<cv::Mat> first = looks_of(place, 1, track);
    return !first.empty() && look_of(first.front()).coloured > kGrey;
}

/// A source of colours is decoded where they are a code, as somebody says or as they look.
Sources decoded(const fs::path& place, Sources sources, const DepthStatement& said, int track = 0) {
    const bool may_be_coded = said.code != DepthCode::hue && sources.depth->facts().channels != 1 &&
                              !names_pictures(place) && !is_array_file(place) &&
                              begins_in_colours(place, track);
    PictureKind kind = PictureKind::grey_depth;
    if (may_be_coded) kind = guess_kind(looks_of(place, kLookedAt, track)).kind;
    if (said.code && kind == PictureKind::hue_depth) kind = PictureKind::grey_depth;
    sources.by_look = kind == PictureKind::hue_depth || kind == PictureKind::ramp_depth;
    const bool is_hue = said.code == DepthCode::hue || kind == PictureKind::hue_depth;
    if (is_hue) {
        sources.depth = hue_decoded(open_look(place, track), HueCode{}, "its hues");
        sources.assumed.code = DepthCode::hue;
    } else if (kind == PictureKind::ramp_depth) {
        sources.depth = ramp_decoded(open_look(place, track), "its colours");
    }
    return sources;
}

/// The colour and the depth of one still picture, of one file's tracks, of one bag or folder;
/// nothing when it does not hold both.
Sources both_in(const fs::path& place, const DepthStatement& said) {
    if (is_ros_bag(place)) {
        if (!ros_bag_holds(place, PictureRole::colour)) return {};
        return {open_ros_topic(place, PictureRole::depth),
                open_ros_topic(place, PictureRole::colour)};
    }
    if (names_pictures(place)) {
        PictureSet found = pictures_at(place);
        if (found.colour.empty() || found.depth.empty()) return {};
        return pair_of({place, std::move(found.colour), {}},
                       {place, std::move(found.depth), std::move(found.facts)});
    }
    require_readable(place);
    if (holds_colour_and_depth(place))
        return {open_picture_source(place, PictureRole::depth),
                open_picture_source(place, PictureRole::colour)};
    const auto tracks = colour_and_depth_tracks(place);
    if (!tracks) return {};
    Sources both{std::make_unique<VideoFile>(place, PictureRole::depth, tracks->depth),
                 std::make_unique<VideoFile>(place, PictureRole::colour, tracks->colour)};
    both.found.packing = DepthPacking::tracks;
    return decoded(place, std::move(both), said, tracks->depth);
}

/// The depth of a place that holds no colour.
Sources depth_in(const fs::path& place, const DepthStatement& said) {
    return decoded(place, {open_picture_source(place, PictureRole::depth), nullptr}, said);
}

/// Whether a single place is depth as its name, its levels or its look say. The last is a guess.
bool is_depth(const fs::path& place, const PictureGuess& look) {
    if (named_depth(place) || is_ros_bag(place)) return true;
    if (names_pictures(place)) {
        const PictureSet found = pictures_at(place);
        if (!found.depth.empty()) return true;
        if (found.unnamed.empty()) return false;
    }
    if (look.kind == PictureKind::grey_depth || look.kind == PictureKind::hue_depth ||
        look.kind == PictureKind::ramp_depth)
        return true;
    const auto source = open_picture_source(place, PictureRole::depth);
    return source->facts().bits > 8 && source->facts().channels == 1;
}

[[noreturn]] void refuse_without_depth(const fs::path& colour, const std::string& looked_for) {
    throw DepthMissing(shown(colour) +
                       " needs a depth file beside it: give one as the second file (looked for " +
                       looked_for +
                       "), say how the depth is in it with --packing, or let an estimator make it "
                       "(dibhr help depth)");
}

/// Colour pictures of a folder, a list or a pattern, or a file of colour, and the place of the
/// depth that belongs to them.
Sources of_two_places(const fs::path& colour, const fs::path& depth, const DepthStatement& said) {
    const bool both_rows = names_pictures(colour) && names_pictures(depth);
    if (both_rows && !is_ros_bag(colour) && !is_ros_bag(depth))
        return pair_of(row_of(colour, PictureRole::colour), row_of(depth, PictureRole::depth));
    // First, so that a colour file that cannot be read is not blamed on the depth.
    auto colour_source = open_picture_source(colour, PictureRole::colour);
    Sources sources = depth_in(depth, said);
    sources.colour = std::move(colour_source);
    return sources;
}

/// Colour and depth of one place as its tracks, its names or its metadata say, or as somebody says;
/// nothing where they do not.
Sources both_as_said(const fs::path& place, const DepthStatement& said) {
    if (!said.packing || !is_of_halves(*said.packing)) {
        if (Sources both = both_in(place, said); both.depth) return both;
    }
    if (is_ros_bag(place)) return {};
    const auto form = packed_form(place, said);
    return form ? halves_of(place, *form) : Sources{};
}

/// What a place holds where nothing says it: halves, depth alone, or colour alone.
Sources as_it_looks(const fs::path& place, const DepthStatement& said) {
    PictureGuess look;
    if (!is_ros_bag(place)) look = guess_kind(looks_of(place, kLookedAt));
    if (!said.packing) {
        if (auto halves = halves_by_look(place, look)) return std::move(*halves);
    }
    if (is_depth(place, look) || said.code == DepthCode::hue) return depth_in(place, said);
    return {nullptr, open_picture_source(place, PictureRole::colour)};
}

/// Given as both: a place of both, or else one whose pictures are colour and depth at once.
Sources of_the_same_place(const fs::path& place, const DepthStatement& said) {
    if (Sources both = both_as_said(place, said); both.depth) return both;
    const PictureGuess look = guess_kind(looks_of(place, kLookedAt));
    if (auto halves = halves_by_look(place, look)) return std::move(*halves);
    return of_two_places(place, place, said);
}

/// Both in one place, the depth beside it, or depth alone.
Sources of_one_place(const fs::path& place, const DepthStatement& said) {
    if (Sources both = both_as_said(place, said); both.depth) return both;
    std::string looked_for;
    if (const auto depth = find_depth_beside(place, looked_for))
        return of_two_places(place, *depth, said);
    Sources sources = as_it_looks(place, said);
    if (!sources.depth) refuse_without_depth(place, looked_for);
    return sources;
}

}  // namespace

std::unique_ptr<PictureSource> open_picture_source(const fs::path& file, PictureRole role) {
    set_up_libraries();
    if (is_ros_bag(file)) return open_ros_topic(file, role);
    if (names_pictures(file)) return sequence(row_of(file, role), {}, role);
    require_readable(file);
    if (is_array_file(file)) return std::make_unique<ArrayFile>(file, role);
    if (is_still(file)) return std::make_unique<StillFile>(file, role);
    return std::make_unique<VideoFile>(file, role);
}

Sources find_sources(const fs::path& colour, const fs::path& depth, const DepthStatement& said) {
    set_up_libraries();
    const MediaPlaces places = places_for(colour, depth);
    Sources sources;
    if (places.depth.empty())
        sources = of_one_place(places.colour, said);
    else if (places.depth == places.colour)
        sources = of_the_same_place(places.colour, said);
    else
        sources = of_two_places(places.colour, places.depth, said);
    sources.notice = places.notice;
    return sources;
}

Sources find_depth(const fs::path& place, const DepthStatement& said) {
    set_up_libraries();
    const fs::path depth = depth_place_for(place);
    Sources sources = both_as_said(depth, said);
    if (!sources.depth) sources = depth_in(depth, said);
    sources.colour.reset();
    return sources;
}

Sources find_content(const fs::path& place, const DepthStatement& said) {
    set_up_libraries();
    const MediaPlaces places = places_for(place, {});
    Sources sources;
    if (!places.depth.empty()) {
        sources = of_two_places(places.colour, places.depth, said);
    } else {
        sources = both_as_said(place, said);
        if (!sources.depth) sources = as_it_looks(place, said);
    }
    sources.notice = places.notice;
    return sources;
}

}  // namespace dibhr
