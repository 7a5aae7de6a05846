// Parses the metadata of Depthkit and Record3D.
#include "core/video/sources/recorder_metadata.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostText = 1U << 20U;  ///< such files have a few thousand letters
constexpr double kFarthest_m = 1000.0;

// Reading.

std::string_view trimmed(std::string_view text, std::string_view what) {
    const auto first = text.find_first_not_of(what);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(what) - first + 1);
}

/// Adds "key: 3" as a member, unless the object has that key.
void add_member(Json& object, std::string_view member) {
    const auto colon = member.find(':');
    if (colon == std::string_view::npos) return;
    const std::string key(trimmed(member.substr(0, colon), " -"));
    const auto number = number_of_text(trimmed(member.substr(colon + 1), " \r"));
    if (number && !object.contains(key)) object[key] = *number;
}

/// The numbers of a Unity asset, also those in braces, as in Depthkit's JSON of one camera.
Json asset_of(const std::string& text) {
    Json asset = Json::object();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto brace = line.find('{');
        const auto end = line.find('}');
        if (brace == std::string::npos || end == std::string::npos || end < brace) {
            add_member(asset, line);
            continue;
        }
        const std::string key(trimmed(std::string_view(line).substr(0, brace), " -:"));
        if (asset.contains(key)) {
            if (key == "depthImageSize") return {};  // of another camera
            continue;
        }
        Json& group = asset[key] = Json::object();
        std::istringstream members(line.substr(brace + 1, end - brace - 1));
        for (std::string member; std::getline(members, member, ',');) add_member(group, member);
    }
    return asset;
}

struct Pair {
    double x{0.0}, y{0.0};
};

/// Two members of an object as a pair.
std::optional<Pair> pair_in(const Json& object, const char* key, const char* x = "x",
                            const char* y = "y") {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_object()) return std::nullopt;
    const auto first = finite_number_in(*found, x);
    const auto second = finite_number_in(*found, y);
    if (!first || !second) return std::nullopt;
    return Pair{*first, *second};
}

std::optional<DepthRange> range_of(std::optional<double> near, std::optional<double> far) {
    if (!near || !far || *near < 0.0 || !(*far > *near) || *far > kFarthest_m) return std::nullopt;
    return DepthRange{*near, *far};
}

// Depthkit.

/// The part of the depth camera's picture that the video shows [pixels of the camera].
struct Crop {
    Pair corner{};
    Pair size{};
};

bool has_pixels(const Crop& crop) {
    constexpr double kMostAlong = 1e6;
    return std::min(crop.size.x, crop.size.y) >= 1.0 &&
           std::max(crop.size.x, crop.size.y) <= kMostAlong;
}

std::optional<Crop> crop_of(const Json& camera) {
    const auto whole = pair_in(camera, "depthImageSize");
    if (!whole || !(whole->x >= 2.0) || !(whole->y >= 2.0)) return std::nullopt;
    const Pair corner = pair_in(camera, "crop").value_or(Pair{0.0, 0.0});
    const Pair part = pair_in(camera, "crop", "z", "w").value_or(Pair{1.0, 1.0});
    if (!(part.x > 0.0) || !(part.y > 0.0) || part.x > 1.0 || part.y > 1.0) return std::nullopt;
    const Crop crop{{corner.x * whole->x, corner.y * whole->y},
                    {part.x * whole->x, part.y * whole->y}};
    return has_pixels(crop) ? std::optional(crop) : std::nullopt;
}

/// Whether the lower half of such a picture shows the crop with square pixels.
bool has_proportions(cv::Size picture, const Crop& crop) {
    constexpr double kAlike = 0.02;
    const double shown = 2.0 * picture.width / std::max(picture.height, 1);
    return std::abs(shown / (crop.size.x / crop.size.y) - 1.0) < kAlike;
}

void set_camera(const Json& camera, const Crop& crop, PackedForm& form) {
    const auto focal = pair_in(camera, "depthFocalLength");
    const auto centre = pair_in(camera, "depthPrincipalPoint");
    if (!focal || !centre) return;
    const Intrinsics intrinsics{focal->x, focal->y, centre->x - crop.corner.x,
                                centre->y - crop.corner.y};
    if (!is_camera(intrinsics)) return;
    form.finding.statement.intrinsics = intrinsics;
    form.intrinsics_size = {static_cast<int>(std::lround(crop.size.x)),
                            static_cast<int>(std::lround(crop.size.y))};
}

/// The form by metadata of one camera, whose members are at top level (0.1) or in `perspectives`.
std::optional<PackedForm> depthkit_form(const Json& metadata, cv::Size picture, bool of_that_name) {
    const auto perspectives = metadata.find("perspectives");
    const bool nested = perspectives != metadata.end() && perspectives->is_array();
    if (nested && perspectives->size() != 1) return std::nullopt;
    const Json& camera = nested ? perspectives->front() : metadata;
    if (!camera.is_object()) return std::nullopt;
    const auto range =
        range_of(finite_number_in(camera, "nearClip"), finite_number_in(camera, "farClip"));
    const auto crop = crop_of(camera);
    if (!range || !crop || !(of_that_name || has_proportions(picture, *crop))) return std::nullopt;
    PackedForm form;
    form.packing = DepthPacking::top_bottom;
    form.hue = HueCode{range};
    if (has_proportions(picture, *crop)) set_camera(camera, *crop, form);
    return form;
}

// Record3D.

