// Reads topics and messages of one SQLite file of a ROS 2 bag; inside the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/sqlite/database.hpp"

namespace dibhr {

struct Topic {
    std::int64_t id{0};
    std::string name{};
    std::string type{};
};

/// A message's row in its file, and when it was recorded.
struct BagMessage {
    std::int64_t row{0};
    std::int64_t recorded_ns{0};
};

/// Reads the file as untrusted input: executes nothing from it, checks every cell, and bounds every
/// query. Every method throws InputError when the file is damaged.
class BagFile {
  public:
    /// Throws InputError when it is no bag.
    explicit BagFile(const std::filesystem::path& file);
    BagFile(const BagFile&) = delete;
    BagFile& operator=(const BagFile&) = delete;

    [[nodiscard]] std::vector<Topic> topics() const;

    /// In the order of recording, at most `most`.
    [[nodiscard]] std::vector<BagMessage> messages(std::int64_t topic, std::size_t most) const;

    /// The first `most` bytes of a message, or all of it.
    [[nodiscard]] std::vector<std::uint8_t> data(
        std::int64_t row, std::size_t most = std::numeric_limits<std::size_t>::max());

  private:
    void check_tables() const;
    [[noreturn]] void refuse(std::string_view why) const;

    std::filesystem::path file_;
    Database database_;
    BlobReader message_;
};

}  // namespace dibhr
