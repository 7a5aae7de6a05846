// Writes a scene in the forms that people bring it in.
#include "tests/core/video/forms.hpp"

#include <zip.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/core/video/clips.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

int scene_level(int column, int row) {
    return (row * kSceneColumns + column) * 7 % kSceneLevels;
}

float scene_depth(int level) {
    return std::ldexp(1.0F + static_cast<float>(level % 1024) / 1024.0F, level / 1024);
}

cv::Mat scene_levels() {
    cv::Mat levels(kSceneRows, kSceneColumns, CV_32FC1);
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i)
            levels.at<float>(j, i) = static_cast<float>(scene_level(i, j));
    return levels;
}

cv::Mat scene() {
    cv::Mat depth(kSceneRows, kSceneColumns, CV_32FC1);
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i)
            depth.at<float>(j, i) = scene_depth(scene_level(i, j));
    return depth;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                bool fortran) {
    std::string dictionary = "{'descr': '" + type +
                             "', 'fortran_order': " + (fortran ? "True" : "False") +
                             ", 'shape': " + shape + ", }";
    dictionary.resize((dictionary.size() + 11 + 63) / 64 * 64 - 11, ' ');
    std::string file("\x93NUMPY\1\0", 8);
    append_bytes(file, static_cast<std::uint16_t>(dictionary.size() + 1));
    return file + dictionary + "\n" + data;
}

void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& entries,
               bool deflated) {
    zip_t* const archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    if (archive == nullptr) throw std::runtime_error("not written: " + file.string());
    for (const auto& entry : entries) {
        zip_source_t* const bytes =
            zip_source_buffer(archive, entry.second.data(), entry.second.size(), 0);
        const zip_int64_t index = zip_file_add(archive, entry.first.c_str(), bytes, 0);
        zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                                 deflated ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
    }
    if (zip_close(archive) != 0) throw std::runtime_error("not written: " + file.string());
}

std::string pfm(const cv::Mat& picture, const std::string& scale, bool little) {
    std::string bytes = (picture.channels() == 3 ? "PF\n" : "Pf\n") + std::to_string(picture.cols) +
                        " " + std::to_string(picture.rows) + "\n" + scale + "\n";
    for (int j = picture.rows - 1; j >= 0; --j)
        for (int i = 0; i < picture.cols; ++i)
            for (int c = picture.channels() - 1; c >= 0; --c)
                append_bytes(bytes, picture.ptr<float>(j)[i * picture.channels() + c], little);
    return bytes;
}

std::string tiff(int columns, int rows, int bits, int format, bool little, const std::string& data,
                 const std::string& no_data, bool is_geographic,
                 const std::map<int, std::string>& texts) {
    std::string bytes = little ? "II" : "MM";
    const auto add16 = [&](int number) {
        append_bytes(bytes, static_cast<std::uint16_t>(number), little);
    };
    const auto add32 = [&](std::size_t number) {
        append_bytes(bytes, static_cast<std::uint32_t>(number), little);
    };
    add16(42);
    struct Tag {
        int name;
        std::size_t value;
        int type{4};  ///< 32 bits
        std::size_t count{1};
    };
    std::vector<Tag> tags{{256, static_cast<std::size_t>(columns)},
                          {257, static_cast<std::size_t>(rows)},
                          {258, static_cast<std::size_t>(bits)},
                          {259, 1},
                          {262, 1},
                          {273, 8},
                          {277, 1},
                          {278, static_cast<std::size_t>(rows)},
                          {279, data.size()},
                          {339, static_cast<std::size_t>(format)}};
    constexpr int kText = 2;
    constexpr int kShort = 3;
    const std::string mark = no_data + std::string(8 - no_data.size() % 8, '\0');
    const std::size_t after = 8 + data.size();
    if (is_geographic) tags.push_back({34735, after, kShort, 4});
    if (!no_data.empty()) tags.push_back({42113, after + 8, kText, mark.size()});
    std::string behind = mark;
    for (const auto& [name, of_tag] : texts) {
        const std::string padded = of_tag + std::string(8 - of_tag.size() % 8, '\0');
        tags.push_back({name, after + 8 + behind.size(), kText, padded.size()});
        behind += padded;
    }
    std::sort(tags.begin(), tags.end(),
              [](const Tag& one, const Tag& other) { return one.name < other.name; });
    add32(after + 8 + behind.size());
    bytes += data;
    for (const int key : {1, 1, 0, 0}) add16(key);
    bytes += behind;
    add16(static_cast<int>(tags.size()));
    for (const Tag& tag : tags) {
        add16(tag.name);
        add16(tag.type);
        add32(tag.count);
        add32(tag.value);
    }
    add32(0);
    return bytes;
}

