// Pictures and videos, written as other programs do.
#include "tests/core/video/form_writers.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace fs = std::filesystem;

std::string bytes_of(const cv::Mat& picture) {
    return {reinterpret_cast<const char*>(picture.data), picture.total() * picture.elemSize()};
}

Write picture(const cv::Mat& content) {
    return [=](const fs::path& file) { REQUIRE(cv::imwrite(file.string(), content)); };
}

Write text(const std::string& bytes) {
    return [=](const fs::path& file) { write_text(file, bytes); };
}

Write zip_of(const std::string& entry, const std::string& bytes) {
    return [=](const fs::path& file) { write_zip(file, {{entry, bytes}}, true); };
}

Write exr(const std::string& channel, const cv::Mat& content) {
    return [=](const fs::path& file) {
        Imf::Header header(content.cols, content.rows);
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        Imf::FrameBuffer buffer;
        cv::Mat own = content.clone();
        buffer.insert(channel,
                      Imf::Slice::Make(Imf::FLOAT, own.data, header.dataWindow(), 4, own.step));
        Imf::OutputFile out(file.c_str(), header);
        out.setFrameBuffer(buffer);
        out.writePixels(content.rows);
    };
}

std::string raw_input(const cv::Mat& content, const std::string& format, const fs::path& file) {
    std::ofstream out(file, std::ios::binary);
    for (int k = 0; k < 3; ++k) out << bytes_of(content);
    return "-f rawvideo -r 10 -pix_fmt " + format + " -s " + std::to_string(content.cols) + "x" +
           std::to_string(content.rows) + " -i '" + file.string() + "' ";
}

Write video(const cv::Mat& content, const std::string& format, const std::string& encoding) {
    return [=](const fs::path& file) {
        const fs::path raw = file.string() + ".raw";
        ffmpeg(raw_input(content, format, raw) + encoding + " '" + file.string() + "'");
        fs::remove(raw);
    };
}

Write tracks(const cv::Mat& colour, const cv::Mat& depth, const std::string& format,
             const std::string& title) {
    return [=](const fs::path& file) {
        const fs::path first = file.string() + ".colour";
        const fs::path second = file.string() + ".depth";
        ffmpeg(raw_input(colour, "bgr24", first) + raw_input(depth, format, second) +
               "-map 0 -map 1 -c:v ffv1 -pix_fmt:v:0 bgr0 -pix_fmt:v:1 " +
               (format == "bgr24" ? "bgr0" : format) + " -metadata:s:v:1 title='" + title + "' '" +
               file.string() + "'");
        fs::remove(first);
        fs::remove(second);
    };
}

}  // namespace dibhr::test
