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

/// The same for a person's answer that holds for all files of the folder of `media`: a file named
/// FOLDER-files-DIGITS.toml. It counts for those that leave open what it states, and beats no
/// sidecar.
[[nodiscard]] std::filesystem::path kept_folder_choice_of(const std::filesystem::path& folder,
                                                          const std::filesystem::path& media);
void keep_folder_choice(const std::filesystem::path& folder, const std::filesystem::path& media,
                        const DepthStatement& choice);

/// The kept answer for the files of the folder of `media`; empty: there is none. Throws InputError
/// for a kept file that cannot be parsed.
[[nodiscard]] DepthStatement kept_folder_choice(const DepthRequest& request,
                                                const std::filesystem::path& media);

/// The request, whose panel statement is completed by the kept choice for that media, unless it is
/// whole. Throws InputError for a kept file that cannot be parsed.
[[nodiscard]] DepthRequest with_kept_choice(DepthRequest request,
                                            const std::filesystem::path& media);

}  // namespace dibhr
