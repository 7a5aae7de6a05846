// SHA-256 by libavutil.
#include "core/files/content_hash.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <new>
#include <vector>

#include "core/error.hpp"
#include "core/files/content_files.hpp"

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

namespace dibhr {

namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

/// False once `stop` is true.
bool add_file(Sha256& sum, const std::filesystem::path& file, std::uint64_t head_bytes,
              const std::atomic<bool>& stop) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(head_bytes));
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

/// The name with a zero at its end, so that different names and contents give different bytes.
std::vector<std::uint8_t> name_in(const std::filesystem::path& folder,
                                  const std::filesystem::path& file) {
    const std::string name = file.lexically_relative(folder).generic_string();
    std::vector<std::uint8_t> bytes(name.begin(), name.end());
    bytes.push_back(0);
    return bytes;
}

/// Nothing once `stop` is true.
std::optional<std::string> sum_of(const std::filesystem::path& file, std::uint64_t head_bytes,
                                  const std::atomic<bool>& stop) {
    Sha256 sum;
    const bool is_folder = std::filesystem::is_directory(file);
    for (const std::filesystem::path& part : content_files(file)) {
        if (is_folder) sum.add(name_in(file, part));
        if (!add_file(sum, part, head_bytes, stop)) return std::nullopt;
    }
    return sum.digits();
}

}  // namespace

Sha256::Sha256() : state_(av_sha_alloc()) {
    if (!state_ || av_sha_init(state_.get(), 256) != 0) throw std::bad_alloc();
}

void Sha256::Free::operator()(AVSHA* state) const noexcept {
    av_free(state);
}

void Sha256::add(std::span<const std::uint8_t> bytes) {
    av_sha_update(state_.get(), bytes.data(), bytes.size());
}

std::string Sha256::digits() {
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

std::string sha256_of(std::span<const std::uint8_t> bytes) {
    Sha256 sum;
    sum.add(bytes);
    return sum.digits();
}

std::string sha256_of_file(const std::filesystem::path& file, std::uint64_t head_bytes) {
    const std::atomic<bool> never{false};
    return *sum_of(file, head_bytes, never);
}

std::optional<std::string> sha256_of_file(const std::filesystem::path& file,
                                          const std::atomic<bool>& stop) {
    return sum_of(file, 0, stop);
}

std::vector<std::filesystem::path> content_files(const std::filesystem::path& place) {
    if (!std::filesystem::is_directory(place)) return {place};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
        const bool hidden = entry.path().filename().string().starts_with('.');
        if (entry.is_regular_file() && !hidden) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::uintmax_t content_bytes(const std::filesystem::path& file) {
    std::uintmax_t bytes = 0;
    for (const std::filesystem::path& part : content_files(file))
        bytes += std::filesystem::file_size(part);
    return bytes;
}

bool has_content(const std::filesystem::path& file, const FileContent& content) {
    try {
        return content_bytes(file) == content.bytes &&
               sha256_of_file(file, content.head_bytes) == content.sha256;
    } catch (const std::filesystem::filesystem_error&) {
        return false;
    }
}

}  // namespace dibhr
