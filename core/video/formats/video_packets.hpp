// The packets of one video track of a file, through libavformat; for this room and core/clip.
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
    /// Of one of the file's video tracks, numbered from 0 (a cover picture is none). Not open when
    /// there is no such track, or when the file is of an unknown kind. Throws InputError when its
    /// pictures are beyond the bound.
    explicit VideoPackets(const std::filesystem::path& file, int track = 0);

    [[nodiscard]] bool is_open() const noexcept { return stream_ != nullptr; }
    [[nodiscard]] AVStream* stream() const noexcept { return stream_; }
    /// Pictures a second, as well as the file says it; 0: it does not.
    [[nodiscard]] double frames_per_s() const noexcept;
    /// As the container says; an estimate; 0: it does not.
    [[nodiscard]] std::int64_t frames() const noexcept;

    /// When the track begins, by the clock of its file [s], once a packet was read; NaN when that
    /// says nothing of another file's.
    [[nodiscard]] double start_s() const noexcept;

    /// What the file says of the track under that name; empty when nothing.
    [[nodiscard]] std::string tag(const char* name) const;
    /// The content of a file of that name that is attached to this one; empty when there is none.
    [[nodiscard]] std::string attachment(std::string_view name) const;

    /// The next packet of the track, the reader's until the next call; null at the end.
    [[nodiscard]] AVPacket* next() noexcept;
    /// To the key frame at or before the time [s]; false where the file cannot jump.
    bool jump(double time_s) noexcept;
    /// When that key frame is shown, as far as the file's index tells [s].
    [[nodiscard]] std::optional<double> key_frame_s(double time_s) const noexcept;

    /// From the track's beginning [s]; NaN for no time stamp.
    [[nodiscard]] double seconds(std::int64_t stamp) const noexcept;

  private:
    [[nodiscard]] double unit_s() const noexcept;  ///< of a time stamp
    [[nodiscard]] double length_s() const noexcept;
    [[nodiscard]] std::int64_t start() const noexcept;

    AvOwned<AVFormatContext> context_;
    AvOwned<AVPacket> packet_{new_packet()};
    AVStream* stream_{nullptr};                    // the context's
    bool alone_{false};                            // no other track of video has the same clock
    std::optional<std::int64_t> first_decoded_{};  // the stamp by which the first packet is decoded
};

/// When the last frame of the track ends, as far as its packets are whole, counted from the track's
/// beginning [s]; looked for from `from_s` on, and from the beginning where that finds
/// none. Nothing when the file cannot be opened, its packets have no times, or the end is too far
/// to look for.
[[nodiscard]] std::optional<double> packets_end_s(const std::filesystem::path& file, int track,
                                                  double from_s);

/// What a file says of one of its video tracks.
struct VideoTrack {
    std::string title{};
    bool grey{false};  ///< coded without colours
    int bits{8};       ///< of a level
};

/// In their order; none when the file is of an unknown kind.
[[nodiscard]] std::vector<VideoTrack> video_tracks(const std::filesystem::path& file);

}  // namespace dibhr