namespace {

std::string big(std::uint32_t number) {
    std::string bytes;
    append_bytes(bytes, number, false);
    return bytes;
}

std::string big16(int number) {
    std::string bytes;
    append_bytes(bytes, static_cast<std::uint16_t>(number), false);
    return bytes;
}

std::string byte(int number) {
    return {static_cast<char>(number)};
}

std::string box(const std::string& type, const std::string& content) {
    return big(static_cast<std::uint32_t>(content.size() + 8)) + type + content;
}

std::string full_box(const std::string& type, int version, const std::string& content) {
    return box(type, big(static_cast<std::uint32_t>(version) << 24U) + content);
}

/// A picture coded by HEVC: what its decoder must know first, and its bytes.
struct Coded {
    std::string configuration;  ///< an hvcC box
    std::string bytes;
    std::uint32_t columns;
    std::uint32_t rows;
};

std::uint32_t big_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k)
        number = number << 8U | static_cast<std::uint8_t>(bytes[at + k]);
    return number;
}

/// The box of that type, whole; the first that is found anywhere.
std::string box_in(const std::string& bytes, const std::string& type) {
    const std::size_t at = bytes.find(type) - 4;
    return bytes.substr(at, big_at(bytes, at));
}

Coded coded(const std::string& source, const std::string& format) {
    const TemporaryFolder folder;
    const std::string file = (folder / "one.mp4").string();
    ffmpeg("-f lavfi -i '" + source + "' -frames:v 1 -c:v libx265 -x265-params " +
           "log-level=none:info=0:lossless=1 -tag:v hvc1 -pix_fmt " + format + " '" + file + "'");
    const std::string bytes = read_text(file);
    const std::string entry = box_in(bytes, "hvc1");
    return {box_in(bytes, "hvcC"), box_in(bytes, "mdat").substr(8), big_at(entry, 30) & 0xffffU,
            big_at(entry, 32) & 0xffffU};
}

std::string file_of(const Photo& photo, const std::vector<Coded>& pictures) {
    std::string entries;
    std::string properties;
    std::string owners;
    const int turns = 1 + 2 * static_cast<int>(pictures.size());  // the index of irot
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        const int item = static_cast<int>(k) + 1;
        entries += full_box("infe", 2, big16(item) + big16(0) + "hvc1" + byte(0));
        properties += pictures[k].configuration +
                      full_box("ispe", 0, big(pictures[k].columns) + big(pictures[k].rows));
        owners += big16(item) + byte(k == 0 ? 3 : 4) + byte(0x80 | (2 * item - 1)) +
                  byte(2 * item) + byte(0x80 | turns);
        if (k == 1) owners += byte(0x80 | (turns + 1));
    }
    properties += box("irot", byte(photo.quarter_turns));
    std::string relations;
    if (pictures.size() == 2) {
        properties +=
            full_box("auxC", 0,
                     std::string("urn:mpeg:hevc:2015:auxid:2") + byte(0) + photo.depth_information);
        relations = full_box("iref", 0, box("auxl", big16(2) + big16(1) + big16(1)));
    }
    const int count = static_cast<int>(pictures.size());
    const auto meta = [&](std::size_t data_at) {
        std::string places;
        for (int k = 0; k < count; ++k) {
            const std::string& bytes = pictures[static_cast<std::size_t>(k)].bytes;
            places += big16(k + 1) + big16(0) + big16(1) +
                      big(static_cast<std::uint32_t>(data_at)) +
                      big(static_cast<std::uint32_t>(bytes.size()));
            data_at += bytes.size();
        }
        return full_box(
            "meta", 0,
            full_box("hdlr", 0, big(0) + "pict" + big(0) + big(0) + big(0) + byte(0)) +
                full_box("pitm", 0, big16(1)) + full_box("iinf", 0, big16(count) + entries) +
                relations +
                box("iprp",
                    box("ipco", properties) +
                        full_box("ipma", 0, big(static_cast<std::uint32_t>(count)) + owners)) +
                full_box("iloc", 0, byte(0x44) + byte(0) + big16(count) + places));
    };
    const std::string type = box("ftyp", "heic" + big(0) + "mif1heic");
    std::string data;
    for (const Coded& picture : pictures) data += picture.bytes;
    return type + meta(type.size() + meta(0).size() + 8) + box("mdat", data);
}

}  // namespace

void write_photo(const Photo& photo, const std::filesystem::path& file) {
    std::vector<Coded> pictures{coded(photo.colour, "yuv420p")};
    if (!photo.depth.empty()) pictures.push_back(coded(photo.depth, "gray"));
    write_text(file, file_of(photo, pictures));
}

std::string disparity_information() {
    // 0011: d_min and d_max; 010: type 1; 1: reference view 0; then for each one bit of sign, 7 of
    // the exponent (31 more than it), 5 of the mantissa's length less one, and the mantissa.
    const std::string bits = std::string("0011") + "010" + "1" +
                             "0"
                             "0000000"
                             "00000"
                             "0" +
                             "0"
                             "0011111"
                             "00000"
                             "0" +
                             "1000";
    std::string payload;
    for (std::size_t k = 0; k + 8 <= bits.size(); k += 8)
        payload += byte(std::stoi(bits.substr(k, 8), nullptr, 2));
    const std::string unit = byte(39 << 1) + byte(1) + byte(177) +
                             byte(static_cast<int>(payload.size())) + payload + byte(0x80);
    const std::string sized = big(static_cast<std::uint32_t>(unit.size())) + unit;
    return big(static_cast<std::uint32_t>(sized.size())) + sized;
}

}  // namespace dibhr::test
