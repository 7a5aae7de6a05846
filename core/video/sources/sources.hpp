// Which pictures are colour and which are depth, in whatever files people bring; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/formats/picture_source.hpp"

namespace dibhr {

class LiveFeed;

/// What was chosen, and what that says of packing and code.
struct Sources {
    std::unique_ptr<PictureSource> depth{};   ///< null: of find_content(), colour alone
    std::unique_ptr<PictureSource> colour{};  ///< null: depth alone
    DepthStatement found{};                   ///< by files, names and metadata
    DepthStatement assumed{};                 ///< by how the pictures look
    bool by_look{false};                      ///< what the depth says of itself is so, too
    int depth_track{0};                       ///< of a video's
    std::string notice{};                     ///< see MediaDescription
    std::shared_ptr<LiveFeed> live{};         ///< where they come from; null: files
};

/// Of places as they were given; an empty depth, or the colour's place again: both in one place,
/// the depth beside it, or depth alone. `said`: of packing and code. Throws InputError when there
/// is no depth.
[[nodiscard]] Sources find_sources(const std::filesystem::path& colour,
                                   const std::filesystem::path& depth, const DepthStatement& said);

/// The depth in a place, without the colour.
[[nodiscard]] Sources find_depth(const std::filesystem::path& place, const DepthStatement& said);

/// What a place itself holds: colour, depth or both, whatever lies beside it.
[[nodiscard]] Sources find_content(const std::filesystem::path& place, const DepthStatement& said);

}  // namespace dibhr
