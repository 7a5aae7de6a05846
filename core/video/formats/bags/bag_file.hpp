// The interface of the files of a ROS 2 bag: topics and messages, in SQLite or MCAP; inside the
// room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

inline constexpr std::size_t kLargestMessage_bytes = kMostPictureBytes + (1 << 16);

struct Topic {
    std::int64_t id{0};
    std::string name{};
    std::string type{};  ///< "sensor_msgs/msg/Image"; of an encoding other than CDR with its name
};

/// A message's place in its file, and when it was recorded.
struct BagMessage {
    std::int64_t row{0};  ///< has a meaning for that file alone
    std::int64_t recorded_ns{0};
    /// How much must be unpacked to reach it from the topic's message before it.
    std::uint64_t unpacked_bytes{0};
};

/// Reads the file as untrusted input: executes nothing from it, and checks each size that it claims
/// before memory is allocated. Every method throws InputError when the file is damaged.
class BagFile {
  public:
    virtual ~BagFile() = default;
    BagFile(const BagFile&) = delete;
    BagFile& operator=(const BagFile&) = delete;

    [[nodiscard]] virtual std::vector<Topic> topics() = 0;

    /// In the order of recording, at most `most`.
    [[nodiscard]] virtual std::vector<BagMessage> messages(std::int64_t topic,
                                                           std::size_t most) = 0;

    /// The first `most` bytes of a message, at least 4, or all of it. Unpacks messages that the
    /// recorder packed one by one (--compression-mode message).
    [[nodiscard]] std::vector<std::uint8_t> data(
        std::int64_t row, std::size_t most = std::numeric_limits<std::size_t>::max());

    /// One sentence about what is missing in the file; empty: it is whole.
    [[nodiscard]] virtual std::string notice() const { return {}; }

  protected:
    explicit BagFile(std::filesystem::path file) : file_(std::move(file)) {}

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[noreturn]] void refuse(std::string_view why) const;

  private:
    /// The first `most` bytes of a message as they are in the file.
    [[nodiscard]] virtual std::vector<std::uint8_t> stored(std::int64_t row, std::size_t most) = 0;

    std::filesystem::path file_;
};

/// Whether a file begins as bags do; `head`: its first bytes.
[[nodiscard]] bool is_bag_file(const std::filesystem::path& file, std::string_view head);

/// Throws InputError when it is no bag.
[[nodiscard]] std::unique_ptr<BagFile> open_bag_file(const std::filesystem::path& file);

// The two forms; each throws InputError when the file is not of it.
[[nodiscard]] std::unique_ptr<BagFile> open_sqlite_bag(const std::filesystem::path& file);
[[nodiscard]] std::unique_ptr<BagFile> open_mcap_bag(const std::filesystem::path& file);

}  // namespace dibhr
