// What the names of files and folders say: a picture, colour or depth, and which belong together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// The text with A to Z as a to z.
[[nodiscard]] std::string lower_case(std::string text);

/// Whether there is a folder of that name.
[[nodiscard]] bool is_folder(const std::filesystem::path& place);

/// Whether the name ends as a picture's does.
[[nodiscard]] bool named_picture(const std::filesystem::path& file);

/// Whether the file's name says that it holds colour, or depth.
[[nodiscard]] bool named_colour(const std::filesystem::path& file);
[[nodiscard]] bool named_depth(const std::filesystem::path& file);

/// The depth file that belongs to a colour file: `*color*` -> `*depth*` (also colour, rgb) beside
/// it. Nothing when there is none; `looked_for` then says what was tried, for the message.
[[nodiscard]] std::optional<std::filesystem::path> find_depth_beside(
    const std::filesystem::path& colour, std::string& looked_for);

/// The colour file that belongs to a depth file, likewise: `*depth*` -> `*color*`, `*colour*`,
/// `*rgb*`.
[[nodiscard]] std::optional<std::filesystem::path> find_colour_beside(
    const std::filesystem::path& depth);

}  // namespace dibhr
