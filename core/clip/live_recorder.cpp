// The thread that encodes and writes live frames.
#include "core/clip/live_recorder.hpp"

#include <pthread.h>

#include <cerrno>
#include <exception>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/clip/live_track.hpp"
#include "core/error.hpp"
#include "core/files/write_failure.hpp"
#include "core/video/formats/libraries.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostWaiting = 90;  ///< frames: three seconds

/// Creates a file. Throws InputError for one that exists, or cannot be written.
void make_new(const fs::path& file) {
    std::error_code unknown;
    if (fs::exists(file, unknown))
        throw InputError(file.string() +
                         " exists already: move it away, or give the recording another name");
    errno = 0;
    if (!std::ofstream(file, std::ios::binary))
        throw InputError(file.string() + ": " + write_failure(errno));
}

}  // namespace

LiveFiles live_files_beside(const fs::path& session) {
    fs::path colour = session;
    fs::path depth = session;
    return {colour.replace_extension(".color.mkv"), depth.replace_extension(".depth.mkv")};
}

/// The two tracks, opened with their first frame.
struct LiveRecorder::Tracks {
    std::optional<LiveTrack> depth{};
    std::optional<LiveTrack> colour{};
};

LiveRecorder::LiveRecorder(LiveFiles files) : files_(std::move(files)) {
    set_up_libraries();
    make_new(files_.depth);
    if (!files_.colour.empty()) make_new(files_.colour);
    thread_ = std::thread([this] { run(); });
}

void LiveRecorder::add(const LiveRecord& record) {
    const std::lock_guard lock(mutex_);
    if (stopped_ || !failure_.empty()) return;
    if (waiting_.size() < kMostWaiting) {
        waiting_.push_back(record);
    } else {
        failure_ = "the disk is too slow for the live video";
        waiting_.clear();
    }
    wake_.notify_one();
}

void LiveRecorder::finish() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
}

void LiveRecorder::discard() {
    finish();
    std::error_code gone;
    for (const fs::path& file : {files_.depth, files_.colour})
        if (!file.empty()) fs::remove(file, gone);
}

std::string LiveRecorder::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

std::vector<FileContent> LiveRecorder::contents() const {
    const std::lock_guard lock(mutex_);
    return contents_;
}

void LiveRecorder::write(Tracks& tracks, const LiveRecord& record) const {
    const LiveLevels levels = levels_of(record);
    if (!tracks.depth) {
        const std::map<std::string, std::string> tags{{kNoiseTag, text_of(record.noise)},
                                                      {kBitsTag, std::to_string(levels.bits)}};
        tracks.depth.emplace(files_.depth, levels, tags);
    }
    tracks.depth->add(levels, record.media_ms);
    const ColourImage colour = files_.colour.empty() ? ColourImage{} : colour_of(record);
    if (colour.rgb.empty()) return;
    if (!tracks.colour) tracks.colour.emplace(files_.colour, colour);
    tracks.colour->add(colour, record.media_ms);
}

void LiveRecorder::run() {
    pthread_setname_np(pthread_self(), "dibhr-livedisk");
    Tracks tracks;
    std::string failure;
    const auto try_to = [&failure](auto&& step) {
        try {
            if (failure.empty()) step();
        } catch (const std::exception& error) {
            failure = error.what();
        }
    };
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
        if (waiting_.empty()) break;
        const LiveRecord next = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        try_to([&] { write(tracks, next); });
        lock.lock();
        if (failure.empty()) continue;
        failure_ = failure;
        waiting_.clear();
    }
    lock.unlock();
    std::vector<FileContent> contents;
    for (auto* const track : {&tracks.depth, &tracks.colour})
        try_to([&] {
            if (!*track) return;
            if (auto content = (*track)->finish()) contents.push_back(std::move(*content));
        });
    lock.lock();
    contents_ = std::move(contents);
    if (failure_.empty()) failure_ = failure;
}

}  // namespace dibhr
