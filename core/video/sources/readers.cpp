// The list of readers, and the search in it.
#include "core/video/sources/readers.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/array_file.hpp"
#include "core/video/formats/bags/ros_bag.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/formats/video_packets.hpp"
#include "core/video/sources/layouts/layouts.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Whether a file begins as most videos do (MP4 and QuickTime, Matroska, AVI, NUT). These need no
/// picture codecs to be loaded; other videos are files that the picture codecs do not know.
bool is_video_container(const fs::path& /*file*/, std::string_view head) {
    constexpr std::array<std::string_view, 9> kBrands{"isom", "iso2", "iso4", "iso5", "iso6",
                                                      "mp41", "mp42", "M4V ", "qt  "};
    if (head.size() < 12) return false;
    if (head.substr(4, 4) == "ftyp")
        return std::find(kBrands.begin(), kBrands.end(), head.substr(8, 4)) != kBrands.end();
    return head.starts_with("\x1a\x45\xdf\xa3") || head.starts_with("nut/multimedia") ||
           (head.starts_with("RIFF") && head.substr(8, 4) == "AVI ");
}

bool is_pfm(const fs::path& /*file*/, std::string_view head) {
    return (head.starts_with("Pf") || head.starts_with("PF")) && head.size() > 2 &&
           (head[2] == '\n' || head[2] == '\r' || head[2] == ' ' || head[2] == '\t');
}

bool is_heif(const fs::path& /*file*/, std::string_view head) {
    constexpr std::array<std::string_view, 5> kBrands{"heic", "heix", "heim", "heis", "mif1"};
    return head.size() >= 12 && head.substr(4, 4) == "ftyp" &&
           std::find(kBrands.begin(), kBrands.end(), head.substr(8, 4)) != kBrands.end();
}

bool is_jpeg_with_depth(const fs::path& file, std::string_view head) {
    return head.starts_with("\xff\xd8\xff") && jpeg_has_depth(file);
}

template <typename Source>
std::unique_ptr<PictureSource> open_file(const fs::path& file, PictureRole role) {
    return std::make_unique<Source>(file, role);
}

bool bag_has_colour(const fs::path& place) {
    return ros_bag_holds(place, PictureRole::colour);
}

template <bool (*HoldsBoth)(const fs::path&)>
Sources both_if(const fs::path& place) {
    if (!HoldsBoth(place)) return {};
    return {open_picture_source(place, PictureRole::depth),
            open_picture_source(place, PictureRole::colour)};
}

/// The depth of a file of arrays alone where its colours are in no form that is read.
Sources both_arrays(const fs::path& file) {
    if (!arrays_have_colour_and_depth(file)) return {};
    Sources both;
    both.depth = open_picture_source(file, PictureRole::depth);
    try {
        both.colour = open_picture_source(file, PictureRole::colour);
    } catch (const InputError& error) {
        both.notice = std::string("only the depth is opened: ") + error.what();
    }
    return both;
}

/// The colour and depth track of a video. Depth is a track with "depth" in its title, else a grey
/// track beside one in colour; of several the one with the most bits.
Sources both_tracks(const fs::path& file) {
    const std::vector<VideoTrack> tracks = video_tracks(file);
    constexpr int kTitled = 100;  // more than any number of bits
    const auto likelihood_of_depth = [](const VideoTrack& track) {
        if (lower_case(track.title).find("depth") != std::string::npos) return kTitled;
        return track.grey ? track.bits : 0;
    };
    const auto depth = std::max_element(tracks.begin(), tracks.end(),
                                        [&](const VideoTrack& a, const VideoTrack& b) {
                                            return likelihood_of_depth(a) < likelihood_of_depth(b);
                                        });
    if (depth == tracks.end() || likelihood_of_depth(*depth) == 0) return {};
    const auto colour = std::find_if(tracks.begin(), tracks.end(), [&](const VideoTrack& track) {
        return likelihood_of_depth(track) == 0;
    });
    if (colour == tracks.end()) return {};
    Sources both;
    both.depth_track = static_cast<int>(depth - tracks.begin());
    both.depth = std::make_unique<VideoFile>(file, PictureRole::depth, both.depth_track);
    both.colour = std::make_unique<VideoFile>(file, PictureRole::colour,
                                              static_cast<int>(colour - tracks.begin()));
    both.findings = {
        finding_of_metadata({.packing = DepthPacking::tracks}, "tracks of colour and depth")};
    return both;
}

