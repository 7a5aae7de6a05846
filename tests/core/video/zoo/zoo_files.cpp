// Pictures by OpenCV and OpenEXR, videos by ffmpeg, bags by SQLite; the rest byte by byte.
#include "tests/core/video/zoo/zoo_files.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/files/plain_text.hpp"
#include "tests/core/video/clips.hpp"
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
    levels.setTo(none, farness != farness);
    return levels;
}

cv::Mat disparity_of(const cv::Mat& farness, double highest) {
    const double nearest = ends_of(farness).first;
    cv::Mat disparity;
    cv::divide(highest * nearest, without_nan(farness, 1e9), disparity);
    disparity.setTo(0.0, farness != farness);
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

void save_tiff(const fs::path& file, const cv::Mat& numbers, const std::string& no_data) {
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
    std::vector<Tag> tags{number(256, columns),
                          number(257, rows),
                          number(258, 32),
                          number(259, 1),
                          number(262, 1),
                          number(273, 8),
                          number(277, 1),
                          number(278, rows),
                          number(279, static_cast<std::uint32_t>(data.size())),
                          number(339, 3)};
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

namespace {

std::string encoded_as(const std::string& ending, const cv::Mat& picture) {
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(ending, picture, bytes)) throw std::runtime_error("not encoded");
    return {bytes.begin(), bytes.end()};
}

std::string segment(int marker, const std::string& content) {
    std::string bytes{static_cast<char>(0xff), static_cast<char>(marker)};
    append_bytes(bytes, static_cast<std::uint16_t>(content.size() + 2), false);
    return bytes + content;
}

/// A JPEG file with these segments at its beginning.
std::string with_segments(const std::string& jpeg, const std::string& segments) {
    return jpeg.substr(0, 2) + segments + jpeg.substr(2);
}

}  // namespace

void save_gdepth(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth, double near_m,
                 double far_m) {
    const std::string guid = "0123456789ABCDEF0123456789ABCDEF";
    const std::string about =
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
        "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
        "<rdf:Description rdf:about=\"\" ";
    const std::string end = "/></rdf:RDF></x:xmpmeta>";
    const std::string gdepth = "xmlns:GDepth=\"http://ns.google.com/photos/1.0/depthmap/\" ";
    const std::string usual = about + gdepth +
                              "xmlns:xmpNote=\"http://ns.adobe.com/xmp/note/\" "
                              "GDepth:Format=\"RangeInverse\" GDepth:Near=\"" +
                              number_text(near_m, 4) + "\" GDepth:Far=\"" + number_text(far_m, 4) +
                              "\" GDepth:Units=\"m\" GDepth:MeasureType=\"OpticalAxis\" "
                              "GDepth:Mime=\"image/png\" xmpNote:HasExtendedXMP=\"" +
                              guid + "\"" + end;
    const std::string extended =
        about + gdepth + "GDepth:Data=\"" + base64_text(encoded_as(".png", depth)) + "\"" + end;
    std::string segments =
        segment(0xe1, std::string("http://ns.adobe.com/xap/1.0/") + '\0' + usual);
    constexpr std::size_t kPart_bytes = 65000;
    for (std::size_t at = 0; at < extended.size(); at += kPart_bytes) {
        std::string part = std::string("http://ns.adobe.com/xmp/extension/") + '\0' + guid;
        append_bytes(part, static_cast<std::uint32_t>(extended.size()), false);
        append_bytes(part, static_cast<std::uint32_t>(at), false);
        segments += segment(0xe1, part + extended.substr(at, kPart_bytes));
    }
    save_text(file, with_segments(encoded_as(".jpg", colour), segments));
}

void save_multi_picture(const fs::path& file, const cv::Mat& colour, const cv::Mat& depth) {
    const std::string first = encoded_as(".jpg", colour);
    const std::string second = encoded_as(".jpg", depth);
    const auto list = [&](std::size_t first_bytes, std::size_t second_at) {
        std::string bytes = std::string("MPF") + '\0' + "MM";  // offsets are from "MM" on
        const auto add16 = [&](int value) {
            append_bytes(bytes, static_cast<std::uint16_t>(value), false);
        };
        const auto add32 = [&](std::size_t value) {
            append_bytes(bytes, static_cast<std::uint32_t>(value), false);
        };
        add16(42);
        add32(8);
        add16(3);
        add16(0xb000);  // version
        add16(7);
        add32(4);
        bytes += "0100";
        add16(0xb001);  // number of pictures
        add16(4);
        add32(1);
        add32(2);
        add16(0xb002);  // their list
        add16(7);
        add32(32);
        add32(8 + 2 + 3 * 12 + 4);
        add32(0);
        add32(0x30000);  // the photo
        add32(first_bytes);
        add32(0);
        add32(0);
        add32(0);  // of no stated kind
        add32(second.size());
        add32(second_at);
        add32(0);
        return segment(0xe2, bytes);
    };
    const std::size_t first_bytes = first.size() + list(0, 0).size();
    constexpr std::size_t kBeforeList = 2 + 4 + 4;  // SOI, marker and length, "MPF"
    save_text(file, with_segments(first, list(first_bytes, first_bytes - kBeforeList)) + second);
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

namespace {

std::int64_t in_ns(double seconds) {
    return std::llround(seconds * 1e9);
}

/// Little-endian CDR, after its four bytes.
class Cdr {
  public:
    template <typename Number>
    void add(Number number) {
        while ((bytes_.size() - 4) % sizeof number != 0) bytes_.push_back('\0');
        append_bytes(bytes_, number);
    }
    void add_text(const std::string& text) {
        add(static_cast<std::uint32_t>(text.size() + 1));
        bytes_ += text + '\0';
    }
    void add_bytes(const std::string& data) {
        add(static_cast<std::uint32_t>(data.size()));
        bytes_ += data;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_{"\0\1\0\0", 4};
};

/// Topics in the order in which they come first, each with its type.
std::vector<std::pair<std::string, std::string>> topics_of(
    const std::vector<BagMessage>& messages) {
    std::vector<std::pair<std::string, std::string>> topics;
    std::set<std::string> known;
    for (const BagMessage& message : messages)
        if (known.insert(message.topic).second) topics.emplace_back(message.topic, message.type);
    return topics;
}

std::size_t number_of_topic(const std::vector<std::pair<std::string, std::string>>& topics,
                            const BagMessage& message) {
    std::size_t at = 0;
    while (topics[at].first != message.topic) ++at;
    return at + 1;
}

/// A text or a record after its length.
template <typename Length>
std::string sized(const std::string& content) {
    std::string bytes;
    append_bytes(bytes, static_cast<Length>(content.size()));
    return bytes + content;
}

std::string mcap_record(int opcode, const std::string& content) {
    return static_cast<char>(opcode) + sized<std::uint64_t>(content);
}

template <typename... Numbers>
std::string numbers_as_bytes(Numbers... numbers) {
    std::string bytes;
    (append_bytes(bytes, numbers), ...);
    return bytes;
}

}  // namespace

BagMessage image_message(const std::string& topic, double time_s, const std::string& encoding,
                         const cv::Mat& picture) {
    Cdr cdr;
    const double whole_s = std::floor(time_s);
    cdr.add(static_cast<std::int32_t>(whole_s));
    cdr.add(static_cast<std::uint32_t>(in_ns(time_s - whole_s)));
    cdr.add_text("camera_color_optical_frame");
    cdr.add(static_cast<std::uint32_t>(picture.rows));
    cdr.add(static_cast<std::uint32_t>(picture.cols));
    cdr.add_text(encoding);
    cdr.add(std::uint8_t{0});
    cdr.add(
        static_cast<std::uint32_t>(picture.elemSize() * static_cast<std::size_t>(picture.cols)));
    cdr.add_bytes(bytes_of(picture.clone()));
    return {topic, "Image", time_s, cdr.bytes()};
}

void save_bag(const fs::path& file, const std::vector<BagMessage>& messages) {
    make_folder_of(file);
    sqlite3* database = nullptr;
    if (sqlite3_open(file.c_str(), &database) != SQLITE_OK) throw std::runtime_error("no bag");
    const auto run = [database](const std::string& sql) {
        sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
    };
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
    run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp "
        "INTEGER NOT NULL, data BLOB NOT NULL)");
    run("BEGIN");
    const auto topics = topics_of(messages);
    for (const auto& topic : topics)
        run("INSERT INTO topics(name, type, serialization_format, offered_qos_profiles) VALUES('" +
            topic.first + "', 'sensor_msgs/msg/" + topic.second + "', 'cdr', '')");
    for (const BagMessage& message : messages) {
        sqlite3_stmt* insert = nullptr;
        sqlite3_prepare_v2(database,
                           "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1,
                           &insert, nullptr);
        sqlite3_bind_int(insert, 1, static_cast<int>(number_of_topic(topics, message)));
        sqlite3_bind_int64(insert, 2, in_ns(message.time_s));
        sqlite3_bind_blob(insert, 3, message.data.data(), static_cast<int>(message.data.size()),
                          SQLITE_STATIC);
        sqlite3_step(insert);
        sqlite3_finalize(insert);
    }
    run("COMMIT");
    sqlite3_close(database);
}

/// One chunk, not compressed, and no index: mcap.dev/spec.
void save_mcap(const fs::path& file, const std::vector<BagMessage>& messages) {
    using Text = std::uint32_t;
    const auto topics = topics_of(messages);
    std::string records;
    for (std::size_t k = 0; k < topics.size(); ++k) {
        const auto id = static_cast<std::uint16_t>(k + 1);
        records += mcap_record(3, numbers_as_bytes(id) +
                                      sized<Text>("sensor_msgs/msg/" + topics[k].second) +
                                      sized<Text>("ros2msg") + sized<Text>(""));
        records += mcap_record(4, numbers_as_bytes(id, id) + sized<Text>(topics[k].first) +
                                      sized<Text>("cdr") + sized<Text>(""));
    }
    for (std::size_t k = 0; k < messages.size(); ++k) {
        const auto time_ns = static_cast<std::uint64_t>(in_ns(messages[k].time_s));
        const auto topic = static_cast<std::uint16_t>(number_of_topic(topics, messages[k]));
        records += mcap_record(
            5, numbers_as_bytes(topic, static_cast<std::uint32_t>(k), time_ns, time_ns) +
                   messages[k].data);
    }
    const auto begin_ns = static_cast<std::uint64_t>(in_ns(messages.front().time_s));
    const auto end_ns = static_cast<std::uint64_t>(in_ns(messages.back().time_s));
    const std::string chunk =
        numbers_as_bytes(begin_ns, end_ns, static_cast<std::uint64_t>(records.size()),
                         std::uint32_t{0}) +
        sized<Text>("") + sized<std::uint64_t>(records);
    const std::string magic("\x89MCAP0\r\n", 8);
    save_text(
        file,
        magic + mcap_record(1, sized<Text>("ros2") + sized<Text>("libmcap")) +
            mcap_record(6, chunk) + mcap_record(15, numbers_as_bytes(std::uint32_t{0})) +
            mcap_record(2, numbers_as_bytes(std::uint64_t{0}, std::uint64_t{0}, std::uint32_t{0})) +
            magic);
}

}  // namespace dibhr::test::zoo
