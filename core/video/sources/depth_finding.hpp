// Finds out what the levels of a source mean: merges all statements on it; inside the room.
#pragma once

#include <filesystem>
#include <vector>

#include "core/video/depth/depth_scale.hpp"
#include "core/video/depth/findings.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// The statement on depth before a file is opened. For each fact the strongest source counts: the
/// request, the kept choice for the depth's place, then the sidecars of that place and of the
/// colour's, which may be empty. Throws InputError for a file that cannot be parsed.
[[nodiscard]] DepthStatement statement_for(const std::filesystem::path& depth,
                                           const std::filesystem::path& colour,
                                           const DepthRequest& request);

/// The rows of the name of a source, else of the folder that holds its pictures, else of the one
/// that was opened. A name that only says "depth" leaves the unit to the folders.
[[nodiscard]] Findings findings_by_name(const SourceFacts& facts);

/// The scale of a depth, and the findings that led to its meaning.
struct FoundScale {
    DepthScale scale;
    DepthConclusion conclusion{};
};

/// The meaning of the levels, found before the first frame is shown: the one place where all
/// findings are collected and concluded from. Reads pictures from all over the depth, then starts
/// it again. Throws InputError for a sidecar that cannot be parsed, and for an impossible range.
[[nodiscard]] FoundScale find_scale(Sources& sources, const DepthRequest& request);

/// As many sample pictures of a source as can be decoded within about half a second.
[[nodiscard]] std::vector<cv::Mat> sample_pictures(PictureSource& source);

}  // namespace dibhr