/// The first reader that accepts a place reads it; the last one accepts everything.
constexpr std::array kReaders{
    Reader{"bag of ROS 2", PictureForm::bag, is_ros_bag, nullptr, open_ros_topic,
           both_if<bag_has_colour>},
    Reader{"row of pictures", PictureForm::row,
           [](const fs::path& place, std::string_view) { return names_pictures(place); }, nullptr,
           open_row, both_rows, Evidence::layout},
    Reader{"video in a usual container", PictureForm::video, is_video_container, nullptr,
           open_file<VideoFile>, both_tracks},
    Reader{"numpy arrays", PictureForm::arrays, is_array_file, read_array, open_file<ArrayFile>,
           both_arrays},
    Reader{
        "OpenEXR picture", PictureForm::still,
        [](const fs::path&, std::string_view head) { return head.starts_with("\x76\x2f\x31\x01"); },
        read_exr, nullptr, both_if<exr_has_colour_and_depth>},
    Reader{"portable float map", PictureForm::still, is_pfm, read_pfm, nullptr, nullptr},
    Reader{"HEIC photo", PictureForm::still, is_heif, read_heif, nullptr, both_if<heif_has_depth>},
    Reader{"16-bit levels beside their picture", PictureForm::still, is_raw_levels, read_raw_levels,
           nullptr, nullptr, Evidence::layout},
    Reader{"photo with depth (JPEG)", PictureForm::still, is_jpeg_with_depth, read_jpeg_photo,
           nullptr, both_if<jpeg_has_depth>},
    Reader{"picture by OpenCV's codecs", PictureForm::still, is_opencv_picture, read_by_opencv,
           nullptr, nullptr},
    Reader{"video by libav", PictureForm::video,
           [](const fs::path&, std::string_view) { return true; }, nullptr, open_file<VideoFile>,
           both_tracks}};
constexpr std::size_t kMultiFileReaders =
    2;  ///< the first readers; all others are for single files

}  // namespace

const Reader& reader_of(const fs::path& place) {
    const std::string head = head_of(place);
    const auto takes = [&](const Reader& reader) { return reader.is_own(place, head); };
    const auto of_one_file = kReaders.begin() + kMultiFileReaders;
    auto found = std::find_if(kReaders.begin(), of_one_file, takes);
    if (found == of_one_file) {
        require_readable(place);
        const auto last = kReaders.end() - 1;  // accepts everything
        found = std::find_if(of_one_file, last, takes);
        if (found == last) require_no_other_form(place);
    }
    return *found;
}

Finding finding_on_form(const Reader& reader, const SourceFacts& facts) {
    const char* const by =
        reader.decided_by == Evidence::magic ? ", by its first bytes" : ", by the files there";
    return {{},
            reader.decided_by,
            kSurenessOfMetadata,
            std::string(reader.name) + by,
            "form " + facts.codec};
}

std::unique_ptr<PictureSource> open_picture_source(const fs::path& place, PictureRole role) {
    set_up_libraries();
    return KnownPlace(place).open(role);
}

std::unique_ptr<PictureSource> KnownPlace::open(PictureRole role) const {
    if (reader.open != nullptr) return reader.open(path, role);
    return std::make_unique<StillFile>(path, reader.read(path, role));
}

std::unique_ptr<PictureSource> open_as_colour(const fs::path& place, int track) {
    if (track > 0) return std::make_unique<VideoFile>(place, PictureRole::colour, track);
    return open_picture_source(place, PictureRole::colour);
}

std::vector<cv::Mat> colour_samples(const fs::path& place, int most, int track) {
    try {
        return open_as_colour(place, track)->samples(most);
    } catch (const InputError&) {
        return {};  // depth in a form without colours
    }
}

/// A file that no other reader accepts goes to OpenCV's codecs without a check.
StillPicture read_still(const fs::path& file, PictureRole role) {
    set_up_libraries();
    require_readable(file);
    const std::string head = head_of(file);
    const auto* const found =
        std::find_if(kReaders.begin(), kReaders.end(), [&](const Reader& reader) {
            return reader.read != nullptr &&
                   (reader.read == read_by_opencv || reader.is_own(file, head));
        });
    if (found->read == read_by_opencv && !found->is_own(file, head)) require_no_other_form(file);
    return found->read(file, role);
}

StillFile::StillFile(const fs::path& file, StillPicture still)
    : picture_(std::move(still.picture)) {
    facts_.file = file;
    facts_.columns = picture_.cols;
    facts_.rows = picture_.rows;
    facts_.bits = still.bits;
    facts_.channels = picture_.channels();
    facts_.codec = std::move(still.codec);
    facts_.findings = std::move(still.findings);
    take_times({0.0});
    require_size(file, facts_.columns, facts_.rows);
}

}  // namespace dibhr
