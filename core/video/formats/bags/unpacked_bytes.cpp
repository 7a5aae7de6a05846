// Calls the decoders of libzstd and liblz4 with pieces of a stream.
#include "core/video/formats/bags/unpacked_bytes.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kPiece_bytes = 1 << 17;

class ZstdDecoder : public UnpackedBytes::Decoder {
  public:
    /// The decoder's own memory is at most that of a window as long as the content.
    explicit ZstdDecoder(std::size_t most) {
        if (stream_ == nullptr) throw std::bad_alloc();
        constexpr int kUsualLog = 23;  // of zstd's level 19
        constexpr int kMostLog = 29;
        ZSTD_DCtx_setParameter(
            stream_.get(), ZSTD_d_windowLogMax,
            std::clamp(static_cast<int>(std::bit_width(most)), kUsualLog, kMostLog));
    }

    Step unpack(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) override {
        ZSTD_inBuffer in{from.data(), from.size(), 0};
        ZSTD_outBuffer out{to.data(), to.size(), 0};
        if (ZSTD_isError(ZSTD_decompressStream(stream_.get(), &out, &in)) != 0) return {};
        return {in.pos, out.pos};
    }

  private:
    struct Closer {
        void operator()(ZSTD_DStream* stream) const noexcept { ZSTD_freeDStream(stream); }
    };
    std::unique_ptr<ZSTD_DStream, Closer> stream_{ZSTD_createDStream()};
};

class Lz4Decoder : public UnpackedBytes::Decoder {
  public:
    Lz4Decoder() {
        if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) != 0)
            throw std::bad_alloc();
    }
    ~Lz4Decoder() override { LZ4F_freeDecompressionContext(context_); }
    Lz4Decoder(const Lz4Decoder&) = delete;
    Lz4Decoder& operator=(const Lz4Decoder&) = delete;

    Step unpack(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) override {
        Step step{from.size(), to.size()};
        const std::size_t result =
            LZ4F_decompress(context_, to.data(), &step.made, from.data(), &step.used, nullptr);
        return LZ4F_isError(result) != 0 ? Step{} : step;
    }

  private:
    LZ4F_dctx* context_{nullptr};
};

std::unique_ptr<UnpackedBytes::Decoder> decoder_of(CompressionFormat form, std::size_t most) {
    if (form == CompressionFormat::lz4) return std::make_unique<Lz4Decoder>();
    return std::make_unique<ZstdDecoder>(most);
}

}  // namespace

std::size_t most_unpacked(std::uint64_t packed_bytes) noexcept {
    constexpr std::uint64_t kAlways_bytes = 1 << 24;
    constexpr std::uint64_t kMostTimes = 1000;
    // A picture of the largest size, and smaller messages.
    constexpr std::uint64_t kMost_bytes = kMostPictureBytes + (std::uint64_t{1} << 26);
    if (packed_bytes > kMost_bytes) return kMost_bytes;
    return std::clamp(kMostTimes * packed_bytes, kAlways_bytes, kMost_bytes);
}

UnpackedBytes::UnpackedBytes(CompressionFormat form, NextPacked next, std::size_t most)
    : most_(most), next_(std::move(next)), decoder_(decoder_of(form, most)) {}

std::span<const std::uint8_t> UnpackedBytes::beginning(std::size_t wanted) {
    wanted = std::min(wanted, most_);
    while (bytes_.size() < wanted && !over_) {
        if (unused_.empty()) {
            packed_.resize(kPiece_bytes);
            unused_ = std::span(packed_).first(next_(packed_));
        }
        const std::size_t before = bytes_.size();
        bytes_.resize(std::min(most_, before + kPiece_bytes));
        const Decoder::Step step = decoder_->unpack(unused_, std::span(bytes_).subspan(before));
        bytes_.resize(before + step.made);
        unused_ = unused_.subspan(step.used);
        over_ = step.used == 0 && step.made == 0;
    }
    return std::span(bytes_).first(std::min(wanted, bytes_.size()));
}

bool UnpackedBytes::read(std::uint64_t at, std::span<std::uint8_t> to) {
    if (at > most_ || to.size() > most_ - at) return false;
    const auto all = beginning(at + to.size());
    if (all.size() < at + to.size()) return false;
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(at), to.size(), to.begin());
    return true;
}

}  // namespace dibhr
