// Opening files in the background, and telling colour from depth.
#include "app/viewer_opening.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kGreyTolerance =
    12;  // levels between channels that video compression leaves in a grey picture

std::string lower_name(const fs::path& file) {
    std::string name = file.filename().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
}

bool named_depth(const fs::path& file) {
    return lower_name(file).find("depth") != std::string::npos;
}

bool is_grey(const ColourImage& picture) {
    std::size_t coloured = 0;
    for (std::size_t k = 0; k + 2 < picture.rgb.size(); k += 3) {
        const int r = picture.rgb[k];
        const int g = picture.rgb[k + 1];
        const int b = picture.rgb[k + 2];
        if (std::abs(r - g) > kGreyTolerance || std::abs(g - b) > kGreyTolerance) ++coloured;
    }
    return coloured * 3 * 200 < picture.rgb.size();  // less than half a percent of the pixels
}

bool shows_grey(const fs::path& colour, const fs::path& depth) {
    const auto first = open_media(colour, depth)->next();
    return first && is_grey(first->colour);
}

/// `clip_depth.mp4` -> `clip_color.mp4` beside it, when there is one.
std::optional<fs::path> colour_beside(const fs::path& depth) {
    const std::string name = depth.filename().string();
    const std::size_t at = lower_name(depth).find("depth");
    if (at == std::string::npos) return {};
    for (const char* word : {"color", "colour", "rgb", "Color", "RGB"}) {
        const fs::path colour = depth.parent_path() / std::string(name).replace(at, 5, word);
        if (fs::exists(colour)) return colour;
    }
    return {};
}

Opened try_open(const OpenRequest& request) {
    try {
        return {open_request(request), {}};
    } catch (const std::exception& error) {
        return {nullptr, error.what()};
    }
}

}  // namespace

std::unique_ptr<Media> open_request(const OpenRequest& request) {
    fs::path colour = request.colour;
    fs::path depth = request.depth;
    if (request.in_any_order && depth.empty() && named_depth(colour)) {
        if (const auto found = colour_beside(colour)) depth = std::exchange(colour, *found);
    } else if (request.in_any_order && !depth.empty()) {
        const bool by_name = named_depth(colour) != named_depth(depth);
        const bool swapped = by_name ? named_depth(colour) : shows_grey(colour, depth);
        if (swapped) std::swap(colour, depth);
    }
    return open_media(colour, depth);
}

std::optional<OpenRequest> dropped_request(const std::vector<fs::path>& files) {
    if (files.empty() || files.size() > 2) return {};
    return OpenRequest{files.front(), files.size() == 2 ? files.back() : fs::path{}, true};
}

bool Opening::start(const OpenRequest& request) {
    if (under_way()) return false;
    result_ = std::async(std::launch::async, try_open, request);
    return true;
}

std::optional<Opened> Opening::take() {
    if (!under_way() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return {};
    return result_.get();
}

}  // namespace dibhr
