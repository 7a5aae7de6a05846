// Decodes, cleans and keeps the frames that a session touched.
#include "core/replay/frames.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

/// How far to read ahead and how much to keep: of a run as quick as it can be, and of a window,
/// which first wants to show the two frames where a person went.
struct Reach {
    int frames_ahead;
    std::size_t most_bytes;
};
constexpr Reach kRun{8, std::size_t{512} << 20};
constexpr Reach kWindow{2, std::size_t{256} << 20};
constexpr double kNearAhead_s = 0.5;  // nearer than this, reading on is quicker than a jump
constexpr std::size_t kLeastKept = 16;

}  // namespace

SessionFrames::SessionFrames(const Session& session, const SessionFramesOptions& options)
    : options_(options), finder_(session.file(), options.any_media) {
    find_files(session);
    if (session.sources().empty()) return;
    Video& first = videos_[session.sources().front().source.media];
    description_ = media_of(first).description();
}

void SessionFrames::find_files(const Session& session) {
    for (const SessionSource& source : session.sources()) {
        Video& video = videos_[source.source.media];
        if (!video.depth.empty()) continue;
        video.depth = finder_.find(source.depth, "depth video");
        if (options_.colour) video.colour = finder_.find(source.colour, "colour video");
    }
    if (!options_.bump.empty()) {
        other_bump_ = std::make_shared<const BumpMap>(read_bump_map(options_.bump));
        return;
    }
    for (const SessionParameters& parameters : session.parameters()) {
        const SessionMedia& bump = parameters.bump;
        if (bump.file.empty() || bumps_.contains(bump.file)) continue;
        bumps_[bump.file] =
            std::make_shared<const BumpMap>(read_bump_map(finder_.find(bump, "bump map")));
    }
}

std::shared_ptr<const BumpMap> SessionFrames::bump(const SessionParameters& parameters) {
    if (other_bump_) return other_bump_;
    const auto found = bumps_.find(parameters.bump.file);
    return found == bumps_.end() ? nullptr : found->second;
}

Frame SessionFrames::frame(const FrameSource& source, double media_s) {
    const Kept* kept = find(source, media_s);
    if (kept == nullptr) {
        read_on(source, media_s);
        kept = find(source, media_s);
    }
    if (kept == nullptr) {
        throw InputError(videos_[source.media].depth.string() + ": has no frame at " +
                         std::to_string(media_s) +
                         " s, which was touched; put the video back that was recorded over");
    }
    Frame frame = kept->frame;
    frame.depth = kept->depth.get();
    return frame;
}

Media& SessionFrames::media_of(Video& video) const {
    if (!video.media) {
        video.media =
            options_.colour ? open_media(video.colour, video.depth) : open_depth(video.depth);
    }
    return *video.media;
}

const SessionFrames::Kept* SessionFrames::find(const FrameSource& source, double media_s) const {
    const auto found = std::find_if(kept_.rbegin(), kept_.rend(), [&](const Kept& kept) {
        return kept.source == source && kept.frame.media_s == media_s;  // a name: same bits
    });
    return found == kept_.rend() ? nullptr : &*found;
}

/// Decodes the frame at `media_s` and a few more.
void SessionFrames::read_on(const FrameSource& source, double media_s) {
    Video& video = videos_[source.media];
    Media& media = media_of(video);
    const bool near_ahead =
        video.last_s && *video.last_s < media_s && media_s < *video.last_s + kNearAhead_s;
    if (!near_ahead) media.seek(media_s);
    const int wanted = (options_.colour ? kWindow : kRun).frames_ahead;
    for (int ahead = 0; ahead < wanted;) {
        std::optional<RawFrame> raw = media.next();
        if (!raw) {
            video.last_s.reset();
            return;
        }
        video.last_s = raw->media_s;
        if (raw->media_s < media_s) continue;
        keep(source, std::move(*raw));
        ++ahead;
    }
}

void SessionFrames::keep(const FrameSource& source, RawFrame raw) {
    const std::size_t bytes = raw.depth.levels.size() * sizeof(float) + raw.colour.rgb.size();
    const Reach& reach = options_.colour ? kWindow : kRun;
    const std::size_t most =
        std::max(reach.most_bytes / std::max<std::size_t>(bytes, 1), kLeastKept);
    while (kept_.size() >= most) kept_.pop_front();
    Frame frame{.colour = std::make_shared<const ColourImage>(std::move(raw.colour)),
                .media_s = raw.media_s,
                .index = raw.index,
                .media = source.media,
                .cleaning = {source.fill_holes, source.remove_spikes, source.smooth_steps}};
    if (options_.raw_depth) frame.cleaning = {false, false, false};
    auto depth = cleaning_.clean(std::move(raw.depth), frame.cleaning);
    kept_.push_back({source, std::move(frame), std::move(depth)});
}

}  // namespace dibhr
