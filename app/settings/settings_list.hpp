// The one list of all settings, which reading, writing and comparing them share.
#pragma once

#include <optional>
#include <string_view>

#include "app/settings/settings.hpp"
#include "core/haptics/algorithm.hpp"
#include "core/haptics/parameter_table.hpp"

namespace dibhr {

struct Range {
    double lowest;
    double highest;
};

/// The values of an enumeration as words.
template <typename Enum>
struct Words {
    std::optional<Enum> (*named)(std::string_view) noexcept;
    const char* (*name_of)(Enum) noexcept;
    std::string_view what;  ///< "the name of an algorithm"
};

inline constexpr Words<Algorithm> kAlgorithmWords{algorithm_named, name_of,
                                                  "the name of an algorithm"};
inline constexpr Words<ButtonAction> kButtonWords{button_action_named, name_of,
                                                  "what a button can do"};

/// The mouse's virtual hand and the Falcon alike.
inline constexpr double kDeviceMaxForce_newton = 8.0;

/// [falcon]: what is kept about the Falcon.
template <typename Visitor>
void visit_falcon_settings(FalconSettings& s, Visitor& visit) {
    visit.text("falcon", "serial", s.connection.serial);
    visit.flag("falcon", "event-character", s.connection.event_character);
    visit.flag("falcon", "slower-upload", s.connection.slower_upload);
    visit.flag("falcon", "force-in-front-only", s.force_in_front_only);
    for (const FalconNumber& number : falcon_numbers()) {
        visit.number("falcon", number.name, number.in(s), {number.lowest, number.highest});
    }
    for (std::size_t k = 0; k < kFalconButtons; ++k) {
        visit.word("falcon", kGripButtons[k].setting, s.buttons[k], kButtonWords);
    }
}

/// Every value that a settings file holds, visited with table, name and range. `Visitor` has a
/// member for each type.
template <typename Visitor>
void visit_settings(Settings& s, Visitor& visit) {
    visit.integer("window", "width", s.width, {kSmallestWindow, kLargestWindow});
    visit.integer("window", "height", s.height, {kSmallestWindow, kLargestWindow});
    visit.flag("window", "panels-visible", s.panels_visible);
    visit.flag("panels", "video", s.panels.video);
    visit.flag("panels", "surface", s.panels.surface);
    visit.flag("panels", "touch", s.panels.touch);
    visit.flag("panels", "device", s.panels.device);
    visit.flag("panels", "session", s.panels.session);
    visit.flag("panels", "loop", s.panels.loop);
    visit.word("touch", "algorithm", s.touch.algorithm, kAlgorithmWords);
    for (const TouchNumber& option : touch_numbers()) {
        visit.number("touch", option.name, option.in(s.touch), {option.lowest, option.highest});
    }
    visit.number("device", "max-force", s.max_force_newton, {0.0, kDeviceMaxForce_newton});
    visit_falcon_settings(s.falcon, visit);
    visit.flag("cleaning", "fill-holes", s.cleaning.fill_holes);
    visit.flag("cleaning", "remove-spikes", s.cleaning.remove_spikes);
    visit.flag("cleaning", "smooth-steps", s.cleaning.smooth_steps);
    visit.flag("look", "discard-silhouettes", s.look.discard_silhouettes);
    visit.number("look", "silhouette-slope", s.look.silhouette_slope, {1.0, 100.0});
    visit.flag("look", "textured", s.look.textured);
    visit.number("look", "light", s.look.light, {0.0, 1.0});
    visit.flag("look", "coarse", s.look.coarse);
    visit.flag("look", "straight-view", s.straight_view);
}

}  // namespace dibhr
