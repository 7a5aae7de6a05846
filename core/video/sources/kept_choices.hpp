// Keeps what the user chose for the depth of a file until it is opened again, without a file
// beside it.
#pragma once

#include <filesystem>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Where in `folder` the choice for a file or folder is kept: NAME-DIGITS.toml; the digits are a
/// hash of the whole path.
[[nodiscard]] std::filesystem::path kept_choice_of(const std::filesystem::path& folder,
                                                   const std::filesystem::path& media);

/// Replaces the kept choice for `media`, whole or not at all; an empty statement removes it. Throws
/// InputError.
void keep_choice(const std::filesystem::path& folder, const std::filesystem::path& media,
                 const DepthStatement& choice);

/// The request, whose panel statement is completed by the kept choice for that media. Throws
/// InputError for a kept file that cannot be parsed.
[[nodiscard]] DepthRequest with_kept_choice(DepthRequest request,
                                            const std::filesystem::path& media);

}  // namespace dibhr
