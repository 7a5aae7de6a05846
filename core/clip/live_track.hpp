// Writes a track of a live source as a Matroska file that plays after a crash; inside the room.
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

/// Encodes pictures without loss by FFVHUFF: it takes a sixth to a twelfth of FFV1's time, and a
/// tenth to a fifth more space.
class LiveTrack {
  public:
    /// For pictures like `first`. `tags`: metadata of the track. Overwrites the file. Throws
    /// InputError, also when libav cannot encode such pictures.
    LiveTrack(const std::filesystem::path& file, const LiveLevels& first,
              const std::map<std::string, std::string>& tags);
    LiveTrack(const std::filesystem::path& file, const ColourImage& first);

    /// Throws InputError when libav cannot encode the picture, its size differs from the first, or
    /// e.g. the disk is full.
    void add(const LiveLevels& picture, std::int64_t shown_ms);
    void add(const ColourImage& picture, std::int64_t shown_ms);
    /// Size and hash of the finished file, if known.
    std::optional<FileContent> finish();

  private:
    LiveTrack(const std::filesystem::path& file, TrackEncoder encoder,
              const std::map<std::string, std::string>& tags);

    AVFrame& frame_of(int columns, int rows);
    void write(std::int64_t shown_ms);

    TrackEncoder encoder_;
    SummedFile bytes_;  // declared before the writer that uses it
    TrackFile file_;
};

}  // namespace dibhr
