// Unpacks depth from pictures or videos: from one half of each picture, or from depth coded as
// colours; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/video/depth/findings.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/level_code.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

struct PictureGuess;

/// How one picture holds colour and depth.
struct PackedForm {
    DepthPacking packing{DepthPacking::left_right};  ///< one of the four with halves
    int gap_px{0};                                   ///< between the halves
    bool half_size{false};  ///< halves are squeezed to half of their width, or of their height
    std::optional<HueCode> hue{};  ///< how depth is coded by hue; nothing: see `bytes`
    /// The code of depth in bytes; nothing: by brightness.
    std::optional<DepthCode> bytes{};
    Finding coded{};  ///< how the code is known
    /// How the packing is known, with other facts from there; without reason: a person states it.
    Finding finding{};
    cv::Size
        intrinsics_size{};  ///< of the picture that finding's intrinsics are of; 0: the depth's
};

/// The halves that pictures look to be packed in.
[[nodiscard]] PackedForm form_by_appearance(const PictureGuess& guess);

/// Evidence for a code but grey: the pictures decode by it, or a person states it.
[[nodiscard]] Finding finding_on_code(DepthCode code, bool is_stated);

/// Decodes the colours of a source to depth in real numbers: metres where the code has a range,
/// else hue, where red is near. Not finite: no data. `coded`: how the code is known; what the code
/// means in itself is added to it.
[[nodiscard]] std::unique_ptr<PictureSource> hue_decoded(std::unique_ptr<PictureSource> colours,
                                                         const HueCode& code, Finding coded);

/// Decodes the colours of a source by ramp_levels(), as they look.
[[nodiscard]] std::unique_ptr<PictureSource> ramp_decoded(std::unique_ptr<PictureSource> colours);

/// Whether a source has the bytes of red, green and blue in which the code has its numbers, and has
/// not lost the low ones by compression. Starts it again.
[[nodiscard]] bool may_hold_bytes(PictureSource& pictures, DepthCode code);

/// Decodes numbers in the bytes of a source's channels (byte_code.hpp): to levels of 16 bits, or to
/// real numbers. `pictures`: read as depth, so that every byte and alpha is kept. `coded`: as in
/// hue_decoded(). Throws InputError where they hold no such numbers, as after compression with
/// losses.
[[nodiscard]] std::unique_ptr<PictureSource> byte_decoded(std::unique_ptr<PictureSource> pictures,
                                                          DepthCode code, Finding coded);

/// Decodes levels that are no distances (level_code.hpp): to levels of 16 bits, or to real numbers.
/// `coded`: as in hue_decoded(). What other findings state about the file's own levels goes. Throws
/// InputError where the pictures have no such levels.
[[nodiscard]] std::unique_ptr<PictureSource> level_decoded(std::unique_ptr<PictureSource> pictures,
                                                           DepthCode code, const InverseLevels& law,
                                                           Finding coded);

/// Whether a source is one of these.
[[nodiscard]] bool has_decoded_levels(const SourceFacts& facts);

/// One line that refuses depth whose colours are no known code: what it is, and what to do.
/// `seen`: one of its pictures, 8-bit BGR, or empty.
[[nodiscard]] std::string refusal_of_colours(const SourceFacts& facts, const cv::Mat& seen);

/// Whether colour and depth are the halves of one picture.
[[nodiscard]] bool is_of_halves(DepthPacking packing) noexcept;

/// The half of a picture that is colour, or depth; of an odd size the middle line is in neither, as
/// the gap between them.
[[nodiscard]] cv::Rect half_of(cv::Size picture, DepthPacking packing, PictureRole role,
                               int gap_px = 0);

/// Splits the same pictures, read by two sources, into colour and depth. `for_depth` gives colours
/// where depth is coded by hue. Throws InputError when the halves are too small, or do not hold
/// depth of that code.
[[nodiscard]] Sources unpack(std::unique_ptr<PictureSource> for_colour,
                             std::unique_ptr<PictureSource> for_depth, const PackedForm& form);

/// Opens a picture, a video, or a folder of packed pictures. Depth coded by brightness keeps every
/// level. Each source reads and decodes the file itself, as where colour and depth are two files.
/// Throws InputError, also when the halves are too small.
[[nodiscard]] Sources open_packed(const std::filesystem::path& place, const PackedForm& form);

/// The packing that a file's name states.
struct NamedPacking {
    DepthPacking packing{DepthPacking::left_right};
    bool half_size{false};
    bool names_depth{false};  ///< false: the halves may be an ordinary stereo pair

    bool operator==(const NamedPacking&) const = default;
};

/// Reads the endings that programs write: `_RGBD` and `_HRGBD` (nunif, Looking Glass; colour left),
/// `_LR`, `_SBS`, `_TB`, `_OU` and the like. Nothing for a name without one.
[[nodiscard]] std::optional<NamedPacking> packing_by_name(const std::filesystem::path& file);

}  // namespace dibhr
