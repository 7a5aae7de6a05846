// Finds the colour and the depth pictures in any given files; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/video/depth/findings.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/layouts/data_sets.hpp"

namespace dibhr {

class LiveFeed;
struct Reader;

/// The sources found, and what was found out on the way.
struct Sources {
    std::unique_ptr<PictureSource> depth{};   ///< null: only of find_content(), colour alone
    std::unique_ptr<PictureSource> colour{};  ///< null: depth alone
    Findings findings{};                      ///< beside those of the depth's source
    const Reader* reader{nullptr};            ///< that took the depth's file; null: live
    KnownDataSet data_set{};                  ///< of the depth
    int depth_track{0};                       ///< track number in a video
    std::string notice{};                     ///< see MediaDescription
    std::shared_ptr<LiveFeed> live{};         ///< feed of live sources; null: files
    /// Why the colours of its depth are no depth, in one line; empty: they are. Levels as in the
    /// file (DepthRequest::find_out false) are their brightness all the same.
    std::string not_depth{};
};

/// Finds colour and depth for the given places. Empty `depth`, or the colour's place again: both in
/// one place, depth beside it, or depth alone. The statement may give packing and code. Throws
/// InputError when there is no depth.
[[nodiscard]] Sources find_sources(const std::filesystem::path& colour,
                                   const std::filesystem::path& depth,
                                   const DepthStatement& statement);

/// The depth in a place, without the colour.
[[nodiscard]] Sources find_depth(const std::filesystem::path& place,
                                 const DepthStatement& statement);

/// The content of a place: colour, depth or both; ignores files beside it.
[[nodiscard]] Sources find_content(const std::filesystem::path& place,
                                   const DepthStatement& statement);

}  // namespace dibhr
