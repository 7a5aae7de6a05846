// Shares the memory of decoded frames with what draws them; inside the room.
#pragma once

#include <memory>

#include "core/av/objects.hpp"
#include "core/video/frames/video_picture.hpp"

namespace dibhr {

/// Shares the frames of one track.
class FrameSharer {
  public:
    FrameSharer();
    ~FrameSharer();
    FrameSharer(FrameSharer&&) noexcept;
    FrameSharer& operator=(FrameSharer&&) noexcept;

    /// Refers to the frame's memory, in a matrix and range as it states: ITU-R BT.601 and limited
    /// where it does not. Null for frames without luma, with transparency, in rare forms or
    /// matrices, which FramePictures converts. `pixel_aspect`: of the turned picture.
    [[nodiscard]] std::shared_ptr<const VideoPicture> picture(const AVFrame& frame,
                                                              int quarter_turns,
                                                              double pixel_aspect);

  private:
    class Converter;
    std::shared_ptr<Converter> converter_;
};

}  // namespace dibhr
