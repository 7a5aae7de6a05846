// Makes frames of stored images.
#include "core/replay/stored_frames.hpp"

#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/replay/frames.hpp"
#include "core/video/sources/preview_picture.hpp"

namespace dibhr {

namespace {

Frame frame_of(const FeltImage& image) {
    return {.depth = image.levels,
            .unseen = image.unseen,
            .colour = std::make_shared<const ColourImage>()};
}

/// The number of the first pair whose surface is stored.
std::int64_t first_pair(const Session& session) {
    Statement first = session.reader().rows("SELECT ifnull(min(pair), 0) FROM surface");
    return first.next() ? first.integer(0) : 0;
}

}  // namespace

StoredFrames::StoredFrames(const Session& session, const SessionMaterials::Options& options,
                           bool colour)
    : session_(session), in_colour_(colour), reader_(session.reader()) {
    if (!reader_.any() || session.sources().empty())
        throw InputError(session.file().string() + ": holds no surface; put its video back");
    surface_ = surface_of(first_pair(session));
    const DepthImage& image = *surface_.felt.images.front().levels;
    const auto stored_bump = [this](const SessionMedia& bump) {
        auto map = reader_.bump(bump.file);
        if (!map)
            throw InputError(session_.file().string() + ": does not hold the bump map " +
                             bump.file.string() + "; put its video and bump map back");
        return map;
    };
    materials_.emplace(session, options, SurfaceSize{image.columns, image.rows}, stored_bump);
}

StoredSurface StoredFrames::surface_of(std::int64_t pair) {
    std::optional<StoredSurface> surface = reader_.surface(pair);
    if (!surface)
        throw InputError(session_.file().string() + ": does not hold the surface of pair " +
                         std::to_string(pair) +
                         ", which could not be stored in time; put its video back");
    return std::move(*surface);
}

TouchedFrames StoredFrames::touched(const TickRecord& tick, const MotionRequest& /*wanted*/,
                                    const TouchedFrames* /*before*/) {
    surface_ = surface_of(tick.pair);
    const std::vector<FeltImage>& images = surface_.felt.images;
    const FramePair& pair = tick.frames;
    TouchedFrames frames{frame_of(images.front()), frame_of(images.back())};
    const auto tell = [&](Frame& frame, double media_s, std::int64_t index) {
        frame.media_s = media_s;
        frame.index = index;
        frame.media = pair.source.media;
        frame.cleaning = cleaning_of(pair.source);
        frame.colour = colour_of(frame);
        const DepthImage& image = *frame.depth;
        frame.maps = materials_->maps_of(pair.source, {image.columns, image.rows});
    };
    tell(frames.from, pair.from_s, pair.from_frame);
    tell(frames.to, pair.to_s, pair.to_frame);
    frames.from.motion = surface_.felt.motion;
    if (images.size() > 2) {
        auto between = std::make_shared<std::vector<Frame>>();
        for (std::size_t k = 1; k + 1 < images.size(); ++k) between->push_back(frame_of(images[k]));
        frames.from.in_betweens = std::move(between);
    }
    return frames;
}

/// The picture nearest in time; one without a pixel where there is none.
std::shared_ptr<const ColourImage> StoredFrames::colour_of(const Frame& frame) {
    if (!in_colour_) return frame.colour;
    const std::string& jpeg = reader_.preview(frame.media, frame.media_s);
    if (jpeg == jpeg_) return picture_;
    jpeg_ = jpeg;
    picture_ = picture_of_preview(jpeg);
    if (!picture_) picture_ = std::make_shared<const ColourImage>();
    return picture_;
}

std::shared_ptr<const BumpMap> StoredFrames::bump(const SessionParameters& parameters) {
    return materials_->bump(parameters);
}

MediaDescription StoredFrames::description() const {
    MediaDescription media;
    const SessionSource& source = session_.sources().front();
    media.colour_path = source.colour.file;
    media.depth_path = source.depth.file;
    const DepthImage& image = *surface_.felt.images.front().levels;
    media.depth_columns = image.columns;
    media.depth_rows = image.rows;
    return media;
}

}  // namespace dibhr
