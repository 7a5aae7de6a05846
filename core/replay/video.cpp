// Decodes and cleans the depth that a session touched.
#include "core/replay/video.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostBytes = std::size_t{512} << 20;
constexpr int kReadAhead = 8;
constexpr double kNearAhead_s = 0.5;  // nearer than this, reading on is quicker than a jump

}  // namespace

SessionVideo::SessionVideo(const Session& session, const SessionVideoOptions& options)
    : finder_(session.file(), options.any_media), raw_depth_(options.raw_depth) {
    for (const SessionSource& source : session.sources()) {
        Video& video = videos_[source.source.media];
        if (video.file.empty()) video.file = finder_.find(source.depth, "depth video");
    }
    if (!options.bump.empty()) {
        other_bump_ = read_bump_map(options.bump);
        return;
    }
    bumps_ = SessionBumps(session, finder_);
}

std::shared_ptr<const DepthImage> SessionVideo::depth(const FrameSource& source, double media_s) {
    const Kept* kept = find({source, media_s});
    if (kept == nullptr) {
        read_on(source, media_s);
        kept = find({source, media_s});
    }
    if (kept == nullptr) {
        throw InputError(videos_[source.media].file.string() + ": has no frame at " +
                         std::to_string(media_s) +
                         " s, which was touched; put the video back that was recorded over");
    }
    return kept->depth.get();
}

const BumpMap* SessionVideo::bump(const SessionParameters& parameters) {
    if (other_bump_) return &*other_bump_;
    return bumps_.of(parameters).get();
}

const SessionVideo::Kept* SessionVideo::find(const FrameName& name) const {
    const auto found = std::find_if(kept_.rbegin(), kept_.rend(),
                                    [&name](const Kept& kept) { return kept.name == name; });
    return found == kept_.rend() ? nullptr : &*found;
}

/// Decodes the frame at `media_s` and a few more.
void SessionVideo::read_on(const FrameSource& source, double media_s) {
    Video& video = videos_[source.media];
    if (!video.media) video.media = open_depth(video.file);
    const bool near_ahead =
        video.last_s && *video.last_s < media_s && media_s < *video.last_s + kNearAhead_s;
    if (!near_ahead) video.media->seek(media_s);
    for (int ahead = 0; ahead < kReadAhead;) {
        std::optional<RawFrame> frame = video.media->next();
        if (!frame) {
            video.last_s.reset();
            return;
        }
        video.last_s = frame->media_s;
        if (frame->media_s < media_s) continue;
        keep(source, std::move(*frame));
        ++ahead;
    }
}

void SessionVideo::keep(const FrameSource& source, RawFrame frame) {
    const CleaningOptions cleaning =
        raw_depth_ ? CleaningOptions{false, false, false}
                   : CleaningOptions{source.fill_holes, source.remove_spikes, source.smooth_steps};
    const double media_s = frame.media_s;
    const std::size_t bytes = frame.depth.levels.size() * sizeof(float);
    const std::size_t most = std::max<std::size_t>(kMostBytes / std::max<std::size_t>(bytes, 1),
                                                   std::size_t{2} * kReadAhead);
    while (kept_.size() >= most) kept_.pop_front();
    kept_.push_back({{source, media_s}, cleaning_.clean(std::move(frame.depth), cleaning)});
}

}  // namespace dibhr
