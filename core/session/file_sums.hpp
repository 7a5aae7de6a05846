// Sums up the content of files on a thread of its own, so that nobody waits for large ones.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace dibhr {

struct FileContent {
    std::filesystem::path file{};
    std::uint64_t bytes{0};
    std::string sha256{};
};

/// One after the other. Files that cannot be read are left out.
class FileSums {
  public:
    FileSums();
    ~FileSums();  ///< gives up the sum it is at
    FileSums(const FileSums&) = delete;
    FileSums& operator=(const FileSums&) = delete;

    void ask(const std::filesystem::path& file);
    /// What has become known since the last call.
    [[nodiscard]] std::vector<FileContent> take();
    /// Nothing is being summed up or waits for it.
    [[nodiscard]] bool idle() const;

  private:
    void run();

    mutable std::mutex mutex_{};
    std::condition_variable asked_{};
    std::deque<std::filesystem::path> waiting_{};  // under the mutex, the one at work in front
    std::vector<FileContent> known_{};             // under the mutex
    std::atomic<bool> leaving_{false};
    std::thread thread_{};
};

}  // namespace dibhr
