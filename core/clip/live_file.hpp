// One track of what was live, as a Matroska file that plays however it ends; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/clip/picture_encoder.hpp"
#include "core/clip/summed_file.hpp"
#include "core/video/frame_window.hpp"
#include "core/video/live/live_record.hpp"

struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVPacket;

namespace dibhr {

/// Times are in 1/kClipTimeBase s.
class LiveFile {
  public:
    /// `tags`: what is said of the track. Writes over the file. Throws InputError.
    LiveFile(const std::filesystem::path& file, const AVCodecContext& codec,
             const std::map<std::string, std::string>& tags);

    /// Takes the packet's content. Throws InputError, e.g. when the disk is full.
    void write(AVPacket& packet);
    /// What it holds then, if that is known.
    std::optional<FileContent> finish();

  private:
    SummedFile file_;  // before what writes to it
    std::unique_ptr<AVFormatContext, void (*)(AVFormatContext*)> format_;
};

/// Pictures of one form, every bit: FFVHUFF, whose pictures take a sixth to a twelfth of the time
/// that FFV1's take, and a tenth to a fifth more room.
class ExactEncoder {
  public:
    /// Of such pictures. Throws InputError when libav cannot encode them.
    explicit ExactEncoder(const LiveLevels& first);
    explicit ExactEncoder(const ColourImage& first);
    ~ExactEncoder();
    ExactEncoder(const ExactEncoder&) = delete;
    ExactEncoder& operator=(const ExactEncoder&) = delete;

    /// Throws InputError where libav cannot encode it, or it is of another size.
    void encode(const LiveLevels& picture, std::int64_t shown_ms, const PictureEncoder::Sink& sink);
    void encode(const ColourImage& picture, std::int64_t shown_ms,
                const PictureEncoder::Sink& sink);
    [[nodiscard]] const AVCodecContext& codec() const { return *codec_; }

  private:
    void open(int pixel_format, int columns, int rows, const char* prediction);
    void require_of_size(int columns, int rows);
    void send(std::int64_t shown_ms, const PictureEncoder::Sink& sink);

    struct Free {
        void operator()(AVCodecContext* codec) const;
        void operator()(AVFrame* frame) const;
        void operator()(AVPacket* packet) const;
    };
    std::unique_ptr<AVCodecContext, Free> codec_{};
    std::unique_ptr<AVFrame, Free> frame_{};
    std::unique_ptr<AVPacket, Free> packet_{};
};

}  // namespace dibhr
