// A file with the cleaned depth of a whole recording, packed without loss, and its index.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/files/float_code.hpp"
#include "core/files/output_file.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/frames/object_pool.hpp"

namespace dibhr {

/// The images of a frame; null: there is none.
struct PreparedImages {
    std::shared_ptr<const DepthImage> depth{}, undilated{}, unseen{};
};

/// Where a frame is in the file.
struct PreparedEntry {
    double media_s{0.0};
    std::uint64_t offset{0};
    std::uint64_t bytes{0};
    std::uint64_t sum{0};    ///< of these bytes
    std::uint32_t steps{0};  ///< of its cleaning, a bit each in the order of visit_steps()
    std::uint32_t key{0};    ///< 1: it stands alone; others need the last one that does
};

/// Writes the frames in their order.
class PreparedWriter {
  public:
    /// Throws InputError when the file cannot be made.
    explicit PreparedWriter(const std::filesystem::path& file) : file_(file) {}
    /// A frame that is later than the one before. Throws InputError, e.g. when the disk is full.
    void add(const Frame& frame);
    /// The file appears now. Throws InputError.
    void finish();

  private:
    void put_image(const DepthImage* image, const DepthImage* key);

    OutputFile file_;
    FloatPacker packer_{};
    PreparedImages key_{};  ///< of the last frame that stands alone
    std::vector<PreparedEntry> index_{};
    std::vector<std::uint8_t> bytes_{};
    std::uint64_t offset_{0};
};

/// Reads them in any order. One thread at a time.
class PreparedReader {
  public:
    /// `finger`: of the cleaning of all frames. Throws InputError when the file cannot be read, is
    /// none, or is damaged in its index.
    PreparedReader(std::filesystem::path file, const Fingertip& finger);

    /// Sets depth, what was never seen, and cleaning of the frame at exactly frame.media_s. False:
    /// there is no frame of that time. Throws InputError where the file is damaged.
    [[nodiscard]] bool fill(Frame& frame);
    /// Of all frames, rising [s].
    [[nodiscard]] const std::shared_ptr<const std::vector<double>>& times() const { return times_; }

  private:
    [[nodiscard]] PreparedImages read(std::size_t entry, const PreparedImages& key);
    [[nodiscard]] std::shared_ptr<const DepthImage> take_image(std::span<const std::uint8_t>& rest,
                                                               const DepthImage* key);
    [[noreturn]] void refuse() const;

    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::filesystem::path name_;
    Fingertip finger_;
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<PreparedEntry> index_{};
    std::shared_ptr<const std::vector<double>> times_{};
    FloatUnpacker unpacker_{};
    PreparedImages key_{};
    std::optional<std::size_t> read_{};  ///< the entry whose images these are
    std::vector<std::uint8_t> bytes_{};
    ObjectPool<DepthImage> made_{};
};

}  // namespace dibhr
