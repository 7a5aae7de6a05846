// Keeps what is live as two videos beside a session, on a thread of its own.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/files/content_hash.hpp"
#include "core/video/live/live_record.hpp"

namespace dibhr {

struct LiveFiles {
    std::filesystem::path colour{};  ///< empty: it has none
    std::filesystem::path depth{};
};

/// Of "mine.dibhr": "mine.color.mkv" and "mine.depth.mkv".
[[nodiscard]] LiveFiles live_files_beside(const std::filesystem::path& session);

class LiveRecorder {
  public:
    /// Throws InputError when one of the files is there already, or cannot be made.
    explicit LiveRecorder(LiveFiles files);
    ~LiveRecorder() { finish(); }
    LiveRecorder(const LiveRecorder&) = delete;
    LiveRecorder& operator=(const LiveRecorder&) = delete;

    /// The next frame. Waits for nothing: what a slow disk leaves behind waits in memory, up to
    /// some seconds; then it breaks off.
    void add(const LiveRecord& record);
    /// Writes what waits, and ends the files; no more is added.
    void finish();
    /// The same, and the files go: nobody refers to them.
    void discard();

    /// Of finished files, as far as it is known.
    [[nodiscard]] std::vector<FileContent> contents() const;
    /// A sentence when writing broke off; what was written until then plays.
    [[nodiscard]] std::string failure() const;

  private:
    struct Tracks;

    void run();
    void write(Tracks& tracks, const LiveRecord& record) const;

    const LiveFiles files_;
    mutable std::mutex mutex_{};
    std::condition_variable news_{};
    std::deque<LiveRecord> waiting_{};
    bool stopped_{false};
    std::string failure_{};
    std::vector<FileContent> contents_{};
    std::thread thread_;
};

}  // namespace dibhr
