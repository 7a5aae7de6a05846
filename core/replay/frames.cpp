// Finds, decodes, cleans and caches the frames of a session.
#include "core/replay/frames.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/content_files.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/session/media_places.hpp"
#include "core/sqlite/database.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "core/video/sources/layouts/picture_pattern.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// A file, a folder of pictures, or a pattern of their names.
bool is_media(const fs::path& file) {
    std::error_code failed;
    return fs::is_regular_file(file, failed) || fs::is_directory(file, failed) ||
           is_picture_pattern(file);
}

bool is_cleaned(const Session& session) {
    if (session.fact("fill-holes") == "yes" || session.fact("remove-spikes") == "yes" ||
        session.fact("smooth-steps") == "yes")  // before there were presets
        return true;
    const std::string preset = session.fact("cleaning");
    return !preset.empty() && preset != name_of(CleaningPreset::raw);
}

bool has_motion(const Session& session) {
    return std::any_of(session.sources().begin(), session.sources().end(),
                       [](const SessionSource& source) {
                           return source.source.motion || source.source.in_betweens;
                       });
}

// Size of the cache [bytes]: of a run without a window, and of a window.
constexpr std::size_t kMostOfRun = std::size_t{512} << 20;
constexpr std::size_t kMostOfWindow = std::size_t{256} << 20;
constexpr double kNearAhead_s = 0.5;  // nearer than this, reading on is quicker than a jump
constexpr std::size_t kLeastKept = 16;

}  // namespace

std::string version_warning(const Session& session, bool cleaned_as_recorded) {
    if (session.fact("surface-version") == std::to_string(kSurfaceVersion)) return {};
    if (cleaned_as_recorded && is_cleaned(session))
        return "its surfaces were made by an earlier dibhr, which cleaned "
               "otherwise: proxies may differ from those recorded";
    if (has_motion(session))
        return "its surfaces' motion was found by an earlier dibhr, which did so otherwise: "
               "proxies that it carried may differ from those recorded";
    return {};
}

bool is_session_file(const std::filesystem::path& file) {
    if (file.extension() == ".dibhr") return true;
    if (file.extension() == ".db3") return false;  // a ROS 2 bag: SQLite's, too
    return is_database(file);
}

SessionMediaFinder::SessionMediaFinder(fs::path session, bool any_content)
    : session_(std::move(session)), any_content_(any_content) {}

fs::path SessionMediaFinder::find(const SessionMedia& media, const std::string& what) {
    if (media.file.empty())
        throw InputError(session_.string() + ": does not say with which " + what +
                         " it was recorded; record it again");
    const std::array<fs::path, 2> places = places_of(media, session_);
    std::optional<fs::path> found;
    for (const fs::path& candidate : places) {
        if (!is_media(candidate)) continue;
        if (!media.sha256.empty() && has_content(candidate, media)) return candidate;
        if (!found) found = candidate;
    }
    if (!found)
        throw InputError(session_.string() + ": the " + what + " that it was recorded with, " +
                         media.file.string() +
                         ", is not there; put it back, or beside the session as " +
                         places[1].string());
    if (media.sha256.empty()) {
        warn(found->string() + " is taken for the " + what +
             " of the recording, which ended before its content was known");
    } else if (any_content_) {
        warn(found->string() + " is not the " + what + " of the recording: it has changed");
    } else {
        throw InputError(found->string() + ": has changed since " + session_.filename().string() +
                         " was recorded with it; put the original beside the session as " +
                         places[1].string() + ", or take it as it is with --any-media");
    }
    return *found;
}

void SessionMediaFinder::warn(const std::string& sentence) {
    warning_ += (warning_.empty() ? "" : "; ") + sentence;
}

FrameCleaning cleaning_of(const FrameSource& source) {
    return {{.densify = source.densify,
             .remove_spikes = source.remove_spikes,
             .fill_holes = source.fill_holes,
             .sharpen_silhouettes = source.sharpen_silhouettes,
             .colour_edges = source.colour_edges,
             .steady = source.steady,
             .smooth_steps = source.smooth_steps,
             .smooth_noise = source.smooth_noise,
             .smooth_outlines = source.smooth_outlines},
            {source.finger_px, source.finger_relief_px}};
}

SessionFrames::SessionFrames(const Session& session, const SessionFramesOptions& options)
    : options_(options), finder_(session.file(), options.any_media) {
    find_videos(session);
    const std::string version = version_warning(session, !options.cleaning);
    if (!version.empty()) finder_.warn(version);
    if (!session.sources().empty()) {
        Video& first = videos_[session.sources().front().source.media];
        description_ = reader_of(first).description();
    }
    const auto read = [this](const SessionMedia& bump) {
        return std::make_shared<const BumpMap>(read_bump_map(finder_.find(bump, "bump map")));
    };
    materials_.emplace(session, options_.materials,
                       SurfaceSize{description_.depth_columns, description_.depth_rows}, read);
}

void SessionFrames::find_videos(const Session& session) {
    for (const SessionSource& source : session.sources()) {
        Video& video = videos_[source.source.media];
        const CleaningSteps steps = cleaning_of(source.source).steps;
        const bool densifies = steps.densify && options_.cleaning != CleaningPreset::raw;
        const bool edges = options_.cleaning ? densifies : need_colour(steps);
        const bool moves = source.source.motion || source.source.in_betweens || options_.motion;
        DepthStatement recorded;
        if (!source.depth_meaning.empty())
            recorded = statement_in(source.depth_meaning, session.file().string());
        const bool by_colour = edges || moves || recorded.times == DepthTimes::paired;
        video.in_colour = video.in_colour || options_.colour || by_colour;
        if (video.in_colour && video.colour.empty() && !source.colour.file.empty())
            video.colour = finder_.find(source.colour, "colour video");
        if (!video.depth.empty()) continue;
        video.depth = finder_.find(source.depth, "depth video");
        video.request.recorded = std::move(recorded);
    }
}

