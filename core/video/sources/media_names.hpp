// Tells by names of files and folders: picture or video, colour or depth, and which form a pair.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dibhr {

/// The endings of names of pictures and of videos, in small letters: ".png".
[[nodiscard]] std::span<const std::string_view> picture_endings() noexcept;
[[nodiscard]] std::span<const std::string_view> video_endings() noexcept;

/// The place by its name: that of a folder may end with a slash.
[[nodiscard]] std::filesystem::path without_slash(const std::filesystem::path& place);

/// Whether the name ends as a picture's does.
[[nodiscard]] bool named_picture(const std::filesystem::path& file);

/// Whether the name ends as a video's does.
[[nodiscard]] bool named_video(const std::filesystem::path& file);

/// What a name says that a file or folder holds besides colour and depth, for people: "a mask",
/// "confidence", "a painting of depth"; empty: nothing else. Its last word decides ("depth_mask",
/// not "mask_depth"), numbers left out.
[[nodiscard]] std::string_view named_other(const std::filesystem::path& file);
/// Likewise what has no depth to feel: all of these but previews and paintings.
[[nodiscard]] std::string_view named_no_depth(const std::filesystem::path& file);
/// Likewise by the name of its folder, which has no other words, of a file whose own name has only
/// numbers and words as frame: "confidence/0000.png".
[[nodiscard]] std::string_view folder_named_no_depth(const std::filesystem::path& file);

/// Whether its last word says that a picture of it serves as the colour: amplitude, intensity.
[[nodiscard]] bool named_brightness(const std::filesystem::path& file);

/// Whether the name of the file or folder says that it holds colour, and nothing else: color,
/// colour, rgb, albedo, diffuse, also in German, French, Spanish and Italian.
[[nodiscard]] bool named_colour(const std::filesystem::path& file);
/// Likewise depth: depth, disparity, disparities, displacement, heightmap; disp and height as words
/// of their own.
[[nodiscard]] bool named_depth(const std::filesystem::path& file);
/// Whether the name means colour only beside depth: image, img, im, frame, left (the view of a
/// disparity), src, source, input, original (what an estimator was given).
[[nodiscard]] bool may_name_colour(const std::filesystem::path& file);

/// Whether the name ends as that of an array or picture of numbers does, whose levels are not
/// painted: .npy, .npz, .pfm, .exr, .raw (see is_raw_levels()).
[[nodiscard]] bool named_numbers(const std::filesystem::path& file);

/// The file of numbers beside a file, of the same name but for its ending; nothing: none.
[[nodiscard]] std::optional<std::filesystem::path> numbers_beside(
    const std::filesystem::path& file);

/// The name without its ending and its words for colour or depth, in small letters. Files of the
/// same subject belong together ("take2_color.mp4" and "Take2-Depth.mkv": "take 2").
[[nodiscard]] std::string subject_of(const std::filesystem::path& file);

/// The depth that belongs to a colour file or folder, beside it: `*color*` -> `*depth*` (also
/// colour, rgb, ...), else depth of the same subject, else numbers of the same name; of several the
/// one of numbers. Beside a video this may be a folder of pictures, and beside a folder a video;
/// beside the only video it is the folder named depth. Nothing when there is none; `looked_for`
/// then lists the names that were tried, for the message; it is empty for a name without a word for
/// colour.
[[nodiscard]] std::optional<std::filesystem::path> find_depth_beside(
    const std::filesystem::path& colour, std::string& looked_for);

/// The colour that belongs to a depth file or folder, likewise: `*depth*` -> `*color*`, `*colour*`,
/// `*rgb*`, ...
[[nodiscard]] std::optional<std::filesystem::path> find_colour_beside(
    const std::filesystem::path& depth);

}  // namespace dibhr
