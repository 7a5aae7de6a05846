// Finds the places of the steps in the label pictures of the sample, and follows what is done
// there.
#include "app/viewer/guide/lead.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <utility>

#include "app/settings/recent_files.hpp"
#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

constexpr const char* kNose = "Nose";
constexpr const char* kJumper = "Jumper";
constexpr double kStep_s = 6.5;         // three steps: 20 s
constexpr double kDone_s = 0.8;         // how long its tick is shown
constexpr double kLongestTurn_s = 0.3;  // of the window, that counts
constexpr double kPictures_per_s = 10;  // of what moves by itself
constexpr double kEnough = 0.12;        // of the picture's width: so far the jumper is stroked
constexpr double kMiddle = 0.15;        // a way keeps this share of it free at each end

std::filesystem::path led_path() {
    return recent_files_path().parent_path() / "led";
}

/// The label of that region; 0: there is none.
std::uint8_t label_of(const Regions& regions, const char* name) {
    const auto found = std::ranges::find(regions.regions, name, &Region::name);
    if (found == regions.regions.end()) return 0;
    return static_cast<std::uint8_t>(found - regions.regions.begin() + 1);
}

/// Pixels of one label in a label picture.
struct Patch {
    double column{0.0}, row{0.0};  ///< its middle
    int count{0};
};

Patch patch_of(const Regions& regions, int picture, std::uint8_t label) {
    Patch patch;
    for (int j = 0; j < regions.rows; ++j) {
        for (int i = 0; i < regions.columns; ++i) {
            if (regions.label(picture, i, j) != label) continue;
            patch.column += i + 0.5;
            patch.row += j + 0.5;
            ++patch.count;
        }
    }
    patch.column /= std::max(patch.count, 1);
    patch.row /= std::max(patch.count, 1);
    return patch;
}

/// Pixels of one label side by side.
struct Run {
    int first{0}, count{0};
};

/// The longest one of a row.
Run longest_run(const Regions& regions, int picture, int row, std::uint8_t label) {
    Run longest;
    Run here;
    for (int i = 0; i < regions.columns; ++i) {
        if (regions.label(picture, i, row) != label) {
            here.count = 0;
            continue;
        }
        if (here.count++ == 0) here.first = i;
        if (here.count > longest.count) longest = here;
    }
    return longest;
}

/// Whether the proxy touches the region of that name, as the guide has found for this turn.
bool touches(const ViewerState& state, const char* name) {
    const HapticState& haptic = state.touch.haptic;
    return haptic.touchable && haptic.touch.proxy.contact && state.ui.region.name == name;
}

const char* words_of(LeadStep step) {
    switch (step) {
        case LeadStep::press:
            return "Touch the nose: hold the left mouse button on it.";
        case LeadStep::stroke:
            return "Stroke the jumper: hold the button and move.";
        case LeadStep::choose:
            break;
    }
    return "Choose Bark on the Touch panel, and touch again.";
}

/// A person does something else already.
bool is_busy(const UiState& ui) {
    return ui.explained || ui.ruler || ui.brush.on || ui.help_open || ui.dialog.shown || ui.clip ||
           ui.depth_offer || ui.depth_question || !ui.unsafe_settings.empty() ||
           !ui.message.empty();
}

}  // namespace

void ViewerLead::begin(std::shared_ptr<const Regions> regions, const ViewerState& state,
                       TaskQueue& saving) {
    std::error_code unknown;
    if (!regions || std::filesystem::exists(led_path(), unknown)) return;
    if (label_of(*regions, kNose) == 0 || label_of(*regions, kJumper) == 0) return;
    regions_ = std::move(regions);
    material_ = state.touch.material.name;
    saving_ = &saving;
}

void ViewerLead::keep_led() const {
    saving_->add([led = led_path()] {
        try {
            std::error_code failed;  // reported when the file is opened
            make_folders(led.parent_path(), failed);
            OutputFile out(led);
            out.write("dibhr has led through the first touch; delete this to be led again.\n");
            out.commit();
        } catch (const InputError&) {  // saving the settings reports it
        }
    });
}

void ViewerLead::end(ViewerState& state) {
    regions_.reset();
    state.ui.lead.reset();
    state.ui.show_touch = false;
}

