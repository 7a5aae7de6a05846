// Opening files in the background, and telling colour from depth.
#include "app/viewer/opening.hpp"

#include <chrono>
#include <cstdlib>
#include <utility>

#include "core/error.hpp"
#include "core/video/input_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

// Levels between channels that video compression leaves in a grey picture.
constexpr int kGreyTolerance = 12;

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

Opened try_open(const OpenRequest& request) {
    try {
        if (asks_for_session(request)) {
            return {nullptr, std::make_unique<OpenedSession>(request.colour, false), {}};
        }
        return {open_request(request), nullptr, {}};
    } catch (const std::exception& error) {
        return {nullptr, nullptr, error.what()};
    }
}

}  // namespace

std::unique_ptr<Media> open_request(const OpenRequest& request) {
    fs::path colour = request.colour;
    fs::path depth = request.depth;
    if (request.in_any_order && depth.empty() && named_depth(colour)) {
        if (const auto found = find_colour_beside(colour)) depth = std::exchange(colour, *found);
    } else if (request.in_any_order && !depth.empty()) {
        const bool by_name = named_depth(colour) != named_depth(depth);
        const bool swapped = by_name ? named_depth(colour) : shows_grey(colour, depth);
        if (swapped) std::swap(colour, depth);
    }
    return open_media(colour, depth);
}

bool asks_for_session(const OpenRequest& request) {
    return request.depth.empty() && names_session(request.colour);
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
