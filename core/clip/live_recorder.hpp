// Records a live source as two videos beside a session, on its own thread.
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
    std::filesystem::path colour{};  ///< empty: no colour
    std::filesystem::path depth{};
};

/// Of "mine.dibhr": "mine.color.mkv" and "mine.depth.mkv".
[[nodiscard]] LiveFiles live_files_beside(const std::filesystem::path& session);

class LiveRecorder {
  public:
    /// Throws InputError when one of the files exists, or cannot be created.
    explicit LiveRecorder(LiveFiles files);
    ~LiveRecorder() { finish(); }
    LiveRecorder(const LiveRecorder&) = delete;
    LiveRecorder& operator=(const LiveRecorder&) = delete;

    /// Adds a frame. Never waits: behind a slow disk frames queue in memory, up to some seconds;
    /// then the recording fails.
    void add(const LiveRecord& record);
    /// Writes the queue and ends the files; later frames are ignored.
    void finish();
    /// The same, and removes the files, to which no session refers.
    void discard();

    /// Size and hash of the finished files, as far as known.
    [[nodiscard]] std::vector<FileContent> contents() const;
    /// A sentence when writing failed; the files play up to there.
    [[nodiscard]] std::string failure() const;

  private:
    struct Tracks;

    void run();
    void write(Tracks& tracks, const LiveRecord& record) const;

    const LiveFiles files_;
    mutable std::mutex mutex_{};
    std::condition_variable wake_{};
    std::deque<LiveRecord> waiting_{};
    bool stopped_{false};
    std::string failure_{};
    std::vector<FileContent> contents_{};
    std::thread thread_;
};

}  // namespace dibhr