Frame SessionFrames::frame(const FrameSource& touched, double media_s) {
    // What depends on a second frame is not part of the key.
    FrameSource source = touched;
    source.motion = source.in_betweens = false;
    if (const Kept* kept = find(source, media_s)) return kept->frame;
    Video& video = videos_[source.media];
    FrameReader& reader = reader_of(video);
    reader.set_cleaning(cleaning_for(source));
    const MediaDescription& media = reader.description();
    reader.set_maps(materials_->maps_of(source, {media.depth_columns, media.depth_rows}));
    const bool near_ahead =
        video.last_s && *video.last_s < media_s && media_s < *video.last_s + kNearAhead_s;
    std::optional<Frame> frame = near_ahead ? reader.after(*video.last_s) : reader.at(media_s);
    while (near_ahead && frame && frame->media_s < media_s) frame = reader.after(frame->media_s);
    video.last_s.reset();
    if (frame) video.last_s = frame->media_s;
    if (!frame || frame->media_s != media_s)
        throw InputError(video.depth.string() + ": has no frame at " + short_text(media_s) +
                         " s, which the recording touched; put the original video back");
    frame->media = source.media;
    keep(source, *frame);
    return *frame;
}

CleaningOptions SessionFrames::cleaning_for(const FrameSource& source) const {
    const FrameCleaning recorded = cleaning_of(source);
    CleaningOptions cleaning{
        .preset = CleaningPreset::own, .own = recorded.steps, .finger = recorded.finger};
    if (options_.cleaning) cleaning.preset = *options_.cleaning;
    if (options_.cleaning == CleaningPreset::raw) cleaning.finger = {};
    if (options_.finger) cleaning.finger = *options_.finger;
    return cleaning;
}

FrameReader& SessionFrames::reader_of(Video& video) const {
    if (!video.reader) {
        video.reader = std::make_unique<FrameReader>(
            video.in_colour ? open_media(video.colour, video.depth, video.request)
                            : open_depth(video.depth, video.request));
    }
    return *video.reader;
}

const SessionFrames::Kept* SessionFrames::find(const FrameSource& source, double media_s) const {
    const auto found = std::find_if(kept_.rbegin(), kept_.rend(), [&](const Kept& kept) {
        return kept.source == source && kept.frame.media_s == media_s;  // same bits: an id
    });
    return found == kept_.rend() ? nullptr : &*found;
}

void SessionFrames::keep(const FrameSource& source, const Frame& frame) {
    std::size_t bytes = frame.depth->levels.size() * sizeof(float) + frame.colour_bytes();
    if (frame.undilated) bytes += frame.undilated->levels.size() * sizeof(float);
    if (frame.unseen) bytes += frame.unseen->size();
    const std::size_t room = options_.colour ? kMostOfWindow : kMostOfRun;
    const std::size_t most = std::max(room / std::max<std::size_t>(bytes, 1), kLeastKept);
    while (kept_.size() >= most) kept_.pop_front();
    kept_.push_back({source, frame});
}

namespace {

/// Why the stored surface does not do; empty: it does.
std::string video_needed(const Session& session, const SessionFramesOptions& options) {
    if (options.cleaning || options.finger) return "other cleaning or another fingertip needs it";
    const auto moves = [](const SessionSource& one) { return one.source.motion; };
    if (options.motion && !std::ranges::all_of(session.sources(), moves))
        return "the motion that was not recorded is found in it";
    return {};
}

SessionSurfaces of_video(const Session& session, const SessionFramesOptions& options) {
    auto frames = std::make_unique<SessionFrames>(session, options);
    SessionSurfaces opened{nullptr, frames->description(), frames->warning(), false};
    opened.surfaces = std::move(frames);
    return opened;
}

SessionSurfaces of_session(const Session& session, const SessionFramesOptions& options) {
    auto frames = std::make_unique<StoredFrames>(session, options.materials, options.colour);
    SessionSurfaces opened{nullptr, frames->description(), {}, true};
    opened.surfaces = std::move(frames);
    return opened;
}

}  // namespace

SessionSurfaces open_surfaces(const Session& session, const SessionFramesOptions& options,
                              SurfacesFrom from) {
    const std::string needed = video_needed(session, options);
    if (from == SurfacesFrom::session) {
        if (!needed.empty())
            throw InputError(session.file().string() + ": is not replayed from itself, as " +
                             needed + "; replay it from its video");
        return of_session(session, options);
    }
    const bool may_use_stored = from == SurfacesFrom::automatic && needed.empty() &&
                                !options.any_media && SurfaceReader(session.reader()).any();
    if (!may_use_stored) return of_video(session, options);
    // The video of another version may give other bits, but a surface with holes surely does.
    std::string why = session.has_all_surfaces() ? version_warning(session, true) : "";
    try {
        if (why.empty()) return of_video(session, options);
    } catch (const InputError& error) {
        why = error.what();
    }
    SessionSurfaces opened = of_session(session, options);
    opened.warning = "replayed from the surface that the session holds, as " + why;
    return opened;
}

}  // namespace dibhr
