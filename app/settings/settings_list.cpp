// The list of all settings, and settings compared value by value.
#include "app/settings/settings_list.hpp"

#include <algorithm>
#include <cstddef>

#include "core/haptics/parameter_table.hpp"

namespace dibhr {

namespace {

/// The mouse's virtual hand and the Falcon alike.
constexpr double kDeviceMaxForce_newton = 8.0;

void add_falcon(std::vector<Setting>& list, FalconSettings& s) {
    list.insert(list.end(), {{"falcon", "serial", &s.connection.serial},
                             {"falcon", "event-character", &s.connection.event_character},
                             {"falcon", "slower-upload", &s.connection.slower_upload},
                             {"falcon", "force-in-front-only", &s.force_in_front_only}});
    for (const FalconNumber& number : falcon_numbers()) {
        list.push_back({"falcon", number.name, &number.in(s), number.lowest, number.highest});
    }
    for (std::size_t k = 0; k < kFalconButtons; ++k) {
        list.push_back({"falcon", kGripButtons[k].setting, &s.buttons[k]});
    }
}

bool same(const Setting& a, const Setting& b) {
    return std::visit([&](auto* value) { return *value == *std::get<decltype(value)>(b.value); },
                      a.value);
}

void assign(const Setting& to, const Setting& from) {
    std::visit([&](auto* value) { *value = *std::get<decltype(value)>(from.value); }, to.value);
}

}  // namespace

std::vector<Setting> list_of(Settings& s) {
    std::vector<Setting> list{{"window", "width", &s.width, kSmallestWindow, kLargestWindow},
                              {"window", "height", &s.height, kSmallestWindow, kLargestWindow},
                              {"window", "panels-visible", &s.panels_visible},
                              {"panels", "video", &s.panels.video},
                              {"panels", "surface", &s.panels.surface},
                              {"panels", "touch", &s.panels.touch},
                              {"panels", "device", &s.panels.device},
                              {"panels", "session", &s.panels.session},
                              {"panels", "loop", &s.panels.loop},
                              {"touch", "algorithm", &s.touch.algorithm}};
    for (const TouchNumber& number : touch_numbers()) {
        list.push_back({"touch", number.name, &number.in(s.touch), number.lowest, number.highest});
    }
    list.push_back({"device", "max-force", &s.max_force_newton, 0.0, kDeviceMaxForce_newton});
    add_falcon(list, s.falcon);
    list.insert(list.end(), {{"cleaning", "fill-holes", &s.cleaning.fill_holes},
                             {"cleaning", "remove-spikes", &s.cleaning.remove_spikes},
                             {"cleaning", "smooth-steps", &s.cleaning.smooth_steps},
                             {"look", "discard-silhouettes", &s.look.discard_silhouettes},
                             {"look", "silhouette-slope", &s.look.silhouette_slope, 1.0, 100.0},
                             {"look", "textured", &s.look.textured},
                             {"look", "light", &s.look.light, 0.0, 1.0},
                             {"look", "coarse", &s.look.coarse},
                             {"look", "straight-view", &s.straight_view}});
    return list;
}

Settings changes_kept(Settings in_file, Settings started, Settings now) {
    const std::vector<Setting> kept = list_of(in_file);
    const std::vector<Setting> before = list_of(started);
    const std::vector<Setting> after = list_of(now);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (!same(before[k], after[k])) assign(kept[k], after[k]);
    }
    return in_file;
}

bool same_settings(Settings a, Settings b) {
    const std::vector<Setting> first = list_of(a);
    const std::vector<Setting> second = list_of(b);
    return std::equal(first.begin(), first.end(), second.begin(), same);
}

}  // namespace dibhr
