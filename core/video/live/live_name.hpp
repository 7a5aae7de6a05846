// Names of live sources: a camera, a network stream, a pipe, libav's generated pictures.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dibhr {

enum class LiveKind {
    camera,    ///< v4l2:/dev/video2, or /dev/video2
    network,   ///< rtsp, rtp, udp, srt, tcp, http, https
    pipe,      ///< pipe:NAME, or - for standard input
    generated  ///< lavfi:SPEC
};

/// How libav opens a live source.
struct LiveName {
    LiveKind kind{LiveKind::network};
    std::string url{};      ///< libav's URL; of a pipe the file, empty for standard input
    std::string format{};   ///< libav's input device; empty: libav detects it
    std::string allowed{};  ///< the only protocols that libav may use
    std::map<std::string, std::string> options{};  ///< of the input
};

/// Whether a name is of a live source. Uses no network and no disk, except to check whether
/// /dev/videoN is a device.
[[nodiscard]] bool is_live(const std::filesystem::path& place);

/// The name as others may read it: without a user and a password before the host.
[[nodiscard]] std::string public_name(const std::filesystem::path& place);
/// The same as the window shows it: "-" is "standard input".
[[nodiscard]] std::string shown_source(const std::filesystem::path& place);

/// A camera's name may end with `?size=640x480&rate=30`. Throws InputError for any other name, and
/// for a stream without the port that it needs.
[[nodiscard]] LiveName live_name(const std::filesystem::path& place);

/// Whether the protocol tells the sender that the receiver has left: silence may then be a pause.
[[nodiscard]] bool keeps_connection(const LiveName& name);

/// Whether the host of a stream's name exists; asks the name server and waits for it.
[[nodiscard]] bool has_known_host(const LiveName& name);

}  // namespace dibhr
