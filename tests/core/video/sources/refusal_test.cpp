// What cannot be used is refused in one plain line that names the file and says what to do.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The refusal of opening a file as depth; checks that it is one line, names the file and says what
/// to do.
std::string refusal_of(const std::filesystem::path& file) {
    const std::string said = refusal([&] { (void)open_depth(file); });
    CHECK(said == refusal([&] { (void)describe_media(file); }));
    CHECK(said.find(file.filename().string()) != std::string::npos);
    CHECK(said.find(": ") != std::string::npos);
    CHECK(std::count(said.begin(), said.end(), '\n') == 0);
    return said;
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// What the call writes to the standard error stream.
template <typename Call>
std::string words_on_stderr(const std::filesystem::path& file, Call call) {
    std::fflush(stderr);
    const int kept = ::dup(STDERR_FILENO);
    std::FILE* const into = std::fopen(file.c_str(), "w");
    ::dup2(::fileno(into), STDERR_FILENO);
    call();
    std::fflush(stderr);
    ::dup2(kept, STDERR_FILENO);
    ::close(kept);
    std::fclose(into);
    std::ostringstream words;
    words << std::ifstream(file).rdbuf();
    return words.str();
}

}  // namespace

TEST_CASE("a missing file is named", "[refusal]") {
    const TemporaryFolder folder;
    CHECK(holds(refusal_of(folder / "nothing.mp4"), "does not exist"));
}

TEST_CASE("a folder, a pipe and an empty file are refused for what they are", "[refusal]") {
    const TemporaryFolder folder;
    CHECK(holds(refusal_of(folder.path()), "folder"));
    REQUIRE(::mkfifo((folder / "pipe.mp4").c_str(), 0600) == 0);
    CHECK(holds(refusal_of(folder / "pipe.mp4"), "pipe"));
    write_text(folder / "empty.mp4", "");
    CHECK(holds(refusal_of(folder / "empty.mp4"), "empty"));
    CHECK(holds(refusal_of("/dev/null"), "device"));
}

TEST_CASE("a folder whose folders are not named colour and depth says which they are",
          "[refusal]") {
    const TemporaryFolder folder;
    const auto grey = [](int i, int j, int) { return 7 * i + j; };
    const std::string above = GENERATE("", "training/", "scene/left/");
    CAPTURE(above);
    std::filesystem::create_directories(folder / (above + "SYVYYS"));
    write_picture(folder / (above + "SYVYYS/0.png"), 8, 8, 16, 1, grey);
    const std::string one = refusal_of(folder.path());
    CHECK(holds(one, "give '" + (folder / (above + "SYVYYS")).string() + "'"));
    std::filesystem::create_directories(folder / (above + "KUVA"));
    write_picture(folder / (above + "KUVA/0.png"), 8, 8, 8, 3, grey);
    const std::string two = refusal_of(folder.path());
    CHECK(holds(two, "'" + above + "KUVA', '" + above + "SYVYYS'"));
    CHECK(holds(two, "give the colour folder first"));
}

TEST_CASE("a folder of a form that has to be converted says how", "[refusal]") {
    const TemporaryFolder folder;
    std::string frame("PIEH\x14\0\0\0\x14\0\0\0", 12);  // 20 x 20 pixels, 1 m away
    for (int k = 0; k < 20 * 20; ++k) frame += std::string("\0\0\x80?", 4);
    write_text(folder / "readme.txt", "Depth of each frame.\n");
    write_text(folder / "frame_0001.dpt", frame);
    write_text(folder / "frame_0002.dpt", frame);
    const std::string said = refusal_of(folder.path());
    CHECK(holds(said, "'frame_0001.dpt' in it is a depth picture of MPI Sintel"));
    const std::string loop = said.substr(said.find("for f in *.dpt; do python3 -c"));
    std::string command = loop.substr(0, loop.find("; done") + 6);
    command.insert(command.find("python3"), "/usr/bin/");
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && " + command).c_str()) == 0);
    CHECK(open_depth(folder.path())->description().frames == 2);
}

TEST_CASE("text under a video's or a picture's name is refused as text", "[refusal]") {
    const TemporaryFolder folder;
    const std::string name = GENERATE("notes.mp4", "list.m3u8", "notes.png", "notes.webm");
    write_text(folder / name, "#EXTM3U\nThis is no video.\n");
    CHECK(holds(refusal_of(folder / name), "text"));
}

TEST_CASE("bytes that are no video are refused", "[refusal]") {
    const TemporaryFolder folder;
    std::string bytes(5000, '\0');
    for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<char>(k * k % 251);
    write_text(folder / "noise.mp4", bytes);
    CHECK(holds(refusal_of(folder / "noise.mp4"), "cannot be opened as a video"));
}

TEST_CASE("an mp4 that lost its end, and with it its index, is refused at opening", "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "whole.mp4", 40, 25, kH264, "noise=alls=20:allf=t");
    cut(folder / "whole.mp4", folder / "part.mp4",
        std::filesystem::file_size(folder / "whole.mp4") / 2);
    CHECK(holds(refusal_of(folder / "part.mp4"), "cut off"));
}

