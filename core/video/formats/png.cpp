// Reads the PNG pictures that depth mostly comes in, without OpenCV's codecs: these load more than
// a hundred libraries, which takes longer than the picture.
#include <png.h>

#include <bit>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <vector>

#include "core/video/formats/still_picture.hpp"

namespace dibhr {

namespace {

/// Thrown through libpng's functions, in the place of its longjmp().
struct DamagedPng {};

[[noreturn]] void refuse_png(png_structp /*png*/, png_const_charp /*why*/) {
    throw DamagedPng{};
}

void ignore_png_warning(png_structp /*png*/, png_const_charp /*why*/) {}

struct CloseStream {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};

/// Each function throws DamagedPng.
class PngReader {
  public:
    explicit PngReader(std::FILE* stream)
        : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse_png,
                                      ignore_png_warning)) {
        info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_init_io(png_, stream);
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// Empty: a palette, transparency, few bits, or a photo that may have to be turned.
    [[nodiscard]] cv::Mat picture(PictureRole role) {
        png_read_info(png_, info_);
        const int kind = png_get_color_type(png_, info_);
        const int bits = png_get_bit_depth(png_, info_);
        const bool is_grey = kind == PNG_COLOR_TYPE_GRAY;
        const bool is_plain = (is_grey || kind == PNG_COLOR_TYPE_RGB) && bits >= 8;
        if (!is_plain || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) return {};
        const bool is_depth = role == PictureRole::depth;
        convert(is_grey, bits, is_depth);
        cv::Mat picture(
            static_cast<int>(png_get_image_height(png_, info_)),
            static_cast<int>(png_get_image_width(png_, info_)),
            CV_MAKETYPE(is_depth && bits == 16 ? CV_16U : CV_8U, is_depth && is_grey ? 1 : 3));
        if (png_get_rowbytes(png_, info_) != picture.step[0]) return {};
        std::vector<png_bytep> rows;
        for (int j = 0; j < picture.rows; ++j) rows.push_back(picture.ptr(j));
        png_read_image(png_, rows.data());
        png_read_end(png_, info_);
        return may_be_turned() ? cv::Mat() : picture;
    }

  private:
    /// As OpenCV does: depth keeps its bits and channels, colour becomes 8-bit BGR.
    void convert(bool is_grey, int bits, bool is_depth) {
        if (bits == 16 && !is_depth)
            png_set_strip_16(png_);
        else if (bits == 16 && std::endian::native == std::endian::little)
            png_set_swap(png_);
        if (!is_grey)
            png_set_bgr(png_);
        else if (!is_depth)
            png_set_gray_to_rgb(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
    }

    [[nodiscard]] bool may_be_turned() const {
#ifdef PNG_eXIf_SUPPORTED
        return png_get_valid(png_, info_, PNG_INFO_eXIf) != 0;
#else
        return false;
#endif
    }

    png_structp png_;
    png_infop info_{nullptr};
};

}  // namespace

cv::Mat read_plain_png(const std::filesystem::path& file, PictureRole role) {
    const std::unique_ptr<std::FILE, CloseStream> stream(std::fopen(file.c_str(), "rbe"));
    if (!stream) return {};
    try {
        return PngReader(stream.get()).picture(role);
    } catch (const DamagedPng&) {
        return {};
    }
}

}  // namespace dibhr
