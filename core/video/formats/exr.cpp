// Chooses the channels of OpenEXR files and reads them.
#include "core/video/formats/still_picture.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;
using Imath::Box2i;

constexpr double kRenderersInfinity = 1e9;  // Blender writes 1e10 where there is nothing

/// Channels of one part, in the order in which a picture has them.
struct Channels {
    int part{0};
    std::vector<std::string> names{};
};

/// A channel that may be depth, unless the other one is in its layer, too: then both are
/// coordinates of something else (a normal, a texture).
struct DepthKind {
    std::string_view name;
    std::string_view not_beside;
};

/// "ViewLayer.Depth.Z": "ViewLayer.Depth." and "Z".
std::pair<std::string, std::string> layer_and_name(const std::string& channel) {
    const auto point = channel.rfind('.');
    if (point == std::string::npos) return {{}, channel};
    return {channel.substr(0, point + 1), channel.substr(point + 1)};
}

bool is_flat(const Imf::Header& header) {
    return !header.hasType() || !Imf::isDeepData(header.type());
}

bool has(const Imf::ChannelList& channels, const std::string& name) {
    return channels.findChannel(name) != nullptr;
}

/// The first layer for which `channels_in(list, layer, name)` is not empty; preferably one whose
/// name holds `word`.
template <typename Choose>
std::optional<Channels> find_channels(const Imf::MultiPartInputFile& input, std::string_view word,
                                      Choose channels_in) {
    std::optional<Channels> first;
    for (int part = 0; part < input.parts(); ++part) {
        const Imf::Header& header = input.header(part);
        if (!is_flat(header)) continue;
        const Imf::ChannelList& list = header.channels();
        for (auto channel = list.begin(); channel != list.end(); ++channel) {
            const auto [layer, name] = layer_and_name(channel.name());
            Channels found{part, channels_in(list, layer, name)};
            if (found.names.empty()) continue;
            const std::string part_name = header.hasName() ? header.name() : std::string();
            if (layer.empty() || lower_case(layer + part_name).find(word) != std::string::npos)
                return found;
            if (!first) first = std::move(found);
        }
    }
    return first;
}

std::optional<Channels> find_kind(const Imf::MultiPartInputFile& input, const DepthKind& kind) {
    return find_channels(
        input, "depth",
        [&kind](const Imf::ChannelList& list, const std::string& layer,
                const std::string& name) -> std::vector<std::string> {
            if (name != kind.name || has(list, layer + std::string(kind.not_beside))) return {};
            return {layer + name};
        });
}

std::optional<Channels> find_depth(const Imf::MultiPartInputFile& input) {
    if (auto z = find_kind(input, {"Z", "X"})) return z;
    return find_kind(input, {"V", "U"});
}

std::optional<Channels> find_colour(const Imf::MultiPartInputFile& input) {
    return find_channels(input, "combined",
                         [](const Imf::ChannelList& list, const std::string& layer,
                            const std::string& name) -> std::vector<std::string> {
                             if (name != "R" || !has(list, layer + "G") || !has(list, layer + "B"))
                                 return {};
                             return {layer + "B", layer + "G", layer + "R"};
                         });
}

/// The channels used as depth where none is named so.
std::optional<Channels> find_grey(const Imf::MultiPartInputFile& input) {
    if (auto luminance = find_kind(input, {"Y", "X"})) return luminance;
    if (auto colour = find_colour(input)) return colour;
    return find_kind(input, {"R", "G"});
}

[[noreturn]] void refuse_as_damaged(const fs::path& file) {
    throw InputError(shown(file) +
                     " cannot be decoded as an EXR picture: it may be damaged, export it again");
}

std::int64_t columns_of(const Box2i& window) {
    return std::int64_t{window.max.x} - window.min.x + 1;
}

std::int64_t rows_of(const Box2i& window) {
    return std::int64_t{window.max.y} - window.min.y + 1;
}

/// The data inside the display window, at its place; `nothing` elsewhere.
cv::Mat in_display(const cv::Mat& values, const Box2i& data, const Box2i& display, float nothing) {
    if (data == display) return values;
    cv::Mat seen(static_cast<int>(rows_of(display)), static_cast<int>(columns_of(display)),
                 values.type(), cv::Scalar::all(nothing));
    const int left = std::max(data.min.x, display.min.x);
    const int top = std::max(data.min.y, display.min.y);
    const int right = std::min(data.max.x, display.max.x);
    const int bottom = std::min(data.max.y, display.max.y);
    if (right < left || bottom < top) return seen;
    const cv::Size size(right - left + 1, bottom - top + 1);
    values(cv::Rect({left - data.min.x, top - data.min.y}, size))
        .copyTo(seen(cv::Rect({left - display.min.x, top - display.min.y}, size)));
    return seen;
}

