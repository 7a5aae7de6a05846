// The crash note is put together on the stack and written by one call.
#include "app/window/crash_note.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>  // renameat2
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>

namespace dibhr {

namespace {

class Line {
  public:
    void add(const char* text) noexcept {
        for (; *text != '\0' && length_ + 1 < text_.size(); ++text) {
            const bool control = static_cast<unsigned char>(*text) < ' ' || *text == '\x7f';
            text_[length_++] = control ? '?' : *text;
        }
    }
    void write() noexcept {
        text_[length_++] = '\n';
        pollfd errors{STDERR_FILENO, POLLOUT, 0};
        if (poll(&errors, 1, 0) != 1 || (errors.revents & POLLOUT) == 0) return;
        // A writable pipe takes up to PIPE_BUF bytes whole.
        [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text_.data(), length_);
    }

  private:
    std::array<char, PIPE_BUF> text_{};
    std::size_t length_{0};
};

}  // namespace

void CrashNote::set_recording(const std::filesystem::path& file) {
    recording_.store(file.empty() ? nullptr : &files_.emplace_back(file.string()),
                     std::memory_order_release);
}

void CrashNote::set_clip(const std::filesystem::path& part, const std::filesystem::path& file,
                         bool replaces) {
    clip_.store(
        part.empty() ? nullptr : &clips_.emplace_back(Clip{part.string(), file.string(), replaces}),
        std::memory_order_release);
}

void CrashNote::keep_clip() noexcept {
    const Clip* const clip = clip_.exchange(nullptr);
    if (clip == nullptr) return;
    const unsigned flags = clip->replaces ? 0 : RENAME_NOREPLACE;
    if (renameat2(AT_FDCWD, clip->part.c_str(), AT_FDCWD, clip->file.c_str(), flags) == 0)
        kept_.store(clip);
}

void CrashNote::print(std::initializer_list<const char*> parts) const noexcept {
    const int error = errno;
    Line line;
    line.add("dibhr: ");
    for (const char* const part : parts) line.add(part);
    if (const std::string* const file = recording_.load(std::memory_order_acquire)) {
        line.add("; the recording up to now is in ");
        line.add(file->c_str());
    }
    if (const Clip* const clip = kept_.load()) {
        line.add("; what was written of the clip is in ");
        line.add(clip->file.c_str());
    }
    line.write();
    errno = error;
}

}  // namespace dibhr
