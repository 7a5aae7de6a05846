// Checks, opens and pairs what people bring.
#include "core/video/media.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/libraries.hpp"
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

constexpr std::array<std::string_view, 3> kColourWords{"colour", "color", "rgb"};

/// `stem` with the first `word` replaced by `other`, written as large as `word` is; nothing when
/// the stem does not hold the word.
std::optional<std::string> renamed(const std::string& stem, std::string_view word,
                                   std::string_view other) {
    const auto at = lower_case(stem).find(word);
    if (at == std::string::npos) return std::nullopt;
    const auto is_large = [&](std::size_t k) {
        return std::isupper(static_cast<unsigned char>(stem[k])) != 0;
    };
    const auto large = [](char c) {
        return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    };
    std::string written(other);
    if (is_large(at)) written[0] = large(written[0]);
    if (is_large(at) && is_large(at + 1))
        std::transform(written.begin(), written.end(), written.begin(), large);
    return std::string(stem).replace(at, word.size(), written);
}

bool is_folder(const fs::path& place) {
    std::error_code ignored;
    return fs::is_directory(place, ignored);
}

bool is_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

/// The file of that stem in that folder, whatever its extension; the first by name. Nothing when
/// none.
std::optional<fs::path> with_any_extension(const fs::path& folder, const std::string& stem) {
    static constexpr std::array<std::string_view, 18> kExtensions{
        ".avi", ".bmp", ".jpeg", ".jpg", ".m4v", ".mkv", ".mov",  ".mp4",  ".mpg",
        ".ogv", ".pgm", ".png",  ".ppm", ".tif", ".ts",  ".tiff", ".webm", ".webp"};
    std::set<fs::path> found;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const auto& file = entry->path();
        const auto extension = lower_case(file.extension().string());
        if (file.stem() == stem &&
            std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() &&
            is_file(file))
            found.insert(folder / file.filename());
    }
    if (found.empty()) return std::nullopt;
    return *found.begin();
}

/// The file beside `given` of that stem: of the same extension, else of another; the folder beside
/// a folder.
std::optional<fs::path> with_stem(const fs::path& given, const std::string& stem) {
    const auto folder = given.parent_path();
    const auto same = folder / (stem + given.extension().string());
    if (is_folder(given)) return is_folder(same) ? std::optional(same) : std::nullopt;
    return is_file(same) ? same : with_any_extension(folder, stem);
}

/// A colour frame up to this part of an interval later than the depth frame still belongs to it:
/// streams that run together may be a little apart. Less than half, so that halfway the earlier one
/// is taken.
constexpr double kNotLater = 0.4;
constexpr std::int64_t kMostCounted = 3000;  ///< frames decoded to describe a video exactly

/// How much later than the depth the colour begins [s]: as both files say, when they overlap.
double colour_start_s(const SourceFacts& colour, const SourceFacts& depth) {
    const double later_s = colour.start_s - depth.start_s;
    const bool overlap = later_s < depth.duration_s && -later_s < colour.duration_s;
    return overlap ? later_s : 0.0;
}

/// The colour that belongs to each depth frame: the newest one of its time.
class ColourTrack {
  public:
    ColourTrack(std::unique_ptr<PictureSource> source, double starts_later_s)
        : source_(std::move(source)), starts_later_s_(starts_later_s) {}

    [[nodiscard]] const SourceFacts& facts() const { return source_->facts(); }
    void forget() { placed_ = false; }

    const cv::Mat& shown_at(double depth_time_s, double depth_interval_s) {
        const double interval_s = std::min(depth_interval_s, interval_of(source_->facts()));
        const double latest_s = depth_time_s - starts_later_s_ + kNotLater * interval_s;
        if (!placed_) {
            source_->seek(latest_s);
            now_ = source_->next().value_or(now_);
            later_ = source_->next();
            placed_ = true;
        }
        while (later_ && later_->time_s <= latest_s) {
            now_ = std::move(*later_);
            later_ = source_->next();
        }
        return now_.picture;
    }

    [[nodiscard]] static double interval_of(const SourceFacts& facts) {
        return facts.frames_per_s > 0.0 ? 1.0 / facts.frames_per_s : 1.0;
    }

  private:
    std::unique_ptr<PictureSource> source_;
    double starts_later_s_;  // than the depth
    TimedPicture now_{};
    std::optional<TimedPicture> later_{};
    bool placed_{false};
};

void describe_depth(const SourceFacts& facts, MediaDescription& description) {
    description.depth_path = facts.file;
    description.depth_columns = facts.columns;
    description.depth_rows = facts.rows;
    description.depth_codec = facts.codec;
    description.depth_bits = facts.bits;
}

