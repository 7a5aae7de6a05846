// Checks, opens and describes what people bring.
#include "core/video/media.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/foreign.hpp"
#include "core/video/formats/ros_bag.hpp"
#include "core/video/layouts.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media_names.hpp"
#include "core/video/paired_media.hpp"
#include "core/video/picture_folder.hpp"
#include "core/video/pictures.hpp"
#include "core/video/video_file.hpp"
#include "core/video/video_packets.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Whether the file begins like text: no zero and no control bytes. Playlists are text, too, and
/// would make the decoder open other files. Text pictures (PNM) are not refused.
bool begins_like_text(std::ifstream& in) {
    std::array<char, 512> head{};
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    const auto count = static_cast<std::size_t>(in.gcount());
    if (count >= 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7') return false;
    return std::all_of(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(count), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 32 || (byte >= '\t' && byte <= '\r') || byte == 27;
    });
}

constexpr double kPaperRelief = 255.0 / 720.0;  ///< of the width
constexpr double kPaperWidth_mm = 101.6;
constexpr std::int64_t kMostCounted = 3000;  ///< frames decoded to describe a video exactly

bool is_still(const fs::path& file) {
    try {
        return cv::haveImageReader(file.string());
    } catch (const cv::Exception&) {
        return false;
    }
}

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

std::unique_ptr<PairedMedia> paired(PlacedRow colour, const PlacedRow& depth) {
    colour.pictures = nearest_in_time(colour.pictures, depth.pictures);
    return std::make_unique<PairedMedia>(sequence(depth, colour.pictures, PictureRole::depth),
                                         sequence(colour, depth.pictures, PictureRole::colour));
}

/// The pictures of that role, or those whose names say nothing. Throws InputError when there are
/// none.
PlacedRow row_of(const fs::path& place, PictureRole role) {
    PictureSet found = pictures_at(place);
    const bool is_depth = role == PictureRole::depth;
    PictureRow& named = is_depth ? found.depth : found.colour;
    PictureRow& row = named.empty() ? found.unnamed : named;
    if (row.empty())
        throw InputError(shown(place) + (is_folder(place) ? " is a folder" : " is a list") +
                         " without " + (is_depth ? "depth" : "colour") +
                         " pictures: give the folder or the file that holds them");
    return {place, std::move(row), std::move(found.facts)};
}

/// The colour and the depth of one file's tracks, or of one folder; null when it does not hold
/// both.
std::unique_ptr<PairedMedia> open_both(const fs::path& place) {
    if (is_ros_bag(place)) {
        if (!ros_bag_holds(place, PictureRole::colour)) return nullptr;
        return std::make_unique<PairedMedia>(open_ros_topic(place, PictureRole::depth),
                                             open_ros_topic(place, PictureRole::colour));
    }
    if (names_pictures(place)) {
        PictureSet found = pictures_at(place);
        if (found.colour.empty() || found.depth.empty()) return nullptr;
        return paired({place, std::move(found.colour), {}},
                      {place, std::move(found.depth), std::move(found.facts)});
    }
    const auto tracks = colour_and_depth_tracks(place);
    if (!tracks) return nullptr;
    return pair_of(std::make_unique<VideoFile>(place, PictureRole::depth, tracks->depth),
                   std::make_unique<VideoFile>(place, PictureRole::colour, tracks->colour),
                   request);
}

/// The depth file given, or found beside the colour file. Throws InputError that says what is
/// missing.
fs::path depth_file_for(const fs::path& colour, const fs::path& depth) {
    if (!depth.empty()) return depth;
    std::string looked_for;
    if (auto found = find_depth_beside(colour, looked_for)) return *found;
    if (named_depth(colour))
        throw InputError(
            shown(colour) +
            " is given alone and its name says depth: give the colour file first, then "
            "this one");
    throw InputError(shown(colour) +
                     " needs a depth file beside it: give one as the second file (looked for " +
                     looked_for + ")");
}

/// Colour pictures of a folder, a list or a pattern, and the place of the depth that belongs to
/// them.
std::unique_ptr<PairedMedia> open_with_pictures(const fs::path& colour, const fs::path& depth) {
    PlacedRow colours = row_of(colour, PictureRole::colour);
    const fs::path depth_place = depth_file_for(colour, depth);
    if (names_pictures(depth_place))
        return paired(std::move(colours), row_of(depth_place, PictureRole::depth));
    return std::make_unique<PairedMedia>(open_picture_source(depth_place, PictureRole::depth),
                                         sequence(colours, {}, PictureRole::colour));
}

