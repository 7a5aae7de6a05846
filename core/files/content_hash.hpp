// SHA-256 of bytes and files: identifies content whose file may have been renamed or changed.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

struct AVSHA;

namespace dibhr {

/// The sum of bytes that are added one after the other.
class Sha256 {
  public:
    Sha256();
    void add(std::span<const std::uint8_t> bytes);
    /// 64 hexadecimal digits. Ends the sum.
    [[nodiscard]] std::string digits();

  private:
    struct Free {
        void operator()(AVSHA* state) const noexcept;
    };
    std::unique_ptr<AVSHA, Free> state_;
};

/// A file and its content.
struct FileContent {
    std::filesystem::path file{};
    std::uint64_t bytes{0};
    std::string sha256{};         ///< of all bytes after the first `head_bytes`
    std::uint64_t head_bytes{0};
};

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::span<const std::uint8_t> bytes);

/// The sum of the file after its first `head_bytes`; of a folder, of the names and the bytes of all
/// its files, in order. Throws InputError or std::filesystem::filesystem_error when it cannot be
/// read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file,
                                         std::uint64_t head_bytes = 0);

/// The same; nothing once `stop` is true.
[[nodiscard]] std::optional<std::string> sha256_of_file(const std::filesystem::path& file,
                                                        const std::atomic<bool>& stop);

/// The bytes of the file, or of all files in a folder. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::uintmax_t content_bytes(const std::filesystem::path& file);

}  // namespace dibhr