void describe_colour(const SourceFacts& facts, MediaDescription& description) {
    description.colour_path = facts.file;
    description.colour_columns = facts.columns;
    description.colour_rows = facts.rows;
    description.colour_codec = facts.codec;
}

void describe_time(const SourceFacts& facts, MediaDescription& description) {
    description.duration_s = facts.duration_s;
    description.frames_per_s = facts.still ? 0.0 : facts.frames_per_s;
    description.frames = facts.frames;
    description.frames_exact = facts.frames_exact;
    description.still = facts.still;
}

/// Depth drives; colour is optional.
class PairedMedia : public Media {
  public:
    PairedMedia(std::unique_ptr<PictureSource> depth, std::optional<ColourTrack> colour)
        : depth_(std::move(depth)), colour_(std::move(colour)) {
        describe_depth(depth_->facts(), description_);
        describe_time(depth_->facts(), description_);
        if (colour_) describe_colour(colour_->facts(), description_);
    }

    [[nodiscard]] const MediaDescription& description() const override { return description_; }

    std::optional<RawFrame> next() override {
        auto taken = depth_->next();
        describe_time(depth_->facts(), description_);
        tell_trouble(depth_->facts());
        if (!taken) return std::nullopt;
        keep_size(taken->picture);
        RawFrame frame;
        frame.depth = depth_of(taken->picture, depth_->facts().bits);
        frame.media_s = taken->time_s;
        frame.index = taken->index;
        if (colour_) {
            const double interval_s = ColourTrack::interval_of(depth_->facts());
            frame.colour = colour_of(colour_->shown_at(frame.media_s, interval_s));
            tell_trouble(colour_->facts());
        }
        return frame;
    }

    void seek(double media_s) override {
        depth_->seek(media_s);
        if (colour_) colour_->forget();
    }

    /// Reads depth on, at most `most` frames, so that the description becomes exact.
    void count_frames(std::int64_t most) {
        depth_->count_frames(most);
        describe_time(depth_->facts(), description_);
    }

  private:
    void tell_trouble(const SourceFacts& facts) {
        if (description_.trouble.empty()) description_.trouble = facts.trouble;
    }

    /// A stream may change its size on the way; a surface may not. Levels are never mixed.
    void keep_size(cv::Mat& picture) const {
        const cv::Size size(description_.depth_columns, description_.depth_rows);
        if (picture.size() == size) return;
        cv::Mat resized;
        cv::resize(picture, resized, size, 0.0, 0.0, cv::INTER_NEAREST);
        picture = resized;
    }