void ViewerLead::begin_step(LeadStep step, ViewerState& state) {
    state.ui.lead = LeadShown{.step = step, .words = words_of(step)};
    state.ui.show_touch = step == LeadStep::choose;
    since_s_ = time_s_;
    until_s_ = time_s_ + kStep_s;
    done_s_.reset();
    stroked_to_.reset();
    picture_.reset();
}

void ViewerLead::follow(const DepthBlend& shown, double now_s, ViewerState& state) {
    const bool ready = shown.makes_surface() && state.touch.haptic.touchable;
    if (!regions_ || (!ready && !state.ui.lead)) return;
    if (is_busy(state.ui)) return end(state);
    if (!shown.makes_surface()) return;
    // A window that stands still takes no time away.
    const double turn_s = std::min(now_s - std::exchange(turn_s_, now_s), kLongestTurn_s);
    time_s_ += turn_s;
    if (!state.ui.lead) {
        keep_led();
        begin_step(LeadStep::press, state);
    }
    const double stroked_px = stroked_px_;
    if (!done_s_ && is_done(shown, state)) {
        done_s_ = time_s_;
        until_s_ = time_s_ + kDone_s;
    } else if (!done_s_ && stroked_px_ > stroked_px) {
        until_s_ += turn_s;  // a stroke may take longer
    }
    if (time_s_ > until_s_) {
        const LeadStep last = state.ui.lead->step;
        const bool hidden = last == LeadStep::stroke && !state.settings.panels_visible;
        if (last == LeadStep::choose || hidden) return end(state);
        begin_step(last == LeadStep::press ? LeadStep::stroke : LeadStep::choose, state);
    }
    LeadShown& lead = *state.ui.lead;
    lead.done = done_s_.has_value();
    lead.time_s = std::floor((time_s_ - since_s_) * kPictures_per_s) / kPictures_per_s;
    lead.places.clear();
    if (lead.step == LeadStep::choose) return;
    lead.step == LeadStep::press ? find_nose(shown) : find_jumper(shown);
    const DepthSurface surface = shown.drawn_surface(state.shape(), state.touch.bump.get());
    constexpr int kPlaces = 24;
    const int places = lead.step == LeadStep::press ? 1 : kPlaces;
    for (int k = 0; k < places; ++k) {
        const double share = static_cast<double>(k) / kPlaces;
        const double x = (from_.x + share * (to_.x - from_.x)) * surface.columns();
        const double y = (from_.y + share * (to_.y - from_.y)) * surface.rows();
        lead.places.emplace_back(x, y, surface.elevation_at(x, y));
    }
}

/// Its middle, in each label picture.
void ViewerLead::find_nose(const DepthBlend& shown) {
    const int picture = regions_->picture_at(shown.nearest().media_s);
    if (std::exchange(picture_, picture) == picture) return;
    const Patch nose = patch_of(*regions_, picture, label_of(*regions_, kNose));
    if (nose.count > 0) from_ = {nose.column / regions_->columns, nose.row / regions_->rows};
}

/// A way across it, which stays where it was first found.
void ViewerLead::find_jumper(const DepthBlend& shown) {
    if (picture_) return;
    picture_ = regions_->picture_at(shown.nearest().media_s);
    const std::uint8_t label = label_of(*regions_, kJumper);
    const int row = static_cast<int>(patch_of(*regions_, *picture_, label).row);
    const Run run = longest_run(*regions_, *picture_, row, label);
    const double y = (row + 0.5) / regions_->rows;
    from_ = {(run.first + kMiddle * run.count) / regions_->columns, y};
    to_ = {(run.first + (1.0 - kMiddle) * run.count) / regions_->columns, y};
}

bool ViewerLead::is_done(const DepthBlend& shown, const ViewerState& state) {
    switch (state.ui.lead->step) {
        case LeadStep::press:
            return touches(state, kNose);
        case LeadStep::choose:
            return state.touch.material.name != material_;
        case LeadStep::stroke:
            break;
    }
    const bool on = touches(state, kJumper);
    const Vec3 now = state.touch.haptic.touch.proxy.position;
    if (on && stroked_to_) stroked_px_ += glm::distance(now, *stroked_to_);
    stroked_to_ = on ? std::optional(now) : std::nullopt;
    return stroked_px_ > kEnough * shown.from->drawn()->columns;
}

}  // namespace dibhr
