// Opens a colour and a depth video or image, and pairs their frames by presentation time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/holes/depth_memory.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"
#include "core/video/depth/findings.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/frames/object_pool.hpp"

namespace dibhr {

class LiveFeed;
struct SourcePictures;

/// A decoded pair, not yet cleaned. NaN in its depth: no data.
struct RawFrame {
    DepthImage depth{};
    std::vector<HeldLevel> held{};  ///< last levels of pixels without data; by HeldLevelsMedia
    /// Depth cleaned ahead of time from `depth` and `held`, which then are empty; by DecodedAhead.
    std::shared_ptr<SingleFrameDepth> single_frame{};
    std::shared_ptr<const SettledDepth> settled{};  ///< likewise; null: not done
    double single_frame_ms{0.0};                    ///< how long that took
    ColourImage colour{};
    /// The colour as a video's decoder made it, after Media::share_video(); `colour` is empty then.
    std::shared_ptr<const VideoPicture> video{};
    std::shared_ptr<const SourcePictures> taken{};  ///< of a live source: the original pictures
    bool colour_of_view{false};  ///< a camera's picture, as far as known from the depth's view
    double media_s{0.0};
    std::int64_t index{0};
    bool never_has_holes{false};  ///< no frame of this media has a pixel without data
    double skipping_s{0.0};       ///< mean time to skip a frame; 0: as long as reading it
    bool depth_left_out{false};   ///< after Media::leave_out_depth()
};

/// The times of all frames of a media, rising [s]; null: not known.
using FrameTimes = std::shared_ptr<const std::vector<double>>;

/// Thrown for colour with no depth in it or beside it.
class DepthMissing : public InputError {
  public:
    using InputError::InputError;
};

/// What decodes videos: a device where that gives the same pictures, or always the processors.
enum class Decoder : std::uint8_t { automatic, software };

inline constexpr std::array<NamedValue<Decoder>, 2> kDecoderNames{
    {{Decoder::automatic, "auto", "Auto"}, {Decoder::software, "software", "Software"}}};
static_assert(has_all_in_order(kDecoderNames, Decoder::software));

[[nodiscard]] constexpr const auto& name_table(Decoder) noexcept {
    return kDecoderNames;
}

/// The statements on depth that come with a request to open.
struct DepthRequest {
    /// Open facts are read from sidecars and the files' metadata, else guessed from their content.
    /// False: levels stay as the file has them, except for what the command line states.
    bool find_out{false};
    DepthStatement command_line{};
    DepthStatement panel{};
    /// The folder of earlier choices, a file for each media, which complete `panel`, and for each
    /// folder of media. Empty: not used.
    std::filesystem::path kept_in{};
    /// The cache of prepared surfaces (playing/prepared_cache.hpp). Empty: not used.
    std::filesystem::path prepared_in{};
    bool panel_is_whole{false};  ///< earlier choices for this media do not complete `panel`
    DepthStatement recorded{};   ///< of a session; beats all others
    /// Open already for the same live places; null: opens them.
    std::shared_ptr<LiveFeed> live{};
    Decoder decoder{Decoder::automatic};
    bool paints{true};  ///< depth alone is shown in colours of its own
};

/// The relief and the pitch that fit a media.
struct Fit {
    double relief_px;  ///< of the highest level
    double pixel_pitch_mm;
};

/// For `dibhr info` and the Video panel.
struct MediaDescription {
    std::filesystem::path colour_path{};
    std::filesystem::path depth_path{};
    int colour_columns{0}, colour_rows{0};
    int depth_columns{0}, depth_rows{0};
    std::string colour_codec{}, depth_codec{};
    std::string decoders{};   ///< devices that decode, or why they do not; empty: the processors
    int depth_bits{8};        ///< of a level; 32: real numbers
    int levels_used{0};       ///< different levels in the sample pictures (`dibhr info`)
    double holes_share{0.0};  ///< share of their pixels without data, in [0, 1] (`dibhr info`)
    /// The share of the pixels with data where the depth is sparse; nothing: it is not.
    std::optional<double> sparse_share{};
    /// Of a still (depth/texture_slope.hpp); nothing: not known.
    std::optional<double> texture_slope{};
    std::optional<DepthNoise> noise{};      ///< used for cleaning when it was recorded live
    std::optional<Fit> true_fit{};          ///< of a true shape, whose pixels are millimetres
    std::optional<DepthMeaning> meaning{};  ///< nothing: levels as in the file
    /// What the meaning was concluded from, how sure it is, and what else it may be: a window asks.
    DepthConclusion conclusion{};
    DepthStatement panel{};       ///< chosen on the panel, now or kept
    std::string registered_by{};  ///< the calibration that puts colour over depth; empty: none
    double duration_s{0.0};
    double frames_per_s{0.0};  ///< mean of the intervals known so far; 0 for a still
    std::int64_t frames{0};    ///< an estimate until the end was read
    bool frames_exact{false};  ///< the end was read: frames and duration are exact
    bool still{false};
    std::filesystem::path prepared_in{};  ///< as requested
    std::string times_from{};             ///< what decides them (TimesFrom); empty: a still
    std::string timing{};             ///< the same for people: "those of 'rgb.mp4', frame by frame"
    double colour_frames_per_s{0.0};  ///< of a colour file of its own; 0: a still, or not known
    double colour_duration_s{0.0};    ///< likewise
    bool colour_still{false};
    bool live{false};  ///< a live source: no length, no end, no seek
    /// A sentence once a file holds less than at its opening, because it was cut or overwritten
    /// meanwhile. The rest plays on.
    std::string trouble{};
    /// Sentences on what the opening ignored or chose; mostly empty.
    std::string notice{};

