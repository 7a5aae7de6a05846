// Depth that is packed into pictures, still or moving, as a source of its own: beside colour in the
// halves of a picture, or coded as colours; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// How one picture holds both.
struct PackedForm {
    DepthPacking packing{DepthPacking::left_right};  ///< one of the four of halves
    bool half_size{false};  ///< halves are squeezed to half of their width, or of their height
    std::optional<HueCode> hue{};  ///< how depth is coded by hue; nothing: by brightness
    DepthStatement known{};        ///< what else the file's own metadata says of its depth
    std::string known_from{};      ///< where it says so; empty: nowhere
    cv::Size intrinsics_size{};  ///< of the depth picture that known.intrinsics are of; 0: its own
};

/// The pictures of a source of colours as depth of real numbers: metres where the code says the
/// range, else hue, of which red is near. Not finite: no data. `known_from`: who says so.
[[nodiscard]] std::unique_ptr<PictureSource> hue_decoded(std::unique_ptr<PictureSource> colours,
                                                         HueCode code, std::string known_from);

/// The pictures of such a source as ramp_levels().
[[nodiscard]] std::unique_ptr<PictureSource> ramp_decoded(std::unique_ptr<PictureSource> colours,
                                                          std::string known_from);

/// Whether colour and depth are the halves of one picture.
[[nodiscard]] bool is_of_halves(DepthPacking packing) noexcept;

/// The part of a picture that is colour, or depth; of an odd size the line between them belongs to
/// neither.
[[nodiscard]] cv::Rect half_of(cv::Size picture, DepthPacking packing, PictureRole role);

/// The halves of pictures that come from two sources of the same, which lead to each role;
/// `for_depth` in colours where depth is coded by hue. Packing and code are told as found. Throws
/// InputError when the halves are too small.
[[nodiscard]] Sources unpack(std::unique_ptr<PictureSource> for_colour,
                             std::unique_ptr<PictureSource> for_depth, const PackedForm& form);

/// A picture or a video file, or a folder of packed pictures. Depth that is coded by brightness
/// keeps every level that the file has. Each source reads and decodes the file for itself, as they
/// do where colour and depth are files of their own. Throws InputError, also when the halves are
/// too small.
[[nodiscard]] Sources open_packed(const std::filesystem::path& place, const PackedForm& form);

/// What a file's name says of halves in its pictures.
struct NamedPacking {
    DepthPacking packing{DepthPacking::left_right};
    bool half_size{false};
    bool says_depth{false};  ///< otherwise the halves may as well be an ordinary stereo pair

    bool operator==(const NamedPacking&) const = default;
};

/// By the endings that programs write: `_RGBD` and `_HRGBD` (nunif, Looking Glass; colour left),
/// `_LR`, `_SBS`, `_TB`, `_OU` and the like. Nothing when the name says nothing.
[[nodiscard]] std::optional<NamedPacking> packing_by_name(const std::filesystem::path& file);

}  // namespace dibhr
