// Bags of ROS 2 as their recorders write them: messages in CDR, files in SQLite and in MCAP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dibhr::test {

/// Little-endian CDR.
class CdrWriter {
  public:
    template <typename Number>
    CdrWriter& number(Number value) {
        while ((bytes_.size() - 4) % sizeof value != 0) bytes_.push_back('\0');
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes_.append(raw, sizeof value);
        return *this;
    }
    CdrWriter& text(const std::string& letters);
    CdrWriter& sequence(const std::string& data);
    CdrWriter& header(double stamp_s, const std::string& frame = "camera_optical_frame");
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_{"\0\1\0\0", 4};
};

/// A sensor_msgs/msg/Image.
[[nodiscard]] std::string image(double stamp_s, int columns, int rows, const std::string& encoding,
                                int step, const std::string& data, bool big_endian = false);

/// One of 16UC1 whose pixels all have that level.
[[nodiscard]] std::string depth_image(double stamp_s, int level, int columns = 8, int rows = 6);

/// Packed with "zstd" or "lz4".
[[nodiscard]] std::string packed_bytes(const std::string& data, const std::string& packing);

/// How a bag is stored.
struct BagForm {
    std::string ending{".mcap"};  ///< or ".db3", for which the others mean nothing
    std::string packing{};        ///< of chunks: "zstd", "lz4", or an empty text
    bool chunks{true};
    bool message_index{true};
    bool summary{true};
    bool finished{true};           ///< false: the recorder crashed
    std::size_t chunk_bytes{400};  ///< a chunk ends with the message that makes it as long

    [[nodiscard]] std::string name() const;
};

/// What MCAP's writers may be told to write; and SQLite, too.
[[nodiscard]] std::vector<BagForm> mcap_forms();
[[nodiscard]] std::vector<BagForm> bag_forms();

class BagWriter {
  public:
    virtual ~BagWriter() = default;
    virtual int topic(const std::string& name, const std::string& type,
                      const std::string& encoding) = 0;
    virtual void add(int topic, const std::string& data, std::int64_t recorded_ns) = 0;
    /// On a database; nothing else takes it.
    virtual void run(const std::string& /*sql*/) {}
};

/// A file that is whole when the object is gone.
class Bag {
  public:
    explicit Bag(const std::filesystem::path& file, const BagForm& form = {.ending = ".db3"});

    int topic(const std::string& name, const std::string& type,
              const std::string& package = "sensor_msgs") {
        return writer_->topic(name, package + "/msg/" + type, "cdr");
    }
    /// Of any type and encoding.
    int other_topic(const std::string& name, const std::string& type, const std::string& encoding) {
        return writer_->topic(name, type, encoding);
    }
    void add(int topic, const std::string& data, std::int64_t recorded_ns = 7) {
        writer_->add(topic, data, recorded_ns);
    }
    void run(const std::string& sql) { writer_->run(sql); }

  private:
    std::unique_ptr<BagWriter> writer_;
};

}  // namespace dibhr::test
