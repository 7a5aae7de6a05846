// Video files of the sample: options found by measuring what OpenCV gives back.
#include "assets/sample/encode.hpp"

#include <cstdio>
#include <string>
#include <utility>

#include "assets/sample/pose.hpp"
#include "core/error.hpp"

namespace dibhr::sample {
namespace {

std::string quoted(const std::string& word) {
    std::string safe = "'";
    for (const char c : word) safe += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return safe + "'";
}

std::string command(const std::string& file, const std::string& pixels, const std::string& codec) {
    return "ffmpeg -hide_banner -loglevel error -y -f rawvideo -s " + std::to_string(kColumns) +
           "x" + std::to_string(kRows) + " -r " + std::to_string(kFramesPerSecond) + " " + pixels +
           " -i - " + codec + " -movflags +faststart " + quoted(file);
}

}  // namespace

// Colour at full resolution (4:4:4): 40 dB against the rendered frames in 1.5 MB; with the usual
// halved colour the knitted edges keep 34 dB at the same size.
VideoFile VideoFile::colour(const std::filesystem::path& file) {
    return {file, "-pix_fmt bgr24",
            "-sws_flags accurate_rnd+full_chroma_int -c:v libx264 -preset slow -crf 17 "
            "-pix_fmt yuv444p -colorspace smpte170m"};
}

// Without loss 2.8 MB, and every rounded level comes back through OpenCV 4.6; FFV1 4.5 MB with the
// same levels; rate 8 0.9 MB, but errors of 1.3 levels (p99) and 56 (worst, at silhouettes).
VideoFile VideoFile::depth(const std::filesystem::path& file) {
    return {file, "-pix_fmt gray -color_range pc",
            "-c:v libx264 -preset veryslow -qp 0 -pix_fmt yuvj420p -color_range pc"};
}

VideoFile::VideoFile(std::filesystem::path file, const std::string& pixels,
                     const std::string& codec)
    : file_{std::move(file)}, pipe_{popen(command(file_.string(), pixels, codec).c_str(), "w")} {
    if (!pipe_)
        throw InputError("cannot start ffmpeg for " + file_.string() +
                         ": install the ffmpeg package");
}

void VideoFile::Close::operator()(std::FILE* pipe) const noexcept {
    pclose(pipe);
}

void VideoFile::write(const std::vector<std::uint8_t>& frame) {
    if (std::fwrite(frame.data(), 1, frame.size(), pipe_.get()) != frame.size())
        throw InputError("ffmpeg stopped while writing " + file_.string() +
                         ": its message above says why");
}

void VideoFile::finish() {
    if (pclose(pipe_.release()) != 0)
        throw InputError("ffmpeg could not write " + file_.string() +
                         ": its message above says why");
}

}  // namespace dibhr::sample
