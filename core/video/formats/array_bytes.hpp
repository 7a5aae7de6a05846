// The bytes of numpy's arrays: of the one in a .npy file, of the named ones in a .npz (zip) file;
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
    /// Cheap in rising order; what is compressed is read again from its beginning to go back.
    /// Throws InputError when the bytes are not there.
    virtual void read(std::uint64_t at, std::span<std::uint8_t> into) = 0;
};

/// The arrays of a file.
class NamedArrays {
  public:
    /// Throws InputError when a .npz cannot be opened.
    explicit NamedArrays(std::filesystem::path file);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool zipped() const { return archive_ != nullptr; }
    /// Without ".npy"; the one of a .npy has no name.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// Throws InputError when it cannot be read, or claims more than it can hold.
    [[nodiscard]] std::unique_ptr<ArrayBytes> open(const std::string& name) const;

  private:
    std::filesystem::path file_;
    std::shared_ptr<zip> archive_{};  ///< null: a .npy
    std::vector<std::string> names_{};
};

[[nodiscard]] bool is_npy(std::string_view head);

/// Whether it is a zip file with an array in it; `head`: how it begins.
[[nodiscard]] bool is_npz(const std::filesystem::path& file, std::string_view head);

}  // namespace dibhr
