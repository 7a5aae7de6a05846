// Names of what is live: a camera, a stream from the network, a pipe, libav's made pictures.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dibhr {

enum class LiveKind {
    camera,   ///< v4l2:/dev/video2, or /dev/video2
    network,  ///< rtsp, rtp, udp, srt, tcp, http, https
    pipe,     ///< pipe:NAME, or - for standard input
    made      ///< lavfi:SPEC
};

/// How libav opens it.
struct LiveName {
    LiveKind kind{LiveKind::network};
    std::string url{};     ///< what is given to libav; of a pipe the file, empty for standard input
    std::string format{};  ///< libav's input device; empty: it looks
    std::string allowed{};                         ///< protocols, no others may be followed
    std::map<std::string, std::string> options{};  ///< of the input
};

/// Whether a place is named so. Looks at no network and no disk, but whether /dev/videoN is a
/// device.
[[nodiscard]] bool is_live(const std::filesystem::path& place);

/// The name as others may read it: without a user and a password before the host.
[[nodiscard]] std::string public_name(const std::filesystem::path& place);

/// Of a camera `?size=640x480&rate=30` may follow. Throws InputError for what names nothing, and
/// for a stream without the port that it needs.
[[nodiscard]] LiveName live_name(const std::filesystem::path& place);

/// Whether its sender notices when nobody listens any more: a silence there may be a pause.
[[nodiscard]] bool keeps_connection(const LiveName& name);

/// Whether the host of a network's name is found; asks the network, and waits for it.
[[nodiscard]] bool has_known_host(const LiveName& name);

}  // namespace dibhr
