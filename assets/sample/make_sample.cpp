// make_sample: renders the built-in sample, one frame of it as PNG, or the labels of its regions.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <future>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "assets/sample/encode.hpp"
#include "assets/sample/picture.hpp"
#include "assets/sample/regions.hpp"
#include "core/error.hpp"
#include "core/video/sources/picture_files.hpp"

namespace {

using dibhr::sample::Picture;

constexpr auto kUsage =
    "usage: make_sample DIR            color.mp4 and depth.mp4\n"
    "       make_sample --frame N DIR  color-N.png and depth-N.png\n"
    "       make_sample --regions DIR  depth_regions.png\n";

void write_png(const std::filesystem::path& file, int columns, int rows, int type,
               std::vector<std::uint8_t> bytes) {
    if (!cv::imwrite(file.string(), cv::Mat{rows, columns, type, bytes.data()}))
        throw dibhr::InputError("cannot write " + file.string() +
                                ": choose a folder that can be written");
}

void make_video(const std::filesystem::path& folder) {
    namespace sample = dibhr::sample;
    auto colour = sample::VideoFile::colour(folder / "color.mp4");
    auto depth = sample::VideoFile::depth(folder / "depth.mp4");
    const int workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    for (int first = 0; first < sample::kFrames; first += workers) {
        std::vector<std::future<Picture>> pictures;
        for (int frame = first; frame < std::min(first + workers, sample::kFrames); ++frame)
            pictures.push_back(std::async(std::launch::async, sample::picture_of, frame));
        for (auto& pending : pictures) {
            const Picture picture = pending.get();
            colour.write(picture.bgr);
            depth.write(sample::rounded(picture.level));
        }
        std::cerr << "\rframe " << std::min(first + workers, sample::kFrames) << " of "
                  << sample::kFrames << std::flush;
    }
    std::cerr << '\n';
    colour.finish();
    depth.finish();
}

void make_frame(int frame, const std::filesystem::path& folder) {
    namespace sample = dibhr::sample;
    const Picture picture = sample::picture_of(frame);
    const std::string end = "-" + std::to_string(frame) + ".png";
    write_png(folder / ("color" + end), sample::kColumns, sample::kRows, CV_8UC3, picture.bgr);
    write_png(folder / ("depth" + end), sample::kColumns, sample::kRows, CV_8UC1,
              sample::rounded(picture.level));
}

/// The label pictures one below the other.
void make_regions(const std::filesystem::path& folder) {
    namespace sample = dibhr::sample;
    std::vector<std::uint8_t> all;
    for (int k = 0; k < sample::kLabelPictures; ++k) {
        const std::vector<std::uint8_t> labels = sample::labels_of(sample::frame_of_labels(k));
        all.insert(all.end(), labels.begin(), labels.end());
    }
    constexpr int kWide = sample::kColumns / sample::kLabelStep;
    constexpr int kHigh = sample::kRows / sample::kLabelStep * sample::kLabelPictures;
    write_png(folder / "depth_regions.png", kWide, kHigh, CV_8UC1, std::move(all));
}

bool is_number(const std::string& word) {
    return !word.empty() && word.size() < 7 &&
           word.find_first_not_of("0123456789") == std::string::npos;
}

/// False: the arguments are invalid.
bool make(const std::vector<std::string>& words) {
    if (words.size() == 1 && !words[0].starts_with("-")) {
        make_video(words[0]);
    } else if (words.size() == 2 && words[0] == "--regions") {
        make_regions(words[1]);
    } else if (words.size() == 3 && words[0] == "--frame" && is_number(words[1])) {
        make_frame(std::stoi(words[1]), words[2]);
    } else {
        return false;
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    std::signal(SIGPIPE, SIG_IGN);  // an early end of ffmpeg becomes an error of write()
    try {
        if (make({arguments + 1, arguments + count})) return 0;
        std::cerr << kUsage;
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "make_sample: " << error.what() << '\n';
        return 1;
    }
}
