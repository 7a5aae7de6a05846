// Opens what people bring: a colour and a depth video or image, paired by presentation time, after
// what can be said about a file before any decoder sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/video/cleaning/depth_memory.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/lone_depth.hpp"
#include "core/video/depth/depth_meaning.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

class LiveFeed;
struct TakenPictures;

/// A decoded, not yet cleaned pair. NaN in its depth is no data.
struct RawFrame {
    DepthImage depth{};
    std::vector<HeldLevel> held{};  ///< what pixels without data were before; of RememberingMedia
    /// What was made of both ahead of time, which then are empty; of DecodedAhead.
    std::shared_ptr<const LoneDepth> lone{};
    double lone_ms{0.0};  ///< which took so long
    ColourImage colour{};
    std::shared_ptr<const TakenPictures> taken{};  ///< what it was made of, if it came live
    bool colour_of_view{false};  ///< a camera's, and as far as is known of the depth's own view
    double media_s{0.0};
    std::int64_t index{0};
    bool always_whole{false};  ///< no frame of this media has a pixel without data
    double passing_s{0.0};     ///< so long one takes, as of late, to pass over; 0: as to read it
};

/// There is colour, and no depth in it or beside it.
class DepthMissing : public InputError {
  public:
    using InputError::InputError;
};

/// Whose words count on what depth means.
struct DepthRequest {
    /// What nobody says is looked up in sidecars and in the files' own metadata, and else found out
    /// from their content. False: levels are as the file has them, but for what the command line
    /// says.
    bool find_out{false};
    DepthStatement command_line{};
    DepthStatement panel{};
    /// The folder of what was chosen on the panel before, a file a media: that is its word, too.
    /// Empty: none is heard.
    std::filesystem::path kept_in{};
    DepthStatement recorded{};  ///< a session's, which beats all others
    /// Of the same live places, open already; null: they are opened.
    std::shared_ptr<LiveFeed> live{};
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
    int depth_bits{8};        ///< of a level; 32: real numbers
    int levels_used{0};       ///< how many there are in pictures from all over it (`dibhr info`)
    double holes_share{0.0};  ///< of their pixels that are no data, in [0, 1] (`dibhr info`)
    std::optional<DepthNoise> noise{};      ///< by which it was cleaned when it was recorded live
    std::optional<Fit> true_fit{};          ///< of a true shape, whose pixels are millimetres
    std::optional<DepthMeaning> meaning{};  ///< nothing: levels are as the file has them
    DepthStatement panel{};                 ///< what the panel says of it, now or kept
    std::string registered_by{};  ///< the calibration that puts colour over depth; empty: none
    double duration_s{0.0};
    double frames_per_s{0.0};  ///< average of the real intervals as far as known; 0 for a still
    std::int64_t frames{0};    ///< an estimate until the end was reached
    bool frames_exact{false};  ///< the end was reached: frames and duration are those of the file
    bool still{false};
    double colour_frames_per_s{0.0};  ///< of a colour file of its own; 0: a still, or not known
    double colour_duration_s{0.0};    ///< likewise
    bool colour_still{false};
    bool live{false};  ///< it comes as it happens: no length, no end, and nothing is sought in it
    /// A sentence once a file turned out to hold less than at its opening: it was cut or
    /// overwritten meanwhile. What is left goes on.
    std::string trouble{};
    /// Sentences on what was passed over or chosen at the opening; mostly empty.
    std::string notice{};

    [[nodiscard]] std::size_t depth_pixels() const noexcept {
        return static_cast<std::size_t>(depth_columns) * static_cast<std::size_t>(depth_rows);
    }
    [[nodiscard]] bool has_real_numbers() const noexcept { return depth_bits > 16; }
};

/// From the farthest to the nearest it is as high as 255/720 of the width, and the width is what a
/// Falcon's hand reaches, 101.6 mm: as in the paper, whatever the picture's size. A true shape fits
/// as it is.
[[nodiscard]] Fit fit_of(const MediaDescription& media);

/// Why what moves in it is seen badly or not at all, in one sentence; empty: nothing is against it.
[[nodiscard]] std::string motion_trouble(const MediaDescription& media);

/// What is asked for, or where that is automatic what is said of the media.
[[nodiscard]] CleaningOptions cleaning_on(const MediaDescription& media, CleaningOptions asked);

/// The radius of the fingertip [mm]: the one asked for, or where that is 0 what is said of the
/// media.
[[nodiscard]] double finger_mm_on(const MediaDescription& media, double asked_mm);

/// One opened colour + depth pair. Frames come in order; depth drives, colour is the one shown at
/// its time.
class Media {
  public:
    virtual ~Media() = default;
    [[nodiscard]] virtual const MediaDescription& description() const = 0;
    /// The next frame, or nothing at the end. Throws InputError when the file breaks off.
    virtual std::optional<RawFrame> next() = 0;
    /// The next frame at `earliest_s` or later, or the last one; where those before it need not be
    /// made they are only decoded.
    virtual std::optional<RawFrame> next_from(double earliest_s);
    /// The next frame returned is the one shown at `media_s`.
    virtual void seek(double media_s) = 0;
    /// The next frame returned is one near it, as soon as one can be had; where that is no sooner,
    /// the one itself.
    virtual void seek_near(double media_s) { seek(media_s); }
    /// Where its frames come from as they happen: next() waits for them, and seek() does nothing.
    /// Null: it is read from files.
    [[nodiscard]] virtual std::shared_ptr<LiveFeed> live() const { return nullptr; }
};

/// Opens a pair, each of them a file, a folder, a list or a pattern of pictures, or live (see
/// live_name()). An empty colour
/// path: the depth alone, shown in colours of its own. An empty depth path, or the colour's: the
/// depth is in the same place, another track of the colour's file where that says so, or else a
/// file beside it. What was chosen before and does not fit the files any more is passed over, which
/// the notice says. Throws InputError: what, which file, what to do next.
[[nodiscard]] std::unique_ptr<Media> open_media(const std::filesystem::path& colour,
                                                const std::filesystem::path& depth = {},
                                                const DepthRequest& request = {});

/// Opens a depth video, a file's depth track, an image, or the depth of a folder, list or pattern
/// alone (`dibhr touch --depth`); its colour is empty.
[[nodiscard]] std::unique_ptr<Media> open_depth(const std::filesystem::path& place,
                                                const DepthRequest& request = {});

/// Describes what one place of any kind holds, without needing its partner (`dibhr info FILE`):
/// what is depth fills the depth fields, other files the colour fields, a place of both all of
/// them. Videos of up to a few thousand frames are read to their end, so that the numbers are
/// exact.
[[nodiscard]] MediaDescription describe_media(const std::filesystem::path& place,
                                              const DepthRequest& request = {.find_out = true});

}  // namespace dibhr
