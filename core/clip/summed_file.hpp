// A file that libav writes, with its hash computed on the way; inside the room.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/av/objects.hpp"
#include "core/files/content_hash.hpp"

namespace dibhr {

/// A power cut loses at most the last second, of a finished file nothing. Hashes the bytes appended
/// behind a head, which alone may be rewritten: so the end of a large file needs no time to hash
/// it.
class SummedFile {
  public:
    /// Overwrites the file. Throws InputError.
    explicit SummedFile(std::filesystem::path file);
    ~SummedFile();
    SummedFile(const SummedFile&) = delete;
    SummedFile& operator=(const SummedFile&) = delete;

    /// The stream for libav to write to; owned by this object.
    [[nodiscard]] AVIOContext* bytes() const noexcept { return bytes_.get(); }
    /// Ends the head: only the bytes up to here may be rewritten. Call it once.
    void end_head();
    /// Throws InputError, e.g. when the disk is full.
    void finish();
    /// Size and hash of a finished file; nothing if more than the head was rewritten.
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
