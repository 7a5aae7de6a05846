// What a person chose of a file's depth, kept for the next time it is opened without writing
// anything beside it.
#pragma once

#include <filesystem>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Where in the folder the choice for a file or folder is kept: NAME-DIGITS.toml, whose digits are
/// of its whole path.
[[nodiscard]] std::filesystem::path kept_choice_of(const std::filesystem::path& folder,
                                                   const std::filesystem::path& media);

/// Keeps what was chosen for `media`, whole or not at all, and forgets what was kept before; of a
/// statement that says nothing no file remains. Throws InputError.
void keep_choice(const std::filesystem::path& folder, const std::filesystem::path& media,
                 const DepthStatement& choice);

/// The request, with what is kept of that media as the panel's word on what the panel does not say.
/// Throws InputError for what cannot be understood.
[[nodiscard]] DepthRequest with_kept_choice(DepthRequest request,
                                            const std::filesystem::path& media);

}  // namespace dibhr
