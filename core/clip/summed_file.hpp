// A file that libav writes, whose content is known when it ends; inside the room.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/av/objects.hpp"
#include "core/files/content_hash.hpp"

namespace dibhr {

/// A power cut takes the last second of it, of a finished one nothing. Sums up what is appended
/// behind a head, which alone may be written again: nobody waits for the sum of a large file when
/// it ends.
class SummedFile {
  public:
    /// Writes over the file. Throws InputError.
    explicit SummedFile(std::filesystem::path file);
    ~SummedFile();
    SummedFile(const SummedFile&) = delete;
    SummedFile& operator=(const SummedFile&) = delete;

    /// Where libav is to write; this one's.
    [[nodiscard]] AVIOContext* bytes() const noexcept { return bytes_.get(); }
    /// What was written until now may be written again. Once.
    void end_head();
    /// Throws InputError, e.g. when the disk is full.
    void finish();
    /// Of a finished one; nothing where more than the head was written again.
    [[nodiscard]] std::optional<FileContent> content();

  private:
    static int write(void* file, const std::uint8_t* bytes, int count) noexcept;
    static std::int64_t seek(void* file, std::int64_t to, int from) noexcept;
    bool flush_in_time();
    void sum_up(const std::uint8_t* bytes, std::int64_t count);

    std::filesystem::path file_;
    int descriptor_;
    std::int64_t at_{0};
    std::int64_t size_{0};
    std::optional<std::int64_t> head_{};  ///< its length, once it has ended
    std::int64_t summed_to_{0};
    bool written_again_{false};
    std::chrono::steady_clock::time_point flushed_at_{std::chrono::steady_clock::now()};
    Sha256 sum_{};
    AvOwned<AVIOContext> bytes_{};
};

}  // namespace dibhr