TEST_CASE("a film that is whole and whose header is damaged is not said to be cut off only",
          "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "whole.mp4", 30, 25, kH264);
    std::string bytes = read_text(folder / "whole.mp4");
    const std::size_t samples = bytes.find("stts") + 12;  // how many have the first length
    bytes.replace(samples, 2, "\x41\x41");
    write_text(folder / "damaged.mp4", bytes);
    CHECK(holds(refusal_of(folder / "damaged.mp4"), "damaged header"));
}

TEST_CASE("a video cut off before its first picture is refused", "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "whole.mkv", 10, 25, kLossless, "noise=alls=60:allf=t", 320, 240);
    cut(folder / "whole.mkv", folder / "head.mkv", 1200);
    CHECK_FALSE(refusal_of(folder / "head.mkv").empty());
}

TEST_CASE("a file with sound only is refused", "[refusal]") {
    const TemporaryFolder folder;
    ffmpeg("-f lavfi -i sine=d=1 -c:a aac '" + (folder / "sound.mp4").string() + "'");
    CHECK(holds(refusal_of(folder / "sound.mp4"), "no video stream"));
}

TEST_CASE("a one-pixel picture is refused as depth and as colour", "[refusal]") {
    const TemporaryFolder folder;
    const auto zero = [](int, int, int) { return 0; };
    write_picture(folder / "dot.png", 1, 1, 8, 1, zero);
    write_picture(folder / "line.png", 1, 9, 16, 1, zero);
    write_picture(folder / "depth.png", 8, 8, 8, 1, zero);
    CHECK(holds(refusal_of(folder / "dot.png"), "1 x 1"));
    CHECK(holds(refusal_of(folder / "line.png"), "1 x 9"));
    CHECK(holds(refusal([&] { (void)open_media(folder / "dot.png", folder / "depth.png"); }),
                "dot.png"));
}

TEST_CASE("a damaged picture is refused", "[refusal]") {
    const TemporaryFolder folder;
    write_picture(folder / "whole.png", 64, 64, 16, 1,
                  [](int i, int j, int) { return i * j * 17 % 65536; });
    cut(folder / "whole.png", folder / "part.png", 60);
    CHECK(holds(refusal_of(folder / "part.png"), "damaged"));
}

TEST_CASE("a file without read permission says so", "[refusal]") {
    const TemporaryFolder folder;
    write_text(folder / "locked.mp4", "x");
    std::filesystem::permissions(folder / "locked.mp4", std::filesystem::perms::none);
    const std::string said = refusal_of(folder / "locked.mp4");
    // The superuser may read it all the same, and then finds text.
    CHECK(holds(said, ::geteuid() == 0 ? "text" : "permissions"));
}

TEST_CASE("colour alone says that a depth file is needed and where it looked", "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "color_a.mkv", 3, 25, kLossless);
    make_flat_clip(folder / "clip.mkv", 3, 25, kLossless);
    const std::string said = refusal([&] { (void)open_media(folder / "color_a.mkv"); });
    CHECK(holds(said, "color_a.mkv"));
    CHECK(holds(said, "needs a depth file"));
    CHECK(holds(said, (folder / "depth_a.mkv").string()));
    CHECK(holds(refusal([&] { (void)open_media(folder / "clip.mkv"); }), "needs a depth file"));
}

TEST_CASE("depth alone is shown in colours of its own, light where it is near", "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "depth_a.mkv", 3, 25, kLossless);  // frame n has level 5 n
    const bool as_depth = GENERATE(true, false);
    const auto media =
        as_depth ? open_media({}, folder / "depth_a.mkv") : open_media(folder / "depth_a.mkv");
    const auto brightness = [](const RawFrame& frame) {
        return frame.colour.rgb[0] + frame.colour.rgb[1] + frame.colour.rgb[2];
    };
    const auto far = media->next();
    CHECK(far->colour.columns == far->depth.columns);
    CHECK(media->next().has_value());
    CHECK(brightness(*media->next()) > brightness(*far));
    CHECK(media->description().colour_path.empty());
}

TEST_CASE("reading good and bad files leaves the standard error stream to the program",
          "[refusal]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "whole.mp4", 20, 25, kH264, "noise=alls=20:allf=t");
    make_flat_clip(folder / "whole.webm", 20, 25, kVp9, "noise=alls=20:allf=t");
    write_picture(folder / "whole.png", 64, 64, 16, 1,
                  [](int i, int j, int) { return i * j * 17 % 65536; });
    const auto size = [](const std::filesystem::path& file) {
        return std::filesystem::file_size(file);
    };
    cut(folder / "whole.mp4", folder / "part.mp4", size(folder / "whole.mp4") / 2);
    cut(folder / "whole.webm", folder / "part.webm", size(folder / "whole.webm") / 2);
    cut(folder / "whole.png", folder / "part.png", 60);
    CHECK(words_on_stderr(folder / "words", [&] {
              (void)refusal([&] { (void)describe_media(folder / "part.mp4"); });
              (void)refusal([&] { (void)describe_media(folder / "part.webm"); });
              (void)refusal([&] { (void)describe_media(folder / "part.png"); });
              (void)refusal([&] { (void)describe_media(folder / "missing.png"); });
          }).empty());
}
