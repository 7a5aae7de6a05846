// A stroke is a row of discs.
#include "app/viewer/painting/region_stroke.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kDiscsPerRadius = 4.0;  // along a stroke

}  // namespace

RegionStroke::RegionStroke(const Regions* before, const Region& region, double radius_px,
                           int columns, int rows)
    : radius_px_(std::max(radius_px, 0.5)), columns_(columns), rows_(rows) {
    if (before != nullptr) {
        regions_ = *before;
    } else {
        regions_.columns = columns;
        regions_.rows = rows;
        regions_.labels.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    }
    if (region.name.empty()) return;
    std::vector<Region>& all = regions_.regions;
    auto found = std::ranges::find(all, region.name, &Region::name);
    if (found == all.end()) {
        if (all.size() == Regions::kMost)
            throw InputError(
                "There are 255 regions already, the most: erase one, or paint more of "
                "one of them");
        found = all.insert(found, region);
    }
    found->text = region.text;
    label_ = static_cast<std::uint8_t>(found - all.begin() + 1);
}

bool RegionStroke::go_to(const Vec3& place) {
    if (last_ == place) return false;
    const Vec3 from = last_.value_or(place);
    const double way = std::hypot(place.x - from.x, place.y - from.y);
    const int discs = std::max(static_cast<int>(std::ceil(kDiscsPerRadius * way / radius_px_)), 1);
    for (int k = 1; k <= discs; ++k) {
        const double share = static_cast<double>(k) / discs;
        dab(from.x + share * (place.x - from.x), from.y + share * (place.y - from.y));
    }
    last_ = place;
    return true;
}

bool RegionStroke::has_changed(const Regions* before) const {
    return before == nullptr || before->labels != regions_.labels ||
           before->regions != regions_.regions;
}

void RegionStroke::dab(double x, double y) {
    const double across = static_cast<double>(regions_.columns) / columns_;
    const double down = static_cast<double>(regions_.rows) / rows_;
    const auto place = [](double image_px, double times) { return (image_px + 0.5) * times - 0.5; };
    const int first_j = std::max(static_cast<int>(std::ceil(place(y - radius_px_, down))), 0);
    const int last_j =
        std::min(static_cast<int>(std::floor(place(y + radius_px_, down))), regions_.rows - 1);
    for (int j = first_j; j <= last_j; ++j) {
        const double dy = (j + 0.5) / down - 0.5 - y;
        const double half = std::sqrt(std::max(radius_px_ * radius_px_ - dy * dy, 0.0));
        const int first_i = std::max(static_cast<int>(std::ceil(place(x - half, across))), 0);
        const int last_i =
            std::min(static_cast<int>(std::floor(place(x + half, across))), regions_.columns - 1);
        for (int picture = 0; picture < regions_.pictures && last_i >= first_i; ++picture) {
            const std::size_t row =
                static_cast<std::size_t>(picture) * static_cast<std::size_t>(regions_.rows) +
                static_cast<std::size_t>(j);
            const auto begin =
                regions_.labels.begin() +
                static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(regions_.columns)) +
                first_i;
            std::fill_n(begin, last_i - first_i + 1, label_);
        }
    }
}

std::shared_ptr<const Regions> without_bare(const Regions& regions) {
    std::array<bool, Regions::kMost + 1> used{};
    for (const std::uint8_t label : regions.labels) used.at(label) = true;
    auto kept = std::make_shared<Regions>(regions);
    kept->regions.clear();
    std::array<std::uint8_t, Regions::kMost + 1> renamed{};
    for (std::size_t k = 0; k < regions.regions.size(); ++k) {
        if (!used.at(k + 1)) continue;
        kept->regions.push_back(regions.regions[k]);
        renamed.at(k + 1) = static_cast<std::uint8_t>(kept->regions.size());
    }
    if (kept->regions.empty()) return nullptr;
    for (std::uint8_t& label : kept->labels) label = renamed.at(label);
    return kept;
}

}  // namespace dibhr
