// libav's objects: their owners, their options, and its failures as text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct AVCodecContext;
struct AVCodecParameters;
struct AVDictionary;
struct AVFormatContext;
struct AVFrame;
struct AVIOContext;
struct AVPacket;
struct SwsContext;

namespace dibhr {

/// Frees each object as libav does. A format also closes its file, finished or not, unless the
/// bytes have an owner of their own (AVFMT_FLAG_CUSTOM_IO).
struct AvFree {
    void operator()(AVCodecContext* codec) const noexcept;
    void operator()(AVCodecParameters* coded) const noexcept;
    void operator()(AVFormatContext* format) const noexcept;
    void operator()(AVFrame* frame) const noexcept;
    void operator()(AVIOContext* bytes) const noexcept;
    void operator()(AVPacket* packet) const noexcept;
    void operator()(SwsContext* scaler) const noexcept;
};

template <typename Object>
using AvOwned = std::unique_ptr<Object, AvFree>;

/// Never null. Throws std::bad_alloc.
[[nodiscard]] AvOwned<AVFrame> new_frame();
[[nodiscard]] AvOwned<AVPacket> new_packet();

/// Allocates memory for a picture of that AVPixelFormat, with padding after each row and after the
/// last one: the scaler reads and writes whole vectors. A frame of that size keeps its memory.
/// Throws std::bad_alloc.
void allocate_buffer(AVFrame& frame, int pixel_format, int columns, int rows);

/// Options by name: of one object, or the same ones for each of `count` objects.
class AvOptions {
  public:
    explicit AvOptions(std::size_t count = 1) : dictionaries_(count, nullptr) {}
    ~AvOptions();
    AvOptions(const AvOptions&) = delete;
    AvOptions& operator=(const AvOptions&) = delete;

    void set(const std::string& key, const std::string& value);
    /// `count` dictionaries; libav leaves unknown options in them.
    [[nodiscard]] AVDictionary** data() noexcept { return dictionaries_.data(); }

  private:
    std::vector<AVDictionary*> dictionaries_;
};

/// libav's name for a file: absolute and with its protocol, so that a colon in the file's name
/// begins no other protocol.
[[nodiscard]] std::string url_of(const std::filesystem::path& file);

/// libav's text for a negative result: "File too large".
[[nodiscard]] std::string reason_of(int error);

/// Throws InputError where libav's result is negative: "the video cannot be written (No space left
/// on device); make room for it, or choose another place", where `subject` is "the video ".
void require_written(int result, const std::string& subject = {});

}  // namespace dibhr
