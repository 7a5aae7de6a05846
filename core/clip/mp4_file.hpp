// An MP4 file of one video track, from packets.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/av/track_file.hpp"

namespace dibhr {

/// Where the index is: in pieces, so that what is written plays however it ends; or whole at the
/// begin, as players and browsers like it best.
enum class Mp4Index { in_pieces, at_begin };

class Mp4File {
  public:
    /// Writes over the file. Throws InputError.
    Mp4File(const std::filesystem::path& file, const AVCodecParameters& coded, Mp4Index index);

    /// Takes the packet's content; its times are in 1/kTrackUnitsPerSecond s. It lasts until the
    /// next one, and is written then. Throws InputError, e.g. when the disk is full.
    void write(AVPacket& packet);
    /// The last one lasts until then. Throws InputError.
    void finish(std::int64_t end_ms);

    /// Whether the file, as it is now, has pictures: those of its finished pieces.
    [[nodiscard]] bool plays() const noexcept { return file_.holds_packets(); }

  private:
    void write_held(std::int64_t until_ms);

    TrackFile file_;
    AvOwned<AVPacket> held_{new_packet()};
    bool holds_packet_{false};
};

/// A copy of a finished one, its index at the begin: the same pictures at the same times. Throws
/// InputError, also where the last picture that is read is not that of `last_ms`.
void copy_with_index_at_begin(const std::filesystem::path& from, const std::filesystem::path& to,
                              std::int64_t last_ms, std::int64_t end_ms);

}  // namespace dibhr
