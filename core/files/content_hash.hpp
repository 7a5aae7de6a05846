// SHA-256 of bytes and files: names content that may have been renamed or changed.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace dibhr {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::span<const std::uint8_t> bytes);

/// Of the whole file, in pieces. Throws InputError when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

/// The same; nothing once `stop` is true.
[[nodiscard]] std::optional<std::string> sha256_of_file(const std::filesystem::path& file,
                                                        const std::atomic<bool>& stop);

}  // namespace dibhr
