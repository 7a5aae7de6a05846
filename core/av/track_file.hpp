// The one muxer: the packets of a video track, written to a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/av/objects.hpp"

namespace dibhr {

struct TrackFileForm {
    const char* format{"matroska"};                ///< libav's name of it
    std::map<std::string, std::string> options{};  ///< of the format
    std::map<std::string, std::string> tags{};     ///< of the track, stored in the file
    AVIOContext* bytes{nullptr};  ///< the caller's output for the bytes; null: the file itself
    std::string subject{};        ///< begin of a failure's sentence, as "the video "
};

/// Writes every packet at once. A file that is not finished stays as it is. Every call that writes
/// throws InputError, e.g. when the disk is full.
class TrackFile {
  public:
    /// Overwrites the file.
    TrackFile(const std::filesystem::path& file, const AVCodecParameters& coded,
              const TrackFileForm& form);

    /// The next packet, its times in 1/kTrackUnitsPerSecond s.
    void write(AVPacket& packet);
    void finish();

    /// Whether the file, as it is now, holds more than its header.
    [[nodiscard]] bool holds_packets() const noexcept;

  private:
    AvOwned<AVFormatContext> format_;
    std::string subject_;
    std::int64_t head_bytes_{0};
};

}  // namespace dibhr
