// Decodes, cleans and keeps the frames that a session touched.
#include "core/replay/frames.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kNearAhead_s = 0.5;  // nearer than this, reading on is quicker than a jump
constexpr std::size_t kMostBytes = std::size_t{256} << 20;
constexpr std::size_t kMostKept = 150;  // what a second's run-in and the frames ahead of it need
constexpr std::size_t kLeastKept = 8;

std::size_t bytes_of(const Frame& frame) {
    return frame.depth->levels.size() * sizeof(float) + frame.colour->rgb.size();
}

}  // namespace

SessionFrames::SessionFrames(const Session& session, bool any_media)
    : finder_(session.file(), any_media) {
    for (const SessionSource& source : session.sources()) {
        Video& video = videos_[source.source.media];
        if (!video.depth.empty()) continue;
        video.depth = finder_.find(source.depth, "depth video");
        video.colour = finder_.find(source.colour, "colour video");
    }
    bumps_ = SessionBumps(session, finder_);
    if (session.sources().empty()) return;
    description_ = reader_of(session.sources().front().source.media).description();
}

Frame SessionFrames::frame(const FrameSource& source, double media_s) {
    const auto found =
        std::find_if(kept_.rbegin(), kept_.rend(), [&source, media_s](const Kept& kept) {
            return kept.source == source && kept.frame.media_s == media_s;  // a name: same bits
        });
    if (found != kept_.rend()) return found->frame;
    const std::optional<Frame> frame = read(source, media_s);
    if (!frame || frame->media_s != media_s) {
        throw InputError(videos_[source.media].depth.string() + ": has no frame at " +
                         std::to_string(media_s) +
                         " s, which was touched; put the video back that was recorded over");
    }
    keep(source, *frame);
    return *frame;
}

FrameReader& SessionFrames::reader_of(std::uint32_t number) {
    Video& video = videos_[number];
    if (!video.reader) {
        video.reader = std::make_unique<FrameReader>(open_media(video.colour, video.depth), number);
    }
    return *video.reader;
}

std::optional<Frame> SessionFrames::read(const FrameSource& source, double media_s) {
    FrameReader& reader = reader_of(source.media);
    reader.set_cleaning({source.fill_holes, source.remove_spikes, source.smooth_steps});
    std::optional<double>& last_s = videos_[source.media].last_s;
    const bool near_ahead = last_s && *last_s < media_s && media_s < *last_s + kNearAhead_s;
    std::optional<Frame> frame = near_ahead ? reader.after(*last_s) : reader.at(media_s);
    while (frame && frame->media_s < media_s) frame = reader.after(frame->media_s);
    last_s.reset();
    if (frame) last_s = frame->media_s;
    return frame;
}

void SessionFrames::keep(const FrameSource& source, const Frame& frame) {
    const std::size_t by_size = kMostBytes / std::max<std::size_t>(1, bytes_of(frame));
    const std::size_t most = std::clamp(by_size, kLeastKept, kMostKept);
    while (kept_.size() >= most) kept_.pop_front();
    kept_.push_back({source, frame});
}

}  // namespace dibhr
