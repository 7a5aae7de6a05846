// One track of a live source, as a Matroska file that plays however it ends; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/av/track_encoder.hpp"
#include "core/av/track_file.hpp"
#include "core/clip/summed_file.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_record.hpp"

namespace dibhr {

/// Pictures of one form, every bit: FFVHUFF, whose pictures take a sixth to a twelfth of the time
/// that FFV1's take, and a tenth to a fifth more room.
class LiveTrack {
  public:
    /// Of such pictures. `tags`: what the file says of the track. Writes over the file. Throws
    /// InputError, also when libav cannot encode such pictures.
    LiveTrack(const std::filesystem::path& file, const LiveLevels& first,
              const std::map<std::string, std::string>& tags);
    LiveTrack(const std::filesystem::path& file, const ColourImage& first);

    /// Throws InputError where libav cannot encode the picture, it is of another size than the
    /// first one, or e.g. the disk is full.
    void add(const LiveLevels& picture, std::int64_t shown_ms);
    void add(const ColourImage& picture, std::int64_t shown_ms);
    /// What the file holds then, if that is known.
    std::optional<FileContent> finish();

  private:
    LiveTrack(const std::filesystem::path& file, TrackEncoder encoder,
              const std::map<std::string, std::string>& tags);

    AVFrame& frame_of(int columns, int rows);
    void write(std::int64_t shown_ms);

    TrackEncoder encoder_;
    SummedFile bytes_;  // before what writes to it
    TrackFile file_;
};

}  // namespace dibhr