/// Bounds what the library allocates: all channels of a tile, or of the rows packed together.
void require_plausible_blocks(const fs::path& file, const Imf::Header& header) {
    constexpr std::int64_t kMostRows = 256;
    std::int64_t channel_bytes = 0;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
        channel_bytes += sizeof(float);
    const Box2i& data = header.dataWindow();
    const bool tiled = header.hasTileDescription();
    const std::int64_t columns = tiled ? header.tileDescription().xSize : columns_of(data);
    const std::int64_t rows =
        tiled ? header.tileDescription().ySize : std::min(rows_of(data), kMostRows);
    require_plausible_size(file, columns, rows, channel_bytes);
}

cv::Mat read_channels(Imf::MultiPartInputFile& input, const Channels& channels,
                      const fs::path& file, float nothing) {
    const Imf::Header& header = input.header(channels.part);
    const Box2i data = header.dataWindow();
    const Box2i display = header.displayWindow();
    const auto count = channels.names.size();
    const std::size_t pixel_bytes = count * sizeof(float);
    for (const Box2i& window : {data, display})
        require_plausible_size(file, columns_of(window), rows_of(window),
                               static_cast<int>(pixel_bytes));
    require_plausible_blocks(file, header);
    Imf::InputPart part(input, channels.part);
    cv::Mat values(static_cast<int>(rows_of(data)), static_cast<int>(columns_of(data)),
                   CV_32FC(static_cast<int>(count)));
    Imf::FrameBuffer buffer;
    for (std::size_t k = 0; k < count; ++k)
        buffer.insert(channels.names[k], Imf::Slice::Make(Imf::FLOAT, values.ptr<float>() + k, data,
                                                          pixel_bytes, values.step[0]));
    part.setFrameBuffer(buffer);
    part.readPixels(data.min.y, data.max.y);
    return in_display(values, data, display, nothing);
}

/// One channel of several that are equal, or of which the others are empty: simulators write depth
/// into R alone.
cv::Mat only_channel(const cv::Mat& values) {
    if (values.channels() == 1) return values;
    std::vector<cv::Mat> planes;
    cv::split(values, planes);
    const bool equal = std::all_of(planes.begin(), planes.end(), [&](const cv::Mat& plane) {
        return cv::countNonZero((plane != planes[0]) & (plane == plane)) == 0;
    });
    if (equal) return planes[0];
    const auto is_used = [](const cv::Mat& plane) {
        return cv::countNonZero((plane != 0.0) & (plane == plane)) > 0;
    };
    const bool has_one = std::count_if(planes.begin(), planes.end(), is_used) == 1;
    return has_one ? *std::find_if(planes.begin(), planes.end(), is_used) : values;
}

StillPicture read_colour(Imf::MultiPartInputFile& input, const fs::path& file) {
    const auto colour = find_colour(input);
    if (!colour)
        throw InputError(shown(file) +
                         " has no channels R, G and B: give it as the depth file, and the colour "
                         "file first");
    return {screen_colours(read_channels(input, *colour, file, 0.0F)), 8, "EXR"};
}

/// Renderers write metres or other units there, and estimators one over the distance, too.
constexpr double kSurenessOfZ = 0.9;

StillPicture read_depth(Imf::MultiPartInputFile& input, const fs::path& file) {
    const auto named = find_depth(input);
    const auto chosen = named ? named : find_grey(input);
    if (!chosen)
        throw InputError(shown(file) +
                         " has no channel Z, V, Y or R that could be depth: export it with Z");
    constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
    cv::Mat values = read_channels(input, *chosen, file, kNothing);
    cv::Mat single = values.reshape(1);
    single.setTo(kNothing, ~(single < kRenderersInfinity));
    StillPicture still{only_channel(values), kRealBits, "EXR"};
    if (named && layer_and_name(named->names[0]).second == "Z")
        still.findings = {{{.unit = DepthUnit::m},
                           Evidence::metadata,
                           kSurenessOfZ,
                           "EXR channel " + named->names[0]}};
    return still;
}

}  // namespace

StillPicture read_exr(const fs::path& file, PictureRole role) {
    if (!has_valid_exr_header(file)) refuse_as_damaged(file);
    try {
        Imf::MultiPartInputFile input(file.c_str(), 0);
        return role == PictureRole::colour ? read_colour(input, file) : read_depth(input, file);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception&) {  // the library's messages name its internals
        refuse_as_damaged(file);
    }
}

bool exr_has_colour_and_depth(const fs::path& file) {
    if (!has_valid_exr_header(file)) return false;
    try {
        const Imf::MultiPartInputFile input(file.c_str(), 0);
        return find_colour(input).has_value() && find_depth(input).has_value();
    } catch (const std::exception&) {
        return false;
    }
}

}  // namespace dibhr
