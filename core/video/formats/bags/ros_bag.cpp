// Chooses a topic of a bag, sorts its messages by time, and decodes them.
#include "core/video/formats/bags/ros_bag.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/bags/bag_file.hpp"
#include "core/video/formats/bags/ros_messages.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kLongestBag_ns = 1'000'000'000'000'000;  ///< a million seconds

// Bounds of the recording time: sums and differences of such times do not overflow.
constexpr std::int64_t kFirst_ns = 0;
constexpr std::int64_t kLast_ns = 4'000'000'000'000'000'000;

/// The stamps of all messages are read where no more must be unpacked for them, in half a second.
constexpr std::uint64_t kMostUnpacked_bytes = std::uint64_t{1} << 29;

using BagFiles = std::vector<std::unique_ptr<BagFile>>;

/// Also of a packed bag, which is refused with advice, unless it is there unpacked, too.
bool is_bag_name(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    if (name.ends_with(".zstd"))
        return is_bag_name(file.stem()) && !is_file(file.parent_path() / file.stem());
    return name.ends_with(".db3") || name.ends_with(".mcap");
}

/// Opens the file, or the files of a folder.
BagFiles opened_bags(const fs::path& place) {
    BagFiles files;
    if (!is_folder(place)) {
        files.push_back(open_bag_file(place));
        return files;
    }
    for (const fs::path& entry : entries_of(place)) {
        if (is_bag_name(entry)) files.push_back(open_bag_file(entry));
    }
    return files;
}

bool is_compressed(const Topic& topic) {
    return topic.type == "sensor_msgs/msg/CompressedImage";
}

bool is_of_pictures(const Topic& topic) {
    return topic.type == "sensor_msgs/msg/Image" || is_compressed(topic);
}

/// The data of the first message of a topic of that name and type.
std::optional<std::vector<std::uint8_t>> first_message(BagFiles& files, const Topic& wanted) {
    for (const auto& file : files) {
        for (const Topic& topic : file->topics()) {
            if (topic.name != wanted.name || topic.type != wanted.type) continue;
            const auto messages = file->messages(topic.id, 1);
            if (!messages.empty()) return file->data(messages.front().row);
        }
    }
    return std::nullopt;
}

/// How likely a topic is of that role; 0: impossible.
int likelihood(const Topic& topic, const RosImage& image, PictureRole role) {
    const std::string name = lower_case(topic.name);
    const auto says = [&name](std::string_view word) {
        return name.find(word) != std::string::npos;
    };
    const RosPicture kind = kind_of(image);
    const int plain = image.compressed ? 0 : 1;
    if (role == PictureRole::depth) {
        const bool named = says("depth");
        if (kind != RosPicture::depth || (image.encoding == "mono16" && !named)) return 0;
        return (says("aligned") || says("registered") ? 6 : named ? 4 : 2) + plain;
    }
    if (kind != RosPicture::colour && kind != RosPicture::grey) return 0;
    if (says("depth")) return 0;
    return (kind == RosPicture::grey ? 2 : says("color") || says("rgb") ? 6 : 4) + plain;
}

struct Choice {
    Topic topic{};
    std::string others{};    ///< all picture topics with their encodings or types, for a message
    bool has_clouds{false};  ///< of points
};

/// The most likely topic; an empty name when none is of that role.
Choice chosen(BagFiles& files, PictureRole role) {
    Choice choice;
    int best = 0;
    std::vector<std::string> seen;
    for (const auto& file : files) {
        for (const Topic& topic : file->topics()) {
            choice.has_clouds |= topic.type.ends_with("PointCloud2");
            const bool is_foreign =
                !is_of_pictures(topic) && lower_case(topic.type).find("image") != std::string::npos;
            if (!(is_of_pictures(topic) || is_foreign) ||
                std::find(seen.begin(), seen.end(), topic.name) != seen.end())
                continue;
            seen.push_back(topic.name);
            const auto data = is_foreign ? std::nullopt : first_message(files, topic);
            const auto image = data ? ros_image(*data, is_compressed(topic)) : std::nullopt;
            if (!image && !is_foreign) continue;
            choice.others += (choice.others.empty() ? "" : ", ") + topic.name + ": " +
                             (image ? image->encoding : topic.type);
            if (!image) continue;
            const int now = likelihood(topic, *image, role);
            if (now > best) choice.topic = topic;
            best = std::max(best, now);
        }
    }
    return choice;
}

/// "/camera/depth/image_rect_raw/compressedDepth" has its camera at "/camera/depth/camera_info".
std::string camera_info_of(std::string topic) {
    for (const std::string_view transport : {"/compressedDepth", "/compressed"}) {
        if (topic.ends_with(transport)) topic.resize(topic.size() - transport.size());
    }
    return topic.substr(0, topic.rfind('/') + 1) + "camera_info";
}

struct Stamped {
    std::size_t file;
    std::int64_t row;
    std::int64_t time_ns;
};

