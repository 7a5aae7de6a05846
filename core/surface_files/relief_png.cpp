// Writes a surface as a grey picture of 16 bits, row by row through libpng.
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/surface_files/pieces.hpp"

namespace dibhr {

namespace {

constexpr double kHighestGrey = 65535.0;

[[noreturn]] void fail(png_structp /*png*/, png_const_charp why) {
    throw InputError(std::string("the relief cannot be written as PNG (") + why +
                     "): choose another form, such as .pfm");
}

void ignore_warning(png_structp /*png*/, png_const_charp /*why*/) {}

void take(png_structp png, png_bytep bytes, std::size_t count) {
    auto& taken = *static_cast<std::string*>(png_get_io_ptr(png));
    taken.append(reinterpret_cast<const char*>(bytes), count);
}

void flush_nothing(png_structp /*png*/) {}

/// libpng's writer, with a buffer before the file. An error leaves libpng as an exception.
class PngWriter {
  public:
    explicit PngWriter(OutputFile& file)
        : file_(file),
          png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore_warning)) {
        info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
        constexpr auto kAnySize = static_cast<png_uint_32>(std::numeric_limits<png_int_32>::max());
        png_set_user_limits(png_, kAnySize, kAnySize);
        png_set_write_fn(png_, &waiting_, take, flush_nothing);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    void begin(const ExportedSurface& exported) {
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(exported.surface.columns()),
                     static_cast<png_uint_32>(exported.surface.rows()), 16, PNG_COLOR_TYPE_GRAY,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        const auto pixels_per_m =
            static_cast<png_uint_32>(std::lround(1000.0 / exported.pixel_pitch_mm));
        png_set_pHYs(png_, info_, pixels_per_m, pixels_per_m, PNG_RESOLUTION_METER);
        add_text("Relief", scale_of(exported));
        png_write_info(png_, info_);
        send();
    }
    void add_row(const std::vector<png_byte>& row) {
        png_write_row(png_, row.data());
        send();
    }
    void end() {
        png_write_end(png_, info_);
        send();
    }

  private:
    static std::string scale_of(const ExportedSurface& exported) {
        const double ceiling_px = exported.surface.ceiling();
        return "0: 0 px; 65535: " + short_text(ceiling_px) + " px, " +
               short_text(ceiling_px * exported.pixel_pitch_mm) +
               " mm; a pixel: " + short_text(exported.pixel_pitch_mm) + " mm";
    }

    void add_text(std::string keyword, std::string words) {
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = keyword.data();
        text.text = words.data();
        png_set_text(png_, info_, &text, 1);
    }

    void send() {
        file_.write(waiting_);
        waiting_.clear();
    }

    OutputFile& file_;
    std::string waiting_{};
    png_structp png_;
    png_infop info_{nullptr};
};

/// One row of greys, big-endian as in PNG.
void grey_row(const DepthSurface& surface, int j, std::vector<png_byte>& row) {
    const double ceiling_px = surface.ceiling();
    const double greys_per_px = ceiling_px > 0.0 ? kHighestGrey / ceiling_px : 0.0;
    row.clear();
    for (int i = 0; i < surface.columns(); ++i) {
        const double grey = std::clamp(written_px(surface, i, j) * greys_per_px, 0.0, kHighestGrey);
        const auto whole = static_cast<unsigned>(std::lround(grey));
        row.push_back(static_cast<png_byte>(whole >> 8U));
        row.push_back(static_cast<png_byte>(whole & 0xFFU));
    }
}

}  // namespace

void write_relief_png(const ExportedSurface& exported, OutputFile& file) {
    PngWriter png(file);
    png.begin(exported);
    std::vector<png_byte> row;
    for (int j = 0; j < exported.surface.rows(); ++j) {
        grey_row(exported.surface, j, row);
        png.add_row(row);
    }
    png.end();
}

}  // namespace dibhr
