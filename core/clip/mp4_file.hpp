// Writes an MP4 file of one video track, from packets.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/av/track_file.hpp"

namespace dibhr {

/// Where the index is: in pieces, so that an unfinished file plays; or whole at the begin, where
/// players and browsers need it to start quickly.
enum class Mp4Index { in_pieces, at_begin };

class Mp4File {
  public:
    /// Overwrites the file. Throws InputError.
    Mp4File(const std::filesystem::path& file, const AVCodecParameters& coded, Mp4Index index);

    /// Moves the content out of the packet, whose times are in 1/kTrackUnitsPerSecond s. It lasts
    /// until the next one, and is written then. Throws InputError, e.g. when the disk is full.
    void write(AVPacket& packet);
    /// The last packet lasts until `end_ms`. Throws InputError.
    void finish(std::int64_t end_ms);

    /// Whether the file has pictures now, in finished pieces.
    [[nodiscard]] bool plays() const noexcept { return file_.holds_packets(); }

  private:
    void write_held(std::int64_t until_ms);

    TrackFile file_;
    AvOwned<AVPacket> held_{new_packet()};
    bool holds_packet_{false};
};

/// Copies a finished file, with the index at the begin: the same pictures at the same times. Throws
/// InputError, also when the last picture read is not that of `last_ms`.
void copy_with_index_at_begin(const std::filesystem::path& from, const std::filesystem::path& to,
                              std::int64_t last_ms, std::int64_t end_ms);

}  // namespace dibhr