/// By the clock of its sender; not positive: it has none.
std::int64_t stamp_of(const BagFiles& files, const Stamped& message) {
    const auto head = files[message.file]->data(message.row, kStampBytes);
    return ros_stamp_ns(head).value_or(0);
}

/// Sorts by time, and keeps each time once.
void put_in_order(std::vector<Stamped>& messages) {
    std::stable_sort(messages.begin(), messages.end(),
                     [](const Stamped& a, const Stamped& b) { return a.time_ns < b.time_ns; });
    const auto same = [](const Stamped& a, const Stamped& b) { return a.time_ns == b.time_ns; };
    messages.erase(std::unique(messages.begin(), messages.end(), same), messages.end());
}

/// How much later than recorded the messages were stamped, as the median of some of them; zero
/// where one of these has no stamp.
std::int64_t stamp_delay_ns(const BagFiles& files, const std::vector<Stamped>& recorded) {
    constexpr std::size_t kSamples = 31;
    std::vector<std::int64_t> delays_ns;
    for (std::size_t k = 0; k < kSamples && !recorded.empty(); ++k) {
        const Stamped& message = recorded[k * recorded.size() / kSamples];
        const std::int64_t stamp_ns = stamp_of(files, message);
        if (stamp_ns <= 0) return 0;
        delays_ns.push_back(stamp_ns - message.time_ns);
    }
    const auto middle = delays_ns.begin() + static_cast<std::ptrdiff_t>(delays_ns.size() / 2);
    std::nth_element(delays_ns.begin(), middle, delays_ns.end());
    return middle == delays_ns.end() ? 0 : *middle;
}

struct TimedMessages {
    std::vector<Stamped> messages{};
    bool are_recording_times{false};  ///< as the bag is too long to read all stamps
};

/// The messages by their stamps, or, where one has none, all by their time of recording.
TimedMessages messages_of(const BagFiles& files, const Topic& wanted) {
    std::vector<Stamped> recorded;
    std::uint64_t unpacked_bytes = 0;
    for (std::size_t k = 0; k < files.size(); ++k) {
        for (const Topic& topic : files[k]->topics()) {
            if (topic.name != wanted.name || topic.type != wanted.type) continue;
            for (const auto& message : files[k]->messages(topic.id, kMostPictures)) {
                recorded.push_back(
                    {k, message.row, std::clamp(message.recorded_ns, kFirst_ns, kLast_ns)});
                unpacked_bytes += message.unpacked_bytes;
            }
        }
    }
    if (unpacked_bytes > kMostUnpacked_bytes) {
        const std::int64_t delay_ns = stamp_delay_ns(files, recorded);
        for (Stamped& message : recorded)
            message.time_ns = std::clamp(message.time_ns + delay_ns, kFirst_ns, kLast_ns);
        put_in_order(recorded);
        return {std::move(recorded), true};
    }
    std::vector<Stamped> stamped = recorded;
    for (Stamped& message : stamped) message.time_ns = stamp_of(files, message);
    const bool have_all_stamps = std::all_of(
        stamped.begin(), stamped.end(), [](const Stamped& message) { return message.time_ns > 0; });
    std::vector<Stamped>& taken = have_all_stamps ? stamped : recorded;
    put_in_order(taken);
    return {std::move(taken), false};
}

class RosTopic : public IndexedPictures {
  public:
    RosTopic(const fs::path& place, BagFiles files, Topic topic, PictureRole role)
        : files_(std::move(files)), topic_(std::move(topic)) {
        facts_.file = place;
        TimedMessages timed = messages_of(files_, topic_);
        messages_ = std::move(timed.messages);
        if (messages_.empty()) throw InputError(unreadable());
        for (const auto& file : files_) add_clause(facts_.notice, file->notice());
        facts_.timing.text = timed.are_recording_times ? "when its messages were recorded"
                                                       : "stamps of the messages";
        if (timed.are_recording_times)
            add_clause(facts_.notice,
                       "the times of " + one_line(topic_.name, 100) +
                           " are those of its recording: the bag is too long to read every stamp");
        last_ = decoded(messages_.front());
        if (last_.empty()) throw InputError(unreadable());
        require_size(place, last_.cols, last_.rows);
        describe_picture();
        describe_times();
        if (role == PictureRole::depth) describe_levels();
    }

  private:
    /// Where a picture cannot be decoded, reports it and returns the one before it.
    [[nodiscard]] cv::Mat picture(std::size_t at) override {
        try {
            const cv::Mat now = decoded(messages_[at]);
            if (now.empty() || now.type() != last_.type())
                report_trouble(unreadable());
            else
                last_ = now;
        } catch (const InputError& error) {
            report_trouble(error.what());
        }
        return last_;
    }

    [[nodiscard]] std::string unreadable() const {
        return shown(facts_.file) + " holds a picture of the topic " + one_line(topic_.name, 100) +
               " that cannot be decoded, or is larger than 33 megapixels: record it again";
    }

