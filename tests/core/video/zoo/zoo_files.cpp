// Pictures by OpenCV and OpenEXR, videos by ffmpeg; the rest byte by byte.
#include "tests/core/video/zoo/zoo_files.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

#include "core/files/plain_text.hpp"
#include "tests/core/video/bag_writers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/depth_photos.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test::zoo {

namespace {

void make_folder_of(const fs::path& file) {
    fs::create_directories(file.parent_path());
}

/// Numbers that are not finite replaced by `value`.
cv::Mat without_nan(const cv::Mat& numbers, double value) {
    cv::Mat whole = numbers.clone();
    cv::patchNaNs(whole, value);
    return whole;
}

std::pair<double, double> ends_of(const cv::Mat& numbers) {
    double lowest = 0.0;
    double highest = 0.0;
    cv::minMaxLoc(numbers, &lowest, &highest, nullptr, nullptr, numbers == numbers);
    return {lowest, highest};
}

}  // namespace

cv::Mat in_16_bits(const cv::Mat& farness, double per_unit, int none) {
    cv::Mat levels;
    without_nan(farness, 0.0).convertTo(levels, CV_16U, per_unit);
    levels.setTo(none, ~(farness == farness));
    return levels;
}

cv::Mat disparity_of(const cv::Mat& farness, double highest) {
    const double nearest = ends_of(farness).first;
    cv::Mat disparity;
    cv::divide(highest * nearest, without_nan(farness, 1e9), disparity);
    disparity.setTo(0.0, ~(farness == farness));
    return disparity;
}

cv::Mat nearness_of(const cv::Mat& farness) {
    const auto [nearest, farthest] = ends_of(farness);
    const double span = farthest - nearest;
    cv::Mat parts;
    without_nan(farness, farthest).convertTo(parts, CV_32F, -1.0 / span, farthest / span);
    return parts;
}

cv::Mat in_8_bits(const cv::Mat& parts) {
    cv::Mat levels;
    parts.convertTo(levels, CV_8U, 255.0);
    return levels;
}

cv::Mat with_no_data_as(const cv::Mat& farness, double value) {
    return without_nan(farness, value);
}

std::string numbered_name(const std::string& pattern, std::int64_t number) {
    const std::size_t begin = pattern.find('#');
    if (begin == std::string::npos) return pattern;
    const std::size_t end = std::min(pattern.find_first_not_of('#', begin), pattern.size());
    std::string digits = std::to_string(number);
    if (digits.size() < end - begin) digits.insert(0, end - begin - digits.size(), '0');
    return pattern.substr(0, begin) + digits + pattern.substr(end);
}

void save_text(const fs::path& file, const std::string& text) {
    make_folder_of(file);
    write_text(file, text);
}

void save(const fs::path& file, const cv::Mat& picture) {
    make_folder_of(file);
    const std::vector<int> good{cv::IMWRITE_JPEG_QUALITY, 95};
    const bool is_jpeg = file.extension() == ".jpg";
    if (!cv::imwrite(file.string(), picture, is_jpeg ? good : std::vector<int>{}))
        throw std::runtime_error("not written: " + file.string());
}

std::string npy_of(const Pictures& pictures, const std::string& shape) {
    const cv::Mat& first = pictures.front();
    const auto axis = [](std::size_t length) { return std::to_string(length) + ", "; };
    std::string axes = pictures.size() > 1 ? axis(pictures.size()) : "";
    axes += axis(static_cast<std::size_t>(first.rows)) + axis(static_cast<std::size_t>(first.cols));
    if (first.channels() > 1) axes += axis(static_cast<std::size_t>(first.channels()));
    axes.resize(axes.size() - 2);
    std::string data;
    for (const cv::Mat& picture : pictures) data += bytes_of(picture.clone());
    std::string type = "<f4";
    if (first.depth() == CV_8U) type = "|u1";
    if (first.depth() == CV_16U) type = "<u2";
    return npy(type, shape.empty() ? "(" + axes + ")" : shape, data);
}

