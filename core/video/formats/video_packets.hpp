// Reads the packets of one video track through libavformat; for this room and core/clip.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/av/objects.hpp"

struct AVStream;

namespace dibhr {

class VideoPackets {
  public:
    /// Opens one of the file's video tracks, numbered from 0 (cover pictures do not count). Not
    /// open when there is no such track, or when the file is of an unknown kind. Throws InputError
    /// when its pictures are beyond the bound.
    explicit VideoPackets(const std::filesystem::path& file, int track = 0);

    [[nodiscard]] bool is_open() const noexcept { return stream_ != nullptr; }
    [[nodiscard]] AVStream* stream() const noexcept { return stream_; }
    /// Pictures a second, as far as the file states it; 0: not stated.
    [[nodiscard]] double frames_per_s() const noexcept;
    /// Whether the container states how many frames there are, and its rate and duration agree.
    [[nodiscard]] bool counts_frames() const noexcept;
    /// The container's frame count, else an estimate; 0: not known.
    [[nodiscard]] std::int64_t frames() const noexcept;

    /// When the track begins by the clock of its file [s], known once a packet was read; NaN when
    /// that clock is not comparable with other files.
    [[nodiscard]] double start_s() const noexcept;

    /// The track's metadata of that name; empty when there is none.
    [[nodiscard]] std::string tag(const char* name) const;
    /// The content of the attachment of that name; empty when there is none.
    [[nodiscard]] std::string attachment(std::string_view name) const;

    /// The next packet of the track, valid until the next call; null at the end.
    [[nodiscard]] AVPacket* next() noexcept;
    /// Jumps to the key frame at or before the time [s]; false where the file cannot jump.
    bool jump(double time_s) noexcept;
    /// When that key frame is shown [s]; nothing: not in the file's index.
    [[nodiscard]] std::optional<double> key_frame_s(double time_s) const noexcept;

    /// From the track's beginning [s]; NaN for no time stamp.
    [[nodiscard]] double seconds(std::int64_t stamp) const noexcept;

  private:
    [[nodiscard]] double unit_s() const noexcept;  ///< of a time stamp
    [[nodiscard]] double length_s() const noexcept;
    [[nodiscard]] std::int64_t start() const noexcept;

    AvOwned<AVFormatContext> context_;
    AvOwned<AVPacket> packet_{new_packet()};
    AVStream* stream_{nullptr};                    // owned by the context
    bool only_track_{false};                       // the file's only video track
    std::optional<std::int64_t> first_decoded_{};  // decoding time stamp of the first packet
};

/// When the last frame with whole packets ends, from the track's beginning [s]. Searches from
/// `from_s` on, and from the beginning where that finds none. Nothing when the file cannot be
/// opened, its packets have no times, or there are too many packets to search.
[[nodiscard]] std::optional<double> packets_end_s(const std::filesystem::path& file, int track,
                                                  double from_s);

/// The earliest end of a whole file [s].
[[nodiscard]] double least_end_s(double header_duration_s);

/// Throws InputError for a truncated copy, whose header claims more than the file holds.
void require_whole(const std::filesystem::path& file, int track, double header_duration_s);

/// When the picture of each packet is shown, from the track's beginning, in the order of decoding
/// [s]; NaN: no time stamp. Leaves out packets whose picture is not shown. Empty when the file
/// cannot be opened, or holds too many packets. Reads the file to its end.
[[nodiscard]] std::vector<double> packet_times_s(const std::filesystem::path& file, int track);

/// What a file states about one of its video tracks.
struct VideoTrack {
    std::string title{};
    bool grey{false};  ///< coded without colours
    int bits{8};       ///< of a level
};

/// In the file's order; none when the file is of an unknown kind.
[[nodiscard]] std::vector<VideoTrack> video_tracks(const std::filesystem::path& file);

}  // namespace dibhr
