// Reads the bytes of numpy arrays: the one of a .npy file, or the named ones of a .npz (zip) file;
// inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct zip;

namespace dibhr {

/// One array: its header, then its numbers.
class ArrayBytes {
  public:
    virtual ~ArrayBytes() = default;
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// Cheap at rising positions; to go back, compressed bytes are read again from the beginning.
    /// Throws InputError when the bytes are missing.
    virtual void read(std::uint64_t at, std::span<std::uint8_t> into) = 0;
};

/// The arrays of a file.
class NamedArrays {
  public:
    /// Throws InputError when a .npz cannot be opened.
    explicit NamedArrays(std::filesystem::path file);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool zipped() const { return archive_ != nullptr; }
    /// Without ".npy"; the array of a .npy file has an empty name.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// Throws InputError when it cannot be read, or when its header claims more than it can hold.
    [[nodiscard]] std::unique_ptr<ArrayBytes> open(const std::string& name) const;

  private:
    std::filesystem::path file_;
    std::shared_ptr<zip> archive_{};  ///< null: a .npy
    std::vector<std::string> names_{};
};

[[nodiscard]] bool is_npy(std::string_view head);

/// Whether the file is a zip archive with an array in it; `head`: its first bytes.
[[nodiscard]] bool is_npz(const std::filesystem::path& file, std::string_view head);

}  // namespace dibhr
