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

/// Of the whole file, in pieces; of a folder, of the names in it and the bytes of all its files, in
/// order. Throws InputError or std::filesystem::filesystem_error when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

/// The same; nothing once `stop` is true.
[[nodiscard]] std::optional<std::string> sha256_of_file(const std::filesystem::path& file,
                                                        const std::atomic<bool>& stop);

/// How many bytes that is of, without the names. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::uintmax_t content_bytes(const std::filesystem::path& file);

}  // namespace dibhr
