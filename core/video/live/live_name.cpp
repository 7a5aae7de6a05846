// Splits names of live sources into kind, address and options.
#include "core/video/live/live_name.hpp"

#include <netdb.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

struct Scheme {
    std::string_view begin;
    std::string_view allowed;  ///< with the protocols below it
    bool needs_port;           ///< it has no standard port
    bool connected;            ///< the sender notices that the receiver has left
};

/// No protocol opens a file of this machine, whatever a playlist names.
constexpr std::array<Scheme, 8> kNetwork{
    {{"rtsp://", "rtsp,rtp,udp,tcp", false, true},
     {"rtsps://", "rtsp,rtsps,rtp,srtp,udp,tcp,tls,crypto", false, true},
     {"rtp://", "rtp,udp", true, false},
     {"udp://", "udp", true, false},
     {"srt://", "srt", true, true},
     {"tcp://", "tcp", true, true},
     {"http://", "http,tcp", false, true},
     {"https://", "https,http,tls,tcp,crypto", false, true}}};
constexpr std::string_view kCamera = "v4l2:";
constexpr std::string_view kPipe = "pipe:";
constexpr std::string_view kGenerated = "lavfi:";

const Scheme* network_scheme(std::string_view name) {
    const auto* const found =
        std::find_if(kNetwork.begin(), kNetwork.end(),
                     [name](const Scheme& scheme) { return name.starts_with(scheme.begin); });
    return found == kNetwork.end() ? nullptr : found;
}

bool is_camera_device(const std::filesystem::path& place) {
    if (!place.string().starts_with("/dev/video")) return false;
    std::error_code gone;
    return std::filesystem::is_character_file(place, gone);
}

/// Of the name of a network stream.
struct HostAndPort {
    std::string host{};
    std::string port{};  ///< empty: none
};

HostAndPort host_and_port(std::string_view name) {
    name.remove_prefix(std::min(name.find("://") + 3, name.size()));
    name = name.substr(0, name.find_first_of("/?"));
    if (const auto at = name.rfind('@'); at != std::string_view::npos) name.remove_prefix(at + 1);
    const auto bracket = name.find(']');  // of an IPv6 address
    const auto colon = name.find(':', bracket == std::string_view::npos ? 0 : bracket);
    HostAndPort found;
    if (colon != std::string_view::npos) found.port = name.substr(colon + 1);
    name = name.substr(0, colon);
    if (bracket != std::string_view::npos) name = name.substr(1, bracket - 1);
    found.host = name;
    return found;
}

void require_port(const std::string& name, const Scheme& scheme) {
    const std::string port = host_and_port(name).port;
    int number = 0;
    const auto [end, failed] = std::from_chars(port.data(), port.data() + port.size(), number);
    const bool whole = failed == std::errc{} && end == port.data() + port.size();
    if (port.empty() && !scheme.needs_port) return;
    if (whole && number >= 1 && number <= 65535) return;
    throw InputError(in_quotes(public_name(name)) +
                     (port.empty() ? " lacks a port" : " has no port from 1 to 65535") +
                     ": name it as in " + std::string(scheme.begin) + "127.0.0.1:5000");
}

/// "size=640x480&rate=30" as libav's options.
std::map<std::string, std::string> camera_options(std::string_view asked, const std::string& name) {
    std::map<std::string, std::string> options;
    while (!asked.empty()) {
        const std::string_view one = asked.substr(0, asked.find('&'));
        asked.remove_prefix(std::min(one.size() + 1, asked.size()));
        const auto equals = one.find('=');
        const std::string_view key = one.substr(0, equals);
        if (equals == std::string_view::npos || (key != "size" && key != "rate"))
            throw InputError(in_quotes(name) +
                             ": a camera takes size=640x480 and rate=30, with & between them");
        options[key == "size" ? "video_size" : "framerate"] = one.substr(equals + 1);
    }
    return options;
}

LiveName camera(const std::string& name, std::string_view device) {
    const auto question = device.find('?');
    LiveName live{.kind = LiveKind::camera,
                  .url = std::string(device.substr(0, question)),
                  .format = "video4linux2",
                  .allowed = "file"};
    if (question != std::string_view::npos)
        live.options = camera_options(device.substr(question + 1), name);
    return live;
}

}  // namespace

bool is_live(const std::filesystem::path& place) {
    const std::string& name = place.native();
    const std::string_view begin = name;
    return name == "-" || begin.starts_with(kCamera) || begin.starts_with(kPipe) ||
           begin.starts_with(kGenerated) || network_scheme(begin) != nullptr ||
           is_camera_device(place);
}

std::string public_name(const std::filesystem::path& place) {
    std::string name = place.string();
    const auto begin = name.find("://");
    if (begin == std::string::npos || network_scheme(name) == nullptr) return name;
    const auto host = begin + 3;
    const auto at = name.rfind('@', name.find('/', host));
    if (at != std::string::npos && at > host) name.erase(host, at + 1 - host);
    return name;
}

std::string shown_source(const std::filesystem::path& place) {
    return place == "-" ? "standard input" : public_name(place);
}

LiveName live_name(const std::filesystem::path& place) {
    const std::string& name = place.native();
    const std::string_view text = name;
    const auto after = [text](std::string_view begin) { return text.substr(begin.size()); };
    if (const Scheme* const scheme = network_scheme(text)) {
        require_port(name, *scheme);
        return {.kind = LiveKind::network, .url = name, .allowed = std::string(scheme->allowed)};
    }
    if (text.starts_with(kGenerated) && text.size() > kGenerated.size())
        return {
            .kind = LiveKind::generated, .url = std::string(after(kGenerated)), .format = "lavfi"};
    if (name == "-" || name == kPipe) return {.kind = LiveKind::pipe, .allowed = "none"};
    if (text.starts_with(kPipe))
        return {.kind = LiveKind::pipe, .url = std::string(after(kPipe)), .allowed = "none"};
    if (text.starts_with(kCamera) && text.size() > kCamera.size())
        return camera(name, after(kCamera));
    if (is_camera_device(place)) return camera(name, text);
    throw InputError(in_quotes(name) +
                     " names nothing live: give v4l2:/dev/video0, udp://..., rtsp://..., "
                     "srt://..., tcp://..., http://..., pipe:NAME or lavfi:SPEC");
}

bool keeps_connection(const LiveName& name) {
    const Scheme* const scheme = network_scheme(name.url);
    return name.kind == LiveKind::network && scheme != nullptr && scheme->connected;
}

bool has_known_host(const LiveName& name) {
    const std::string host = host_and_port(name.url).host;
    addrinfo* found = nullptr;
    if (name.kind != LiveKind::network || host.empty()) return true;
    // Any other failure may pass, as that of a network that is down for a moment.
    const bool known = ::getaddrinfo(host.c_str(), nullptr, nullptr, &found) != EAI_NONAME;
    if (found != nullptr) ::freeaddrinfo(found);
    return known;
}

}  // namespace dibhr
