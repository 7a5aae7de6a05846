// Finds, decodes, cleans and keeps what a session touched.
#include "core/replay/frames.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/remembering_media.hpp"
#include "core/video/depth/sidecar.hpp"
#include "core/video/depth/surface_version.hpp"
#include "core/video/picture_pattern.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// A file, a folder of pictures, or a pattern of their names.
bool is_media(const fs::path& file) {
    std::error_code failed;
    return fs::is_regular_file(file, failed) || fs::is_directory(file, failed) ||
           is_picture_pattern(file);
}

/// Cleaning has changed since they were recorded.
bool is_of_other_surfaces(const SessionFacts& facts) {
    const auto is_on = [&facts](const char* name) {
        const auto fact = facts.find(name);
        return fact != facts.end() && fact->second == "yes";
    };
    const auto version = facts.find("surface-version");
    const bool is_same =
        version != facts.end() && version->second == std::to_string(kSurfaceVersion);
    return (is_on("fill-holes") || is_on("remove-spikes") || is_on("smooth-steps")) && !is_same;
}

bool has_content(const fs::path& file, const SessionMedia& media) {
    try {
        return content_bytes(file) == media.bytes && sha256_of_file(file) == media.sha256;
    } catch (const fs::filesystem_error&) {
        return false;
    }
}

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

bool names_session(const std::filesystem::path& file) {
    if (file.extension() == ".dibhr") return true;
    if (file.extension() == ".db3") return false;  // a ROS 2 bag: SQLite's, too
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(file, unknown)) return false;
    constexpr std::string_view kMagic = "SQLite format 3";  // SQLite's file format, section 1.3
    std::array<char, kMagic.size()> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return stream.gcount() == static_cast<std::streamsize>(head.size()) &&
           std::string_view(head.data(), head.size()) == kMagic;
}

SessionMediaFinder::SessionMediaFinder(fs::path session, bool any_content)
    : session_(std::move(session)), any_content_(any_content) {}

fs::path SessionMediaFinder::find(const SessionMedia& media, const std::string& what) {
    if (media.file.empty()) {
        throw InputError(session_.string() + ": does not say over which " + what +
                         " it was recorded; record it again");
    }
    const fs::path beside = fs::absolute(session_).parent_path() / media.file.filename();
    std::optional<fs::path> found;
    for (const fs::path& candidate : {media.file, beside}) {
        if (!is_media(candidate)) continue;
        if (!media.sha256.empty() && has_content(candidate, media)) return candidate;
        if (!found) found = candidate;
    }
    if (!found) {
        throw InputError(
            session_.string() + ": the " + what + " it was recorded over, " + media.file.string() +
            ", is not there; put it back, or beside the session as " + beside.string());
    }
    if (media.sha256.empty()) {
        warn(found->string() + " is taken for the " + what +
             " of the recording, which ended before its content was known");
    } else if (any_content_) {
        warn(found->string() + " is not the " + what + " of the recording: it has changed");
    } else {
        throw InputError(found->string() + ": has changed since " + session_.filename().string() +
                         " was recorded over it; put the original beside the session as " +
                         beside.string() + ", or take it as it is with --any-media");
    }
    return *found;
}

void SessionMediaFinder::warn(const std::string& sentence) {
    warning_ += (warning_.empty() ? "" : "; ") + sentence;
}

CleaningWorkers::CleaningWorkers() {
    for (std::thread& thread : threads_) thread = std::thread([this] { run(); });
}

CleaningWorkers::~CleaningWorkers() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    asked_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

std::shared_future<CleanedDepth> CleaningWorkers::clean(DepthImage depth,
                                                        const CleaningOptions& options,
                                                        std::vector<HeldLevel> held) {
    Job job{std::move(depth), options, std::move(held), {}};
    auto cleaned = job.done.get_future().share();
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(job));
    }
    asked_.notify_one();
    return cleaned;
}

void CleaningWorkers::run() {
    DepthCleaner cleaner;  // with the scratch memory it gathers
    std::unique_lock lock(mutex_);
    while (true) {
        asked_.wait(lock, [this] { return leaving_ || !waiting_.empty(); });
        if (leaving_) return;
        Job job = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        try {
            job.done.set_value(cleaner.cleaned(std::move(job.depth), job.options, job.held));
        } catch (...) {
            job.done.set_exception(std::current_exception());
        }
        lock.lock();
    }
}

SessionFrames::SessionFrames(const Session& session, const SessionFramesOptions& options)
    : options_(options), finder_(session.file(), options.any_media) {
    find_videos(session);
    if (!options.raw_depth && is_of_other_surfaces(session.facts()))
        finder_.warn(
            "its surfaces were made by an earlier dibhr, which treated holes and spikes otherwise: "
            "proxies may differ from those recorded");
    if (!session.sources().empty()) {
        Video& first = videos_[session.sources().front().source.media];
        description_ = media_of(first).description();
    }
    read_bumps(session);
}

void SessionFrames::find_videos(const Session& session) {
    for (const SessionSource& source : session.sources()) {
        Video& video = videos_[source.source.media];
        if (!video.depth.empty()) continue;
        video.depth = finder_.find(source.depth, "depth video");
        if (options_.colour && !source.colour.file.empty())
            video.colour = finder_.find(source.colour, "colour video");
        if (!source.depth_meaning.empty())
            video.request.recorded = statement_in(source.depth_meaning, session.file().string());
    }
}

void SessionFrames::read_bumps(const Session& session) {
    const auto read = [this](const std::filesystem::path& file) {
        auto bump = std::make_shared<BumpMap>(read_bump_map(file));
        // Over the first video: mostly there is no other, and one of another size works as well.
        if (description_.depth_columns > 0) {
            stretch(*bump, description_.depth_columns, description_.depth_rows);
        }
        return bump;
    };
    if (!options_.bump.empty()) {
        other_bump_ = read(options_.bump);
        return;
    }
    for (const SessionParameters& parameters : session.parameters()) {
        const SessionMedia& bump = parameters.bump;
        if (bump.file.empty() || bumps_.contains(bump.file)) continue;
        bumps_[bump.file] = read(finder_.find(bump, "bump map"));
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
                         short_text(media_s) +
                         " s, which was touched; put the video back that was recorded over");
    }
    Frame frame = kept->frame;
    frame.depth = kept->depth.get().depth;
    frame.unseen = kept->depth.get().unseen;
    return frame;
}

Media& SessionFrames::media_of(Video& video) const {
    if (!video.media) {
        video.media = std::make_unique<RememberingMedia>(
            options_.colour ? open_media(video.colour, video.depth, video.request)
                            : open_depth(video.depth, video.request));
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
    auto depth = cleaning_.clean(std::move(raw.depth), frame.cleaning, std::move(raw.held));
    kept_.push_back({source, std::move(frame), std::move(depth)});
}

}  // namespace dibhr
