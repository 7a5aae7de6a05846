// Files that name other files or hosts: a file gives what it holds, and nothing else is opened.
#include <netinet/in.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

bool is_ready(int descriptor) {
    pollfd asked{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&asked, 1, 0) > 0;
}

/// Whether anybody opens a file.
class OpenedFile {
  public:
    explicit OpenedFile(const fs::path& file) {
        REQUIRE(::inotify_add_watch(notes_, file.c_str(), IN_OPEN) >= 0);
    }
    ~OpenedFile() { ::close(notes_); }
    OpenedFile(const OpenedFile&) = delete;
    OpenedFile& operator=(const OpenedFile&) = delete;
    [[nodiscard]] bool was_opened() const { return is_ready(notes_); }

  private:
    int notes_{::inotify_init1(IN_CLOEXEC)};
};

/// A host of this machine, and whether anybody comes to it.
class VisitedHost {
  public:
    VisitedHost() {
        sockaddr_in address{};
        socklen_t bytes = sizeof address;
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        REQUIRE(::bind(listener_, any, bytes) == 0);
        REQUIRE(::listen(listener_, 4) == 0);
        REQUIRE(::getsockname(listener_, any, &bytes) == 0);
        name_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    }
    ~VisitedHost() { ::close(listener_); }
    VisitedHost(const VisitedHost&) = delete;
    VisitedHost& operator=(const VisitedHost&) = delete;
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool was_visited() const { return is_ready(listener_); }

  private:
    int listener_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    std::string name_{};
};

std::string hls(const std::string& names) {
    return "#EXTM3U\n#EXT-X-VERSION:3\n#EXT-X-TARGETDURATION:1\n" + names;
}

/// One byte that text does not hold, so that the file is not refused as text.
std::string marked(const std::string& text) {
    return text + "\n#\x01\n";
}

/// What leads libav to the film or the host, by the name of its file.
std::map<std::string, std::string> reaching_files(const std::string& film,
                                                  const std::string& host) {
    const std::string part = "#EXTINF:1,\n";
    const std::string ends = "\n#EXT-X-ENDLIST";
    const std::string local = "#EXTINF:1,\nhttp://" + host + "/film.mkv";
    return {
        {"list.m3u8", marked(hls(part + film + ends))},
        {"list.mp4", marked(hls(part + film + ends))},
        {"list.png", marked(hls(part + film + ends))},
        {"file_url.m3u8", marked(hls(part + "file:" + film + ends))},
        {"file_scheme.m3u8", marked(hls(part + "file://" + film + ends))},
        {"endless.m3u8", marked(hls(part + film))},
        {"key.m3u8", marked(hls("#EXT-X-KEY:METHOD=AES-128,URI=\"" + film + "\"\n" + part + film))},
        {"map.m3u8", marked(hls("#EXT-X-MAP:URI=\"" + film + "\"\n" + part + film + ends))},
        {"variants.m3u8", marked(hls("#EXT-X-STREAM-INF:BANDWIDTH=1\n" + film))},
        {"spliced.m3u8", marked(hls(part + "concat:" + film + "|" + film + ends))},
        {"part.m3u8", marked(hls(part + "subfile,,start,0,end,0,,:" + film + ends))},
        {"host.m3u8", marked(hls(local + ends))},
        {"begins.m3u8", hls("#\x01\n" + part + film + ends)},
        {"list.ffconcat", marked("ffconcat version 1.0\nfile '" + film + "'")},
        {"list.mkv", marked("ffconcat version 1.0\nfile '" + film + "'\nduration 1")},
        {"host.ffconcat", marked("ffconcat version 1.0\nfile 'http://" + host + "/film.mkv'")},
        {"two.ffconcat",
         marked("ffconcat version 1.0\nstream\nfile '" + film + "'\nfile '" + film + "'")},
        {"film.mpd", marked("<?xml version=\"1.0\"?><MPD type=\"static\" "
                            "profiles=\"urn:mpeg:dash:profile:isoff-on-demand:2011\"><Period>"
                            "<AdaptationSet mimeType=\"video/mp4\"><Representation id=\"1\">"
                            "<BaseURL>" +
                            film + "</BaseURL></Representation></AdaptationSet></Period></MPD>")},
        {"call.sdp", marked("v=0\no=- 0 0 IN IP4 127.0.0.1\ns=x\nc=IN IP4 127.0.0.1\nt=0 0\n"
                            "m=video 5004 RTP/AVP 96\na=rtpmap:96 H264/90000")},
        {"page.png",
         marked("<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"><VRTRasterBand "
                "dataType=\"Byte\" band=\"1\"><SimpleSource><SourceFilename>" +
                film + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>")},
        {"frame%d.dpx", marked("no picture, but the name of a row of them")},
        {"script.avs", marked("AviSource(\"" + film + "\")")},
    };
}

}  // namespace

TEST_CASE("a file that names other files or hosts is refused, and none of them is opened",
          "[refusal][reaching]") {
    const TemporaryFolder theirs, ours;
    const fs::path film = ours / "film.mkv";
    make_flat_clip(film, 10, 25, kLossless);
    fs::copy_file(film, theirs / "frame1.dpx");
    const VisitedHost host;
    const OpenedFile watched(film), beside(theirs / "frame1.dpx");
    const auto files = reaching_files(film.string(), host.name());
    CHECK(files.size() >= 20);
    for (const auto& [name, content] : files) {
        CAPTURE(name);
        const fs::path file = theirs / name;
        write_text(file, content);
        const std::string said = refusal([&] { (void)describe_media(file); });
        CHECK(contains(said, name));
        CHECK(said.find('\n') == std::string::npos);
        CHECK_FALSE(refusal([&] { (void)open_depth(file); }).empty());
        CHECK_FALSE(refusal([&] { (void)open_media(file, file); }).empty());
        CHECK_FALSE(watched.was_opened());
        CHECK_FALSE(beside.was_opened());
        CHECK_FALSE(host.was_visited());
    }
}

TEST_CASE("every container that people's films come in is opened", "[refusal][reaching]") {
    const TemporaryFolder folder;
    const fs::path film = folder / "film.mkv";
    make_flat_clip(film, 20, 25, "-c:v mpeg2video -q:v 2");
    std::string outputs;
    const auto out = [&](const std::string& ending) {
        return (folder / ("as." + ending)).string();
    };
    const std::set<std::string> copied{"ts", "mpg", "m2v", "mxf"};
    const std::set<std::string> coded{"avi", "mov", "mp4",  "nut", "flv",  "asf",  "mjpeg", "y4m",
                                      "gif", "ogv", "webm", "ivf", "h264", "hevc", "obu"};
    for (const std::string& ending : copied) outputs += " -c copy '" + out(ending) + "'";
    for (const std::string& ending : coded)
        outputs += " -x265-params log-level=none '" + out(ending) + "'";
    ffmpeg("-i '" + film.string() + "'" + outputs);
    for (const auto* const endings : {&copied, &coded}) {
        for (const std::string& ending : *endings) {
            CAPTURE(ending);
            CHECK(refusal([&] { (void)open_depth(out(ending)); }) == "");
        }
    }
}