/// Accepts column-major and row-major matrices: skew and last row are 0.
std::optional<Intrinsics> matrix_of(const Json& metadata) {
    const auto found = metadata.find("intrinsicMatrix");
    if (found == metadata.end() || !found->is_array() || found->size() != 9) return std::nullopt;
    std::array<double, 9> k{};
    for (std::size_t at = 0; at < k.size(); ++at) {
        if (!(*found)[at].is_number()) return std::nullopt;
        k[at] = (*found)[at].get<double>();
    }
    const Intrinsics camera{k[0], k[4], k[2] + k[6], k[5] + k[7]};
    return is_camera(camera) ? std::optional(camera) : std::nullopt;
}

/// Whether the camera's centre is near the middle of a half of the picture.
bool looks_through(const Intrinsics& camera, cv::Size picture) {
    const double x = 2.0 * camera.cx / std::max(picture.width / 2, 1);
    const double y = 2.0 * camera.cy / std::max(picture.height, 1);
    return x > 0.7 && x < 1.3 && y > 0.7 && y < 1.3;
}

std::optional<PackedForm> record3d_form(const Json& metadata, cv::Size picture) {
    const auto camera = matrix_of(metadata);
    if (!camera || !looks_through(*camera, picture)) return std::nullopt;
    std::optional<DepthRange> range;
    const auto said = metadata.find("rangeOfEncodedDepth");
    if (said != metadata.end() && said->is_array() && said->size() == 2 && (*said)[0].is_number() &&
        (*said)[1].is_number())
        range = range_of((*said)[0].get<double>(), (*said)[1].get<double>());
    PackedForm form;
    form.packing = DepthPacking::right_left;
    form.hue = record3d_code(range);
    form.finding.statement.intrinsics = camera;
    return form;
}

/// The metadata at the end of an .mp4, where its container keeps such texts.
std::optional<PackedForm> form_inside(const fs::path& video, cv::Size picture) {
    static constexpr std::array kEndings{".mp4", ".mov", ".m4v"};
    const std::string ending = lower_case(video.extension().string());
    if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) return std::nullopt;
    const std::string text = end_of(video, kMostText);
    const auto begin = text.rfind("{\"intrinsic");
    if (begin == std::string::npos) return std::nullopt;
    const auto end = text.find('}', begin);  // it holds no other braces
    if (end == std::string::npos) return std::nullopt;
    const Json metadata = parsed_json(std::string_view(text).substr(begin, end - begin + 1));
    if (!metadata.is_object()) return std::nullopt;
    return record3d_form(metadata, picture);
}

// Beside the video.

constexpr std::array<std::string_view, 4> kMetadataEndings{".metadata.asset", "_meta.txt",
                                                           "metadata.json", "metadata.txt"};

/// Endings that also other texts have: only of the video's own name.
constexpr std::array<std::string_view, 2> kPlainEndings{".txt", ".json"};

/// The video's name in the name of a metadata file: "take" of "take_meta.txt"; else nothing.
std::optional<std::string> described_by(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    for (const std::string_view ending : kMetadataEndings) {
        if (name.ends_with(ending))
            return std::string(trimmed(name.substr(0, name.size() - ending.size()), " ._-"));
    }
    return std::nullopt;
}

struct MetadataFile {
    fs::path file{};
    bool of_that_name{false};
};

/// The files that may describe the video, the likeliest first: the metadata file with its name;
/// else a text with its name, and the only metadata file.
std::vector<MetadataFile> metadata_beside(const fs::path& video) {
    const std::string stem = lower_case(video.stem().string());
    std::vector<MetadataFile> own;
    std::vector<MetadataFile> others;
    std::error_code failed;
    const fs::path folder = video.has_parent_path() ? video.parent_path() : fs::path(".");
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const fs::path& file = entry->path();
        const auto described = described_by(file);
        if (described == stem) return {{file, true}};
        const std::string ending = lower_case(file.extension().string());
        const bool is_plain =
            std::find(kPlainEndings.begin(), kPlainEndings.end(), ending) != kPlainEndings.end();
        if (described)
            others.push_back({file, false});
        else if (is_plain && lower_case(file.stem().string()) == stem)
            own.push_back({file, true});
    }
    if (others.size() == 1) own.push_back(others.front());
    return own;
}

std::optional<PackedForm> form_in(const MetadataFile& beside, cv::Size picture) {
    const std::string text = beginning_of(beside.file, kMostText);
    const bool is_asset = lower_case(beside.file.extension().string()) == ".asset";
    const Json metadata = is_asset ? asset_of(text) : parsed_json(text);
    if (!metadata.is_object()) return std::nullopt;
    auto form = depthkit_form(metadata, picture, beside.of_that_name);
    if (!form) form = record3d_form(metadata, picture);
    if (form) form->finding.reason = shown(beside.file.filename());
    return form;
}

std::optional<PackedForm> form_beside(const fs::path& video, cv::Size picture) {
    for (const MetadataFile& beside : metadata_beside(video))
        if (auto form = form_in(beside, picture)) return form;
    return std::nullopt;
}

}  // namespace

std::optional<PackedForm> form_by_recorder(const fs::path& video, cv::Size picture) {
    auto form = form_beside(video, picture);
    if (!form) {
        form = form_inside(video, picture);
        if (form) form->finding.reason = "Record3D's metadata in the file";
    }
    if (!form) return std::nullopt;
    form->finding.evidence = Evidence::metadata;
    form->finding.sureness = kSurenessOfMetadata;
    form->coded = form->finding;
    form->coded.statement = {.code = DepthCode::hue};
    return form;
}

}  // namespace dibhr
