// SHA-256 by libavutil.
#include "core/files/content_hash.hpp"

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
    std::ifstream in(file, std::ios::binary);
    std::vector<char> piece(kPieceBytes);
    Sha256 sum;
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
        if (stop) return std::nullopt;
        sum.add({reinterpret_cast<const std::uint8_t*>(piece.data()),
                 static_cast<std::size_t>(in.gcount())});
    }
    if (!in.eof() || in.bad()) {
        throw InputError("cannot read " + file.string() + ": make it readable");
    }
    return sum.digits();
}

}  // namespace dibhr