    std::unique_ptr<PictureSource> depth_;
    std::optional<ColourTrack> colour_;
    MediaDescription description_{};
};

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
    if (is_folder(file)) return std::nullopt;
    require_readable(file);
    if (is_still(file)) return std::nullopt;
    const std::vector<VideoTrack> tracks = video_tracks(file);
    const auto likelihood_of_depth = [](const VideoTrack& track) {
        if (lower_case(track.title).find("depth") != std::string::npos) return 100;
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

std::unique_ptr<PairedMedia> paired(std::unique_ptr<PictureSource> colour,
                                    std::unique_ptr<PictureSource> depth) {
    const double later_s = colour_start_s(colour->facts(), depth->facts());
    return std::make_unique<PairedMedia>(std::move(depth), ColourTrack(std::move(colour), later_s));
}

std::unique_ptr<PictureSource> sequence(const fs::path& folder, const PictureRow& row,
                                        const PictureRow& other, PictureRole role) {
    return std::make_unique<PictureSequence>(folder, row, times_s(row, other, kPicturesPerSecond),
                                             role);
}

std::unique_ptr<PairedMedia> paired(const fs::path& colour_folder, const PictureRow& colour,
                                    const fs::path& depth_folder, const PictureRow& depth) {
    return paired(sequence(colour_folder, colour, depth, PictureRole::colour),
                  sequence(depth_folder, depth, colour, PictureRole::depth));
}

/// The pictures of that role, or those whose names say nothing. Throws InputError when there are
/// none.
PictureRow row_of(const fs::path& folder, PictureRole role) {
    PictureFolder found = look_into(folder);
    const bool is_depth = role == PictureRole::depth;
    PictureRow& named = is_depth ? found.depth : found.colour;
    PictureRow& row = named.empty() ? found.unnamed : named;
    if (row.empty())
        throw InputError(shown(folder) + " is a folder without " + (is_depth ? "depth" : "colour") +
                         " pictures: give the folder or the file that holds them");
    return std::move(row);
}

/// The colour and the depth of one file's tracks, or of one folder; null when it does not hold
/// both.
std::unique_ptr<PairedMedia> open_both(const fs::path& place) {
    if (is_folder(place)) {
        const PictureFolder found = look_into(place);
        if (found.colour.empty() || found.depth.empty()) return nullptr;
        return paired(place, found.colour, place, found.depth);
    }
    const auto tracks = colour_and_depth_tracks(place);
    if (!tracks) return nullptr;
    return paired(std::make_unique<VideoFile>(place, PictureRole::colour, tracks->colour),
                  std::make_unique<VideoFile>(place, PictureRole::depth, tracks->depth));
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

}  // namespace

std::string shown(const fs::path& file) {
    return in_quotes(file.string(), std::string::npos);
}

bool named_colour(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    return std::any_of(kColourWords.begin(), kColourWords.end(),
                       [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

bool named_depth(const fs::path& file) {
    return lower_case(file.stem().string()).find("depth") != std::string::npos;
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
    if (begins_like_text(in))
        throw InputError(shown(file) + " holds text, not a video or a picture: give another file");
}

void require_size(const fs::path& file, int columns, int rows) {
    if (columns >= 2 && rows >= 2) return;
    throw InputError(shown(file) + " is only " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " pixels: give one of at least 2 x 2");
}

std::optional<fs::path> find_depth_beside(const fs::path& colour, std::string& looked_for) {
    looked_for.clear();
    for (const auto word : kColourWords) {
        const auto stem = renamed(colour.stem().string(), word, "depth");
        if (!stem) continue;
        const auto same = colour.parent_path() / (*stem + colour.extension().string());
        if (!looked_for.empty()) looked_for += ", ";
        looked_for += shown(same) + " (or another extension)";
        if (auto found = with_stem(colour, *stem)) return found;
    }
    if (looked_for.empty())
        looked_for = "nothing, because the name holds neither color, colour nor rgb";
    return std::nullopt;
}

std::optional<fs::path> find_colour_beside(const fs::path& depth) {
    for (const auto word : kColourWords) {
        const auto stem = renamed(depth.stem().string(), "depth", word);
        if (!stem) continue;
        if (auto found = with_stem(depth, *stem)) return found;
    }
    return std::nullopt;
}

std::unique_ptr<PictureSource> open_picture_source(const fs::path& file, PictureRole role) {
    set_up_libraries();
    if (is_folder(file)) return sequence(file, row_of(file, role), {}, role);
    require_readable(file);
    if (is_still(file)) return std::make_unique<StillFile>(file, role);
    return std::make_unique<VideoFile>(file, role);
}

std::unique_ptr<Media> open_media(const fs::path& colour, const fs::path& depth) {
    if (colour.empty())
        throw InputError(shown(depth) +
                         " is depth alone: give the colour file that belongs to it, too");
    set_up_libraries();
    if (depth.empty() || depth == colour) {
        if (auto both = open_both(colour)) return both;
    }
    // First, so that a colour file that cannot be read is not blamed on a missing depth file.
    auto colour_source = open_picture_source(colour, PictureRole::colour);
    const fs::path depth_file = depth_file_for(colour, depth);
    if (is_folder(colour) && is_folder(depth_file))
        return paired(colour, row_of(colour, PictureRole::colour), depth_file,
                      row_of(depth_file, PictureRole::depth));
    return paired(std::move(colour_source), open_picture_source(depth_file, PictureRole::depth));
}

std::unique_ptr<Media> open_depth(const fs::path& depth) {
    set_up_libraries();
    const auto tracks = colour_and_depth_tracks(depth);
    return std::make_unique<PairedMedia>(
        tracks ? std::make_unique<VideoFile>(depth, PictureRole::depth, tracks->depth)
               : open_picture_source(depth, PictureRole::depth),
        std::nullopt);
}

MediaDescription describe_media(const fs::path& file) {
    set_up_libraries();
    if (const auto both = open_both(file)) {
        both->count_frames(kMostCounted);
        return both->description();
    }
    const auto source = open_picture_source(file, PictureRole::depth);
    source->count_frames(kMostCounted);
    const SourceFacts& facts = source->facts();
    MediaDescription description;
    const bool depth = named_depth(file) || facts.channels == 1 || facts.bits == 16;
    depth ? describe_depth(facts, description) : describe_colour(facts, description);
    describe_time(facts, description);
    return description;
}

}  // namespace dibhr