void save_npy(const fs::path& file, const cv::Mat& numbers, const std::string& shape) {
    save_text(file, npy_of({numbers}, shape));
}

void save_npz(const fs::path& file, const std::map<std::string, std::string>& arrays) {
    make_folder_of(file);
    std::map<std::string, std::string> entries;
    for (const auto& array : arrays) entries[array.first + ".npy"] = array.second;
    write_zip(file, entries, true);
}

void save_pfm(const fs::path& file, const cv::Mat& numbers) {
    save_text(file, pfm(numbers, "-1.0", true));
}

void save_exr(const fs::path& file, const std::map<std::string, cv::Mat>& channels) {
    make_folder_of(file);
    const cv::Size size = channels.begin()->second.size();
    Imf::Header header(size.width, size.height);
    Imf::FrameBuffer buffer;
    std::vector<cv::Mat> own;  // not shared with the caller's
    own.reserve(channels.size());
    for (const auto& channel : channels) {
        cv::Mat& numbers = own.emplace_back(channel.second.clone());
        header.channels().insert(channel.first, Imf::Channel(Imf::FLOAT));
        buffer.insert(channel.first, Imf::Slice::Make(Imf::FLOAT, numbers.data, header.dataWindow(),
                                                      4, numbers.step));
    }
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(size.height);
}

// TIFF.

void save_tiff(const fs::path& file, const cv::Mat& numbers, const std::string& no_data,
               const std::string& description) {
    const std::string data = bytes_of(numbers.clone());
    const auto columns = static_cast<std::uint32_t>(numbers.cols);
    const auto rows = static_cast<std::uint32_t>(numbers.rows);
    struct Tag {
        std::uint16_t tag, type;  // 2 text, 3 of 16 bits, 4 of 32 bits, 12 real numbers
        std::uint32_t count;
        std::string bytes;
    };
    const auto number = [](std::uint16_t tag, std::uint32_t value) {
        Tag written{tag, 4, 1, {}};
        append_bytes(written.bytes, value);
        return written;
    };
    std::vector<Tag> tags{number(256, columns), number(257, rows), number(258, 32), number(259, 1),
                          number(262, 1)};
    if (!description.empty())
        tags.push_back(
            {270, 2, static_cast<std::uint32_t>(description.size() + 1), description + '\0'});
    tags.insert(tags.end(), {number(273, 8), number(277, 1), number(278, rows),
                             number(279, static_cast<std::uint32_t>(data.size())), number(339, 3)});
    if (!no_data.empty()) {
        Tag scale{33550, 12, 3, {}};
        for (const double metres : {10.0, 10.0, 0.0}) append_bytes(scale.bytes, metres);
        Tag place{33922, 12, 6, {}};
        for (const double at : {0.0, 0.0, 0.0, 350000.0, 5200000.0, 0.0})
            append_bytes(place.bytes, at);
        Tag keys{34735, 3, 16, {}};  // projected, pixels are areas, UTM zone 32 north
        for (const int key : {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32632})
            append_bytes(keys.bytes, static_cast<std::uint16_t>(key));
        const std::string text = no_data + '\0';
        tags.insert(
            tags.end(),
            {scale, place, keys, {42113, 2, static_cast<std::uint32_t>(text.size()), text}});
    }
    std::string head = "II";
    append_bytes(head, std::uint16_t{42});
    append_bytes(head, static_cast<std::uint32_t>(8 + data.size()));
    std::string list;
    std::string beyond;
    append_bytes(list, static_cast<std::uint16_t>(tags.size()));
    const std::size_t beyond_at = 8 + data.size() + 2 + 12 * tags.size() + 4;
    for (Tag& tag : tags) {
        append_bytes(list, tag.tag);
        append_bytes(list, tag.type);
        append_bytes(list, tag.count);
        if (tag.bytes.size() <= 4) {
            tag.bytes.resize(4, '\0');
            list += tag.bytes;
        } else {
            append_bytes(list, static_cast<std::uint32_t>(beyond_at + beyond.size()));
            beyond += tag.bytes;
        }
    }
    append_bytes(list, std::uint32_t{0});
    save_text(file, head + data + list + beyond);
}

