// Reads files of plain 16-bit levels, whose size the picture beside them has.
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/still_picture.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kLevelBytes = 2;

/// The size of the picture beside the file that has its name, and as many pixels as the file
/// levels.
std::optional<ClaimedSize> size_beside(const fs::path& file) {
    constexpr std::array kEndings{".png", ".bmp", ".jpg", ".jpeg", ".tif", ".tiff"};
    const std::uint64_t bytes = size_of(file);
    for (const char* const ending : kEndings) {
        fs::path beside = file;
        beside.replace_extension(ending);
        if (!is_file(beside)) continue;
        std::ifstream in(beside, std::ios::binary);
        const auto size = claimed_size(in);
        if (size && may_be_decoded(size->columns, size->rows, kLevelBytes) &&
            static_cast<std::uint64_t>(size->columns * size->rows * kLevelBytes) == bytes)
            return size;
    }
    return std::nullopt;
}

}  // namespace

bool is_raw_levels(const fs::path& file, std::string_view /*head*/) {
    return lower_case(file.extension().string()) == ".raw" && size_beside(file).has_value();
}

StillPicture read_raw_levels(const fs::path& file, PictureRole role) {
    if (role == PictureRole::colour)
        throw InputError(shown(file) + " holds depth and no colours: give it as the depth file");
    const auto size = size_beside(file);
    if (!size) throw InputError(shown(file) + " has lost the picture beside it: copy both again");
    cv::Mat levels(static_cast<int>(size->rows), static_cast<int>(size->columns), CV_16UC1);
    const std::span<std::uint8_t> bytes(levels.ptr<std::uint8_t>(),
                                        levels.total() * levels.elemSize());
    std::ifstream in(file, std::ios::binary);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
        throw InputError(shown(file) + " is cut off or damaged: copy it or save it again");
    if (std::endian::native == std::endian::big) swap_bytes(bytes, kLevelBytes);
    return {levels, 16, "RAW"};
}

}  // namespace dibhr