/// Of a place that holds one of them only, as far as names say.
PictureRole role_of(const fs::path& place) {
    if (!names_pictures(place) || is_ros_bag(place)) return PictureRole::depth;
    const PictureSet found = pictures_at(place);
    const bool is_colour = !found.colour.empty() && found.depth.empty() && found.unnamed.empty();
    return is_colour ? PictureRole::colour : PictureRole::depth;
}

std::unique_ptr<PairedMedia> open_places(const fs::path& colour, const fs::path& depth) {
    if (depth.empty() || depth == colour) {
        if (auto both = open_both(colour)) return both;
    }
    if (names_pictures(colour) && !is_ros_bag(colour)) return open_with_pictures(colour, depth);
    // First, so that a colour file that cannot be read is not blamed on a missing depth file.
    auto colour_source = open_picture_source(colour, PictureRole::colour);
    auto depth_source = open_picture_source(depth_file_for(colour, depth), PictureRole::depth);
    return std::make_unique<PairedMedia>(std::move(depth_source), std::move(colour_source));
}

}  // namespace

Fit fit_of(const MediaDescription& media) {
    const double columns = std::max(media.depth_columns, 2);
    return {kPaperRelief * columns, kPaperWidth_mm / columns};
}

std::string shown(const fs::path& file) {
    return in_quotes(file.string(), std::string::npos);
}

void require_readable(const fs::path& file) {
    std::error_code failed;
    const auto status = fs::status(file, failed);
    if (status.type() == fs::file_type::not_found)
        throw InputError(shown(file) + " does not exist: check the name and the folder");
    if (failed)
        throw InputError(shown(file) + " cannot be reached (" + failed.message() +
                         "): check the name and the permissions of its folder");
    if (fs::is_directory(status))
        throw InputError(shown(file) + " is a folder: give the video or picture file in it");
    if (!fs::is_regular_file(status))
        throw InputError(shown(file) + " is a pipe or a device: save its data to a file first");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError(shown(file) + " cannot be read: check its permissions (chmod u+r)");
    if (fs::file_size(file, failed) == 0)
        throw InputError(shown(file) + " is empty: record or copy it again");
    if (const std::string advice = advice_on_foreign(file); !advice.empty())
        throw InputError(shown(file) + advice);
    if (begins_like_text(in))
        throw InputError(shown(file) + " holds text, not a video or a picture: give another file");
}

void require_size(const fs::path& file, int columns, int rows) {
    if (columns >= 2 && rows >= 2) return;
    throw InputError(shown(file) + " is only " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " pixels: give one of at least 2 x 2");
}

std::unique_ptr<PictureSource> open_picture_source(const fs::path& file, PictureRole role) {
    set_up_libraries();
    if (is_ros_bag(file)) return open_ros_topic(file, role);
    if (names_pictures(file)) return sequence(row_of(file, role), {}, role);
    require_readable(file);
    if (is_still(file)) return std::make_unique<StillFile>(file, role);
    return std::make_unique<VideoFile>(file, role);
}

std::unique_ptr<Media> open_media(const fs::path& colour, const fs::path& depth,
                                  const DepthRequest& request) {
    set_up_libraries();
    const MediaPlaces places = places_for(colour, depth);
    auto media = open_places(places.colour, places.depth);
    media->add_notice(places.notice);
    return media;
}

std::unique_ptr<Media> open_depth(const fs::path& place) {
    set_up_libraries();
    const fs::path depth = depth_place_for(place);
    const auto tracks = colour_and_depth_tracks(depth);
    return pair_of(tracks ? std::make_unique<VideoFile>(depth, PictureRole::depth, tracks->depth)
                          : open_picture_source(depth, PictureRole::depth),
                   nullptr, request);
}

MediaDescription describe_media(const fs::path& place) {
    set_up_libraries();
    const MediaPlaces places = places_for(place, {});
    const fs::path& file = places.colour;
    if (const auto both =
            places.depth.empty() ? open_both(file) : open_places(file, places.depth)) {
        both->add_notice(places.notice);
        both->count_frames(kMostCounted);
        return both->description();
    }
    const auto source = open_picture_source(file, role_of(file));
    source->count_frames(kMostCounted);
    const SourceFacts& facts = source->facts();
    MediaDescription description;
    const bool depth = named_depth(file) || facts.channels == 1 || facts.bits == 16;
    depth ? describe_depth(facts, description) : describe_colour(facts, description);
    describe_time(facts, description);
    description.notice = facts.notice;
    return description;
}

}  // namespace dibhr
