// Tiny clips and pictures, made at test time in a folder that goes with the test.
#include "tests/core/video/clips.hpp"

#include <cstdlib>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

void ffmpeg(const std::string& arguments) {
    const std::string command = "ffmpeg -nostdin -v quiet -y " + arguments;
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

void make_flat_clip(const std::filesystem::path& file, int frames, int frames_per_s,
                    const std::string& encoding, const std::string& filter, int width, int height) {
    // Each once: many cases want the same ones.
    static const TemporaryFolder made;
    static std::map<std::string, std::filesystem::path> clips;
    const std::string arguments = "-f lavfi -i \"color=black:s=" + std::to_string(width) + "x" +
                                  std::to_string(height) + ":r=" + std::to_string(frames_per_s) +
                                  ",format=gray,geq=lum='5*N'" +
                                  (filter.empty() ? "" : "," + filter) + "\" -frames:v " +
                                  std::to_string(frames) + " -fps_mode passthrough " + encoding;
    const std::string ending = file.extension().string();
    std::filesystem::path& clip = clips[arguments + ending];
    if (clip.empty()) {
        const std::filesystem::path path = made / (std::to_string(clips.size()) + ending);
        ffmpeg(arguments + " '" + path.string() + "'");
        clip = path;
    }
    std::filesystem::copy_file(clip, file, std::filesystem::copy_options::overwrite_existing);
}

void turn(const std::filesystem::path& file, const std::filesystem::path& turned, int degrees) {
    const std::string from = "-i '" + file.string() + "' -c copy ";
    const std::string to = "'" + turned.string() + "'";
    try {
        ffmpeg("-display_rotation:v:0 " + std::to_string(-degrees) + " " + from + to);
    } catch (const std::runtime_error&) {  // before ffmpeg 6, which turned the other way
        ffmpeg(from + "-metadata:s:v:0 rotate=" + std::to_string((360 - degrees) % 360) + " " + to);
    }
}

void write_picture(const std::filesystem::path& file, int columns, int rows, int bits, int channels,
                   const std::function<int(int, int, int)>& level) {
    cv::Mat picture(rows, columns, CV_MAKETYPE(bits == 16 ? CV_16U : CV_8U, channels));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            for (int c = 0; c < channels; ++c) {
                const int at = i * channels + c;
                if (bits == 16)
                    picture.ptr<std::uint16_t>(j)[at] = static_cast<std::uint16_t>(level(i, j, c));
                else
                    picture.ptr<std::uint8_t>(j)[at] = static_cast<std::uint8_t>(level(i, j, c));
            }
    if (!cv::imwrite(file.string(), picture))
        throw std::runtime_error("not written: " + file.string());
}

void cut(const std::filesystem::path& file, const std::filesystem::path& cut_file,
         std::uintmax_t bytes) {
    std::filesystem::copy_file(file, cut_file);
    std::filesystem::resize_file(cut_file, bytes);
}

std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

void write_depth(const std::filesystem::path& file, int number, int columns, int rows) {
    std::filesystem::create_directories(file.parent_path());
    write_picture(file, columns, rows, 16, 1, [=](int, int, int) { return 100 * number; });
}

void write_colour(const std::filesystem::path& file, int number) {
    std::filesystem::create_directories(file.parent_path());
    write_picture(file, 20, 12, 8, 3, [=](int, int, int) { return number; });
}

std::vector<Shown> all_of(Media& media) {
    std::vector<Shown> shown;
    while (const auto frame = media.next()) {
        shown.push_back({static_cast<int>(frame->depth.at(3, 3)) / 100,
                         frame->colour.rgb.empty() ? -1 : frame->colour.rgb.front(),
                         frame->media_s});
    }
    return shown;
}

}  // namespace dibhr::test
