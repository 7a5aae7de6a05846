// What the names of files and folders say: a picture, colour or depth, and which belong together.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dibhr {

/// How names of pictures and of videos end: ".png", in small letters.
[[nodiscard]] std::span<const std::string_view> picture_endings() noexcept;
[[nodiscard]] std::span<const std::string_view> video_endings() noexcept;

/// Whether the name ends as a picture's does.
[[nodiscard]] bool named_picture(const std::filesystem::path& file);

/// Whether the name ends as a video's does.
[[nodiscard]] bool named_video(const std::filesystem::path& file);

/// Whether the name of the file or folder says that it holds colour: color, colour, rgb, albedo,
/// diffuse.
[[nodiscard]] bool named_colour(const std::filesystem::path& file);
/// Likewise depth: depth, disparity, displacement, heightmap; disp and height as words of their
/// own.
[[nodiscard]] bool named_depth(const std::filesystem::path& file);
/// Whether the name is one that colour has beside depth, and anything elsewhere: image, img, left
/// (the view that a disparity is of).
[[nodiscard]] bool may_name_colour(const std::filesystem::path& file);

/// What is left of a name without its ending and the words that say colour or depth, in small
/// letters: files of the same belong together ("take2_color.mp4" and "Take2-Depth.mkv": "take 2").
[[nodiscard]] std::string subject_of(const std::filesystem::path& file);

/// The depth file that belongs to a colour file: `*color*` -> `*depth*` (also colour, rgb, ...)
/// beside it, or else one of depth of the same subject. Nothing when there is none; `looked_for`
/// then says what was tried, for the message.
[[nodiscard]] std::optional<std::filesystem::path> find_depth_beside(
    const std::filesystem::path& colour, std::string& looked_for);

/// The colour file that belongs to a depth file, likewise: `*depth*` -> `*color*`, `*colour*`,
/// `*rgb*`, ...
[[nodiscard]] std::optional<std::filesystem::path> find_colour_beside(
    const std::filesystem::path& depth);

}  // namespace dibhr