// JPEG with depth in it.

void save_gdepth(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth, double near_m,
                 double far_m) {
    constexpr std::size_t kPart_bytes = 40000;  // 4 / 3 of them as text, below a segment's most
    const std::string picture = encoded_as(depth, ".png");
    save_text(file,
              gdepth_photo(encoded_as(colour, ".jpg"),
                           "GDepth:Format=\"RangeInverse\" GDepth:Near=\"" +
                               number_text(near_m, 4) + "\" GDepth:Far=\"" + number_text(far_m, 4) +
                               "\" GDepth:Units=\"m\" GDepth:MeasureType=\"OpticalAxis\" "
                               "GDepth:Mime=\"image/png\" ",
                           picture, {}, picture.size() / kPart_bytes + 1));
}

void save_multi_picture(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth) {
    save_text(file, multi_picture(encoded_as(colour, ".jpg"), {encoded_as(depth, ".jpg")}));
}

void save_heic(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth) {
    make_folder_of(file);
    const auto picture_of = [&file](const std::string& name, const cv::Mat& content) {
        const fs::path still = file.parent_path() / ("." + name + ".png");
        save(still, content);
        return "movie=" + still.string();
    };
    write_photo({.colour = picture_of("colour", colour), .depth = picture_of("depth", depth)},
                file);
    fs::remove(file.parent_path() / ".colour.png");
    fs::remove(file.parent_path() / ".depth.png");
}

// Videos.

void save_video(const fs::path& file, const std::vector<Track>& tracks,
                const std::string& options) {
    make_folder_of(file);
    std::string inputs;
    std::string outputs;
    for (std::size_t k = 0; k < tracks.size(); ++k) {
        const cv::Mat& first = tracks[k].pictures.front();
        const fs::path raw = file.string() + "." + std::to_string(k) + ".raw";
        std::ofstream out(raw, std::ios::binary);
        for (const cv::Mat& picture : tracks[k].pictures) out << bytes_of(picture.clone());
        std::string format = "bgr24";
        if (first.type() == CV_8UC1) format = "gray";
        if (first.type() == CV_16UC1) format = "gray16le";
        inputs += "-f rawvideo -r " + number_text(tracks[k].frames_per_s, 3) + " -pix_fmt " +
                  format + " -s " + std::to_string(first.cols) + "x" + std::to_string(first.rows) +
                  " -i '" + raw.string() + "' ";
        std::string encoding = tracks[k].encoding;
        if (tracks.size() > 1) {  // each option is for this track alone
            const std::string own = ":v:" + std::to_string(k) + " ";
            for (auto at = encoding.find(":v "); at != std::string::npos;
                 at = encoding.find(":v ", at + own.size()))
                encoding.replace(at, 3, own);
            outputs += "-map " + std::to_string(k) + " ";
        }
        outputs += encoding + " ";
    }
    ffmpeg(inputs + outputs + "-fps_mode passthrough " + options + " '" + file.string() + "'");
    for (std::size_t k = 0; k < tracks.size(); ++k)
        fs::remove(file.string() + "." + std::to_string(k) + ".raw");
}

// Bags.

BagMessage image_message(const std::string& topic, double time_s, const std::string& encoding,
                         const cv::Mat& picture) {
    const int step = static_cast<int>(picture.elemSize()) * picture.cols;
    return {topic, "Image", time_s,
            image(time_s, picture.cols, picture.rows, encoding, step, bytes_of(picture.clone()))};
}

void save_bag(const fs::path& file, const std::vector<BagMessage>& messages) {
    make_folder_of(file);
    Bag bag(file, {.ending = file.extension().string(), .packing = "zstd"});
    std::map<std::string, int> topics;
    for (const BagMessage& message : messages) {
        const auto [topic, is_new] = topics.try_emplace(message.topic, 0);
        if (is_new) topic->second = bag.topic(message.topic, message.type);
        bag.add(topic->second, message.data, std::llround(message.time_s * 1e9));
    }
}

}  // namespace dibhr::test::zoo