    /// Empty when the message is broken.
    [[nodiscard]] cv::Mat decoded(const Stamped& message) {
        const std::vector<std::uint8_t> data = files_[message.file]->data(message.row);
        const auto image = ros_image(data, is_compressed(topic_));
        if (!image) return {};
        if (facts_.codec.empty()) facts_.codec = "ROS " + one_line(image->encoding, 40);
        return picture_of(*image);
    }

    void describe_picture() {
        facts_.columns = last_.cols;
        facts_.rows = last_.rows;
        facts_.channels = last_.channels();
        facts_.bits = last_.depth() == CV_32F ? kRealBits : last_.depth() == CV_16U ? 16 : 8;
    }

    void describe_times() {
        const std::int64_t length_ns = messages_.back().time_ns - messages_.front().time_ns;
        if (length_ns > kLongestBag_ns)
            throw InputError(shown(facts_.file) +
                             " has messages that are years apart: record it "
                             "again with clocks that are set");
        std::vector<double> times_s;
        times_s.reserve(messages_.size());
        for (const Stamped& message : messages_)
            times_s.push_back(static_cast<double>(message.time_ns - messages_.front().time_ns) *
                              1e-9);
        take_times(std::move(times_s));
        facts_.start_s = static_cast<double>(messages_.front().time_ns) * 1e-9;
    }

    void describe_levels() {
        // Millimetres in whole numbers, metres in real ones: www.ros.org/reps/rep-0118.html.
        facts_.findings.push_back(
            finding_of_metadata({.unit = facts_.bits == kRealBits ? DepthUnit::m : DepthUnit::mm,
                                 .scale = 1.0,
                                 .no_data = std::vector{0.0}},
                                "ROS topic " + one_line(topic_.name, 100)));
        describe_cameras();
    }

    /// The message on the camera of that topic's pictures; nothing when the bag has none.
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> camera_info_message(
        const std::string& topic) {
        return first_message(files_, {0, camera_info_of(topic), "sensor_msgs/msg/CameraInfo"});
    }

    void describe_cameras() {
        const auto info = camera_info_message(topic_.name);
        if (!info) return;
        const RosCamera depth = ros_camera(*info).value_or(RosCamera{});
        const FittedCamera fitted =
            fit_camera(depth.camera.intrinsics(), depth.size, {facts_.columns, facts_.rows});
        add_clause(facts_.notice, fitted.notice);
        if (!fitted.camera) return;
        facts_.findings.back().statement.intrinsics = fitted.camera;
        facts_.lens = depth.camera.lens();
        const std::string colour_topic = chosen(files_, PictureRole::colour).topic.name;
        const auto colour_info = camera_info_message(colour_topic);
        const auto colour = colour_info ? ros_camera(*colour_info) : std::nullopt;
        if (!colour || colour->frame == depth.frame || colour->size.empty()) return;
        facts_.other_camera = true;
        // The topic in which RealSense's node publishes the placement.
        const std::string extrinsics_topic =
            colour_topic.substr(0, colour_topic.rfind("/color/")) + "/extrinsics/depth_to_color";
        const auto message =
            first_message(files_, {0, extrinsics_topic, "realsense2_camera_msgs/msg/Extrinsics"});
        if (const auto placement = message ? ros_placement(*message) : std::nullopt)
            facts_.cameras = std::make_shared<const CameraPair>(
                CameraPair{CameraModel(*fitted.camera, facts_.lens), colour->camera, colour->size,
                           *placement, "ROS topic " + one_line(extrinsics_topic, 100)});
    }

    BagFiles files_;
    Topic topic_;
    std::vector<Stamped> messages_{};
    cv::Mat last_{};
};

}  // namespace

bool is_ros_bag(const fs::path& place, std::string_view head) {
    if (!is_folder(place)) return is_bag_file(place, head);
    const std::vector<fs::path> entries = entries_of(place);
    return std::any_of(entries.begin(), entries.end(), is_bag_name);
}

bool ros_bag_holds(const fs::path& place, PictureRole role) {
    BagFiles files = opened_bags(place);
    return !chosen(files, role).topic.name.empty();
}

std::unique_ptr<PictureSource> open_ros_topic(const fs::path& place, PictureRole role) {
    BagFiles files = opened_bags(place);
    Choice choice = chosen(files, role);
    if (choice.topic.name.empty()) {
        const std::string none =
            choice.has_clouds ? "only point clouds" : "none of pictures at all";
        throw InputError(
            shown(place) + " holds no topic of " +
            (role == PictureRole::depth ? "depth" : "colour") + " pictures (" +
            (choice.others.empty() ? none : one_line(choice.others, 300)) +
            "): record also the topic of the camera's depth images (16UC1 or 32FC1), and that of "
            "its colour images (rgb8 or compressed)");
    }
    return std::make_unique<RosTopic>(place, std::move(files), std::move(choice.topic), role);
}

}  // namespace dibhr