    [[nodiscard]] std::size_t depth_pixels() const noexcept {
        return static_cast<std::size_t>(depth_columns) * static_cast<std::size_t>(depth_rows);
    }
    [[nodiscard]] bool has_real_numbers() const noexcept { return depth_bits > 16; }
};

/// Where a person can state what depth means: by options, or only in a sidecar.
enum class StatedBy { options, sidecar };

/// A sentence for people where the meaning is likely but not sure: what near is assumed to be or,
/// where that is sure, the unit and the scale; how sure that is, and what settles it. Empty: the
/// meaning is sure, or a person stated it.
[[nodiscard]] std::string doubt_about(const MediaDescription& media,
                                      StatedBy way = StatedBy::options);

/// The paper's proportions at any picture size: the height from farthest to nearest is 255/720 of
/// the width, and the width is a Falcon's reach, 101.6 mm. A true shape keeps its millimetres. A
/// still that is steep all over, as a bump map is, has less relief: half of its slopes are at most
/// 1.
[[nodiscard]] Fit fit_of(const MediaDescription& media);

/// Why its motion is found badly or not at all, as one sentence; empty: no reason.
[[nodiscard]] std::string motion_trouble(const MediaDescription& media);

/// The requested cleaning, or, where that is automatic, the one that the media states.
[[nodiscard]] CleaningOptions cleaning_on(const MediaDescription& media, CleaningOptions asked);

/// The radius of the fingertip [mm]: the requested one, or, where that is 0, the one that the media
/// states.
[[nodiscard]] double finger_mm_on(const MediaDescription& media, double asked_mm);

/// One opened colour + depth pair. Frames come in order: each depth picture with the colour shown
/// at its time.
class Media {
  public:
    virtual ~Media() = default;
    [[nodiscard]] virtual const MediaDescription& description() const = 0;
    /// The next frame, or nothing at the end. Throws InputError when the file breaks off.
    virtual std::optional<RawFrame> next() = 0;
    /// The next frame at `earliest_s` or later, or the last one. Earlier frames are only decoded
    /// where that is enough.
    virtual std::optional<RawFrame> next_from(double earliest_s);
    /// The next frame returned is the one shown at `media_s`.
    virtual void seek(double media_s) = 0;
    /// The next frame returned is a frame near it that is quick to decode, or that frame itself.
    virtual void seek_near(double media_s) { seek(media_s); }
    /// As seek(), for a reader that uses the depth alone: until the next seek frames may come
    /// without colour, which then need not be decoded.
    virtual void seek_depth(double media_s) { seek(media_s); }
    /// From the next frame on the colour of a video may come as its decoder made it.
    virtual void share_video() {}
    /// From the next frame on the depth takes its memory from there.
    virtual void take_memory_from(const ObjectPool<DepthImage>& /*images*/) {}
    /// The reader has the depth of all frames, which have these times: from the next seek on frames
    /// come without it, and it is not decoded, unless the colour depends on it. Null: frames come
    /// with depth.
    virtual void leave_out_depth(const FrameTimes& /*times*/) {}
    /// The feed of a live source: next() waits for its frames, and seek() does nothing. Null: read
    /// from files.
    [[nodiscard]] virtual std::shared_ptr<LiveFeed> live() const { return nullptr; }
};

/// Opens a pair. Each path is a file, a folder, a list or a pattern of pictures, or live (see
/// live_name()). Empty `colour`: depth alone, shown in colours of its own. Empty `depth`, or the
/// same path: the depth is in the same place, as another track of a video, or a file beside it. A
/// kept choice that no longer fits the files is ignored, and the notice says so. Throws
/// InputError: what, which file, what to do next.
[[nodiscard]] std::unique_ptr<Media> open_media(const std::filesystem::path& colour,
                                                const std::filesystem::path& depth = {},
                                                const DepthRequest& request = {});

/// Opens a depth video, a file's depth track, an image, or the depth of a folder, list or pattern
/// alone (`dibhr touch --depth`); its colour is empty.
[[nodiscard]] std::unique_ptr<Media> open_depth(const std::filesystem::path& place,
                                                const DepthRequest& request = {});

/// Describes one place of any kind, without its partner (`dibhr info FILE`): depth fills the depth
/// fields, other files the colour fields, a place of both all of them. Videos of up to a few
/// thousand frames are read to their end, so that the numbers are exact. `other`: a second place;
/// where it holds colour alone, depth has the meaning and the times of the two together.
[[nodiscard]] MediaDescription describe_media(const std::filesystem::path& place,
                                              const DepthRequest& request = {.find_out = true},
                                              const std::filesystem::path& other = {});

}  // namespace dibhr
