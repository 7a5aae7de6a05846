// Sums up the content of files on a thread of its own, so that nobody waits for large ones.
#include "core/session/file_sums.hpp"

#include <exception>
#include <optional>
#include <system_error>
#include <utility>

#include "core/files/content_hash.hpp"

namespace dibhr {

namespace {

/// Nothing when the file cannot be read or `leaving` became true.
std::optional<FileContent> content_of(const std::filesystem::path& file,
                                      const std::atomic<bool>& leaving) {
    std::error_code failed;
    const auto bytes = std::filesystem::file_size(file, failed);
    if (failed) return std::nullopt;
    try {
        auto sum = sha256_of_file(file, leaving);
        if (!sum) return std::nullopt;
        return FileContent{file, bytes, std::move(*sum)};
    } catch (const std::exception&) {
        return std::nullopt;  // the session says nothing of its content then
    }
}

}  // namespace

FileSums::FileSums() : thread_([this] { run(); }) {}

FileSums::~FileSums() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    asked_.notify_one();
    thread_.join();
}

void FileSums::ask(const std::filesystem::path& file) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(file);
    }
    asked_.notify_one();
}

std::vector<FileContent> FileSums::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(known_, {});
}

bool FileSums::idle() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty();
}

void FileSums::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        asked_.wait(lock, [this] { return leaving_ || !waiting_.empty(); });
        if (leaving_) return;
        const std::filesystem::path file = waiting_.front();
        lock.unlock();
        auto content = content_of(file, leaving_);
        lock.lock();
        if (content) known_.push_back(std::move(*content));
        waiting_.pop_front();
    }
}

}  // namespace dibhr
