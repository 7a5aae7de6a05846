// Writes, hashes and flushes libav's bytes.
#include "core/clip/summed_file.hpp"

extern "C" {
#include <libavformat/avio.h>
#include <libavutil/error.h>
#include <libavutil/mem.h>
}

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <new>
#include <utility>

#include "core/files/output_file.hpp"

namespace dibhr {

namespace {

constexpr int kPieceBytes = 1 << 16;
constexpr std::chrono::seconds kBetweenFlushes{1};  // most that a power cut loses

}  // namespace

SummedFile::SummedFile(std::filesystem::path file)
    : file_(std::move(file)),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    require_written(descriptor_ < 0 || !flush_folder(file_.parent_path()) ? AVERROR(errno) : 0);
    auto* const buffer = static_cast<unsigned char*>(av_malloc(kPieceBytes));
    // `auto`, since the bytes are const from libavformat 61 on.
    const auto write_some = [](void* to, auto* bytes, int count) {
        return write(to, bytes, count);
    };
    bytes_.reset(avio_alloc_context(buffer, kPieceBytes, 1, this, nullptr, write_some, seek));
    if (!bytes_) {
        av_free(buffer);
        throw std::bad_alloc();
    }
}

SummedFile::~SummedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

int SummedFile::write(void* file, const std::uint8_t* bytes, int count) noexcept {
    auto& self = *static_cast<SummedFile*>(file);
    for (int done = 0; done < count;) {
        const auto wrote = ::pwrite(self.descriptor_, bytes + done,
                                    static_cast<std::size_t>(count - done), self.at_ + done);
        if (wrote < 0 && errno != EINTR) return AVERROR(errno);
        done += static_cast<int>(std::max<ssize_t>(wrote, 0));
    }
    self.sum_up(bytes, count);
    self.at_ += count;
    self.size_ = std::max(self.size_, self.at_);
    return self.flush_in_time() ? count : AVERROR(errno);
}

bool SummedFile::flush_in_time() {
    const auto now = std::chrono::steady_clock::now();
    if (now - flushed_at_ < kBetweenFlushes) return true;
    flushed_at_ = now;
    return flush_to_disk(descriptor_);
}

std::int64_t SummedFile::seek(void* file, std::int64_t to, int from) noexcept {
    auto& self = *static_cast<SummedFile*>(file);
    if (from == AVSEEK_SIZE) return self.size_;
    if (from == SEEK_CUR) to += self.at_;
    if (from == SEEK_END) to += self.size_;
    return self.at_ = to;
}

void SummedFile::sum_up(const std::uint8_t* bytes, std::int64_t count) {
    if (!head_) return;
    if (at_ == summed_to_) {
        sum_.add({bytes, static_cast<std::size_t>(count)});
        summed_to_ += count;
    } else if (at_ + count > *head_) {
        written_again_ = true;
    }
}

void SummedFile::end_head() {
    avio_flush(bytes_.get());
    head_ = summed_to_ = at_;
}

void SummedFile::finish() {
    avio_flush(bytes_.get());
    require_written(bytes_->error);
    require_written(flush_to_disk(descriptor_) ? 0 : AVERROR(errno));
    require_written(::close(std::exchange(descriptor_, -1)) != 0 ? AVERROR(errno) : 0);
}

std::optional<FileContent> SummedFile::content() {
    if (!head_ || written_again_ || summed_to_ != size_) return std::nullopt;
    return FileContent{file_, static_cast<std::uint64_t>(size_), sum_.digits(),
                       static_cast<std::uint64_t>(*head_)};
}

}  // namespace dibhr
