// One track of what was live, as a Matroska file that plays however it ends; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/clip/picture_encoder.hpp"
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
    void finish();

  private:
    std::unique_ptr<AVFormatContext, void (*)(AVFormatContext*)> format_;
};

/// Levels of depth, every bit: FFVHUFF, whose pictures take a twelfth of the time that FFV1's take,
/// and a fifth more room.
class LevelsEncoder {
  public:
    /// Of such pictures. Throws InputError when libav cannot encode them.
    explicit LevelsEncoder(const LiveLevels& first);
    ~LevelsEncoder();
    LevelsEncoder(const LevelsEncoder&) = delete;
    LevelsEncoder& operator=(const LevelsEncoder&) = delete;

    void encode(const LiveLevels& picture, std::int64_t shown_ms, const PictureEncoder::Sink& sink);
    [[nodiscard]] const AVCodecContext& codec() const { return *codec_; }

  private:
    struct Free {
        void operator()(AVCodecContext* codec) const;
        void operator()(AVFrame* frame) const;
        void operator()(AVPacket* packet) const;
    };
    std::unique_ptr<AVCodecContext, Free> codec_;
    std::unique_ptr<AVFrame, Free> frame_;
    std::unique_ptr<AVPacket, Free> packet_;
};

}  // namespace dibhr
