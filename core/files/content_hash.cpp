// SHA-256 by libavutil.
#include "core/files/content_hash.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <vector>

#include "core/error.hpp"

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

namespace dibhr {

namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

class Sha256 {
  public:
    Sha256() : state_(av_sha_alloc()) {
        if (!state_ || av_sha_init(state_.get(), 256) != 0) throw std::bad_alloc();
    }

    void add(std::span<const std::uint8_t> bytes) {
        av_sha_update(state_.get(), bytes.data(), bytes.size());
    }

    /// Ends the sum.
    [[nodiscard]] std::string digits() {
        std::array<std::uint8_t, 32> digest{};
        av_sha_final(state_.get(), digest.data());
        constexpr char kDigits[] = "0123456789abcdef";
        std::string text;
        for (const unsigned byte : digest) {
            text += kDigits[byte >> 4U];
            text += kDigits[byte & 15U];
        }
        return text;
    }

  private:
    struct Free {
        void operator()(AVSHA* state) const noexcept { av_free(state); }
    };
    std::unique_ptr<AVSHA, Free> state_;
};

/// False once `stop` is true.
bool add_file(Sha256& sum, const std::filesystem::path& file, const std::atomic<bool>& stop) {
    std::ifstream in(file, std::ios::binary);
    std::vector<char> piece(kPieceBytes);
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
        if (stop) return false;
        sum.add({reinterpret_cast<const std::uint8_t*>(piece.data()),
                 static_cast<std::size_t>(in.gcount())});
    }
    if (!in.eof() || in.bad()) {
        throw InputError("cannot read " + file.string() + ": make it readable");
    }
    return true;
}

/// The file itself, or all in a folder, in order; those whose names begin with a point belong to a
/// file manager.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& place) {
    if (!std::filesystem::is_directory(place)) return {place};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
        const bool hidden = entry.path().filename().string().starts_with('.');
        if (entry.is_regular_file() && !hidden) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// With its end, so that no two names and contents run together to the same.
std::vector<std::uint8_t> name_in(const std::filesystem::path& folder,
                                  const std::filesystem::path& file) {
    const std::string name = file.lexically_relative(folder).generic_string();
    std::vector<std::uint8_t> bytes(name.begin(), name.end());
    bytes.push_back(0);
    return bytes;
}

}  // namespace

std::string sha256_of(std::span<const std::uint8_t> bytes) {
    Sha256 sum;
    sum.add(bytes);
    return sum.digits();
}

std::string sha256_of_file(const std::filesystem::path& file) {
    const std::atomic<bool> never{false};
    return *sha256_of_file(file, never);
}

std::optional<std::string> sha256_of_file(const std::filesystem::path& file,
                                          const std::atomic<bool>& stop) {
    Sha256 sum;
    const bool is_folder = std::filesystem::is_directory(file);
    for (const std::filesystem::path& part : files_of(file)) {
        if (is_folder) sum.add(name_in(file, part));
        if (!add_file(sum, part, stop)) return std::nullopt;
    }
    return sum.digits();
}

std::uintmax_t content_bytes(const std::filesystem::path& file) {
    std::uintmax_t bytes = 0;
    for (const std::filesystem::path& part : files_of(file))
        bytes += std::filesystem::file_size(part);
    return bytes;
}

}  // namespace dibhr
