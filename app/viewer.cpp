// The viewer's window thread: input, scene, panels, and the hand-over to the other threads.
#include "app/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <utility>

#include "app/keys.hpp"
#include "app/panel_list.hpp"
#include "app/viewer_actions.hpp"
#include "app/viewer_scene.hpp"
#include "core/error.hpp"
#include "core/haptics/surface.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

using std::chrono::steady_clock;

constexpr double kNoticeTime_s = 4.0;
constexpr auto kPictureTime = std::chrono::nanoseconds(1'000'000'000 / 60);
constexpr auto kSoftwarePictureTime = std::chrono::nanoseconds(1'000'000'000 / 30);

Settings starting_settings(const ViewOptions& options) {
    Settings settings = options.settings;
    settings.touch = options.parameters;
    settings.width = options.width;
    settings.height = options.height;
    if (options.raw_depth) settings.cleaning = {false, false, false};
    return settings;
}

std::chrono::nanoseconds shortest_picture(bool sync) {
    if (!sync) return std::chrono::nanoseconds(0);
    return read_limits().software ? kSoftwarePictureTime : kPictureTime;
}

/// To the millisecond, so that no two pictures share a name.
std::string screenshot_name() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm local{};
    localtime_r(&seconds, &local);
    char date[32];
    std::strftime(date, sizeof date, "%Y%m%d-%H%M%S", &local);
    char name[64];
    std::snprintf(name, sizeof name, "dibhr-%s-%03d.png", date,
                  static_cast<int>(ms.count() % 1000));
    return std::filesystem::absolute(name).string();
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, ViewerParts parts, EndingSignals& signals)
    : options_(options),
      signals_(signals),
      hand_(std::move(parts.hand)),
      window_(options.width, options.height, options.sync, "dibhr"),
      gui_(window_),
      pace_(shortest_picture(options.sync)),
      keeper_(options.settings, starting_settings(options), settings_path()),
      start_(steady_clock::now()),
      forces_(std::make_unique<ForceRing>()) {
    state_.settings = starting_settings(options);
    state_.device = hand_.device->specification();
    state_.bump = std::move(parts.bump);
    state_.bump_file = options.bump;
    state_.fonts = gui_.fonts();
    state_.scale = gui_.scale();
    hand_over_settings();
    show_media(std::move(parts.media));
    if (!options.record.empty()) {
        ticks_ = std::make_unique<TickRing>();
        recorder_ = std::make_unique<Recorder>(options.record, *ticks_, session_facts(state_));
        state_.recording_file = options.record;
    }
    loop_ = std::make_unique<HapticLoop>(HapticConnections{
        *hand_.device, player_.haptics(), haptic_settings_, haptic_state_, *forces_, ticks_.get()});
}

void Viewer::run() {
    start_ = steady_clock::now();
    while (!over()) {
        show_one_picture();
        pace_.wait();
    }
    finish();
}

void Viewer::finish() {
    loop_->stop();  // the hand is at rest before anything is written
    std::string failure;
    const auto attempt = [&failure](auto&& step) {
        try {
            step();
        } catch (const Error& error) {
            if (failure.empty()) failure = error.what();
        }
    };
    attempt([this] { write_last_picture(); });
    attempt([this] { keeper_.finish(state_.settings); });
    for (auto& screenshot : screenshots_) attempt([&screenshot] { screenshot.get(); });
    if (recorder_)
        attempt([this] {
            const RecorderStatus recorded = recorder_->finish();
            if (!recorded.failure.empty()) throw InputError(recorded.failure);
        });
    if (!failure.empty()) throw InputError(failure);
}

void Viewer::show_one_picture() {
    const WindowInput input = window_.take_input();
    take_news();
    obey_keys(input);
    if (const auto dropped = dropped_request(input.dropped)) {
        state_.requests.open = dropped;
    } else if (!input.dropped.empty()) {
        state_.message = "drop one colour file, or a colour and a depth file together";
    }
    state_.window_width = static_cast<float>(window_.framebuffer_size().x);
    const glm::ivec2 viewport = relief_viewport();
    move_hand(input, viewport);
    draw_scene(viewport);
    draw_panels();
    carry_out_requests();
    hand_over_settings();
    keep_settings();
    window_.show_picture();
}

void Viewer::take_news() {
    state_.playback = player_.status();
    state_.haptic = haptic_state_.front();
    state_.touched = state_.touched || state_.haptic.touch.proxy.contact;
    if (!state_.grants) state_.grants = loop_->grants();
    if (recorder_) state_.recording = recorder_->status();
    for (ForceSample sample; forces_->pop(sample);) state_.forces.add(sample.sent_newton);
    state_.pictures_per_s = pace_.pictures_per_s();
    if (auto opened = opening_.take()) {
        if (opened->media) show_media(std::move(opened->media));
        state_.message = opened->failure;
    }
    state_.opening = opening_.under_way();
    tell_once(state_.playback.failure, playback_failure_);
    if (state_.recording) tell_once(state_.recording->failure, recording_failure_);
    collect_screenshots();
}

void Viewer::obey_keys(const WindowInput& input) {
    if (gui_.wants_keyboard()) state_.fields.ask_for_keyboard = 0;
    // A name typed right after Ctrl+O is no key, even before the field has the keyboard.
    const bool typing = gui_.wants_keyboard() || state_.fields.ask_for_keyboard > 0;
    for (const KeyPress& press : input.keys) {
        if (const auto action = action_of_key(press.key, press.control, typing, press.repeated))
            perform(*action, state_, player_);
    }
    if (typing) return;
    for (const TypedCharacter& typed : input.characters) {
        if (const auto action = action_of_character(typed.code, typed.repeated))
            perform(*action, state_, player_);
    }
}

void Viewer::move_hand(const WindowInput& input, glm::ivec2 viewport) {
    const FrameWindow& frames = player_.picture().front();
    shown_ = frames.at(frames.clock.playback_s(steady_clock::now()));
    const Pointer pointer = window_.pointer();
    const PointerUse use =
        mouse_.use(pointer, input.wheel_steps, gui_.wants_pointer(), viewport, camera_);
    if (hand_.mouse == nullptr || !shown_.makes_surface()) return;
    const DepthSurface surface(*shown_.from->depth, *shown_.to->depth, shown_.blend,
                               state_.settings.touch.shape, state_.bump.get());
    const Camera::Ray ray = camera_.ray_under(pointer.position_px, viewport);
    hand_.mouse->target().publish(pointer_.target(ray, surface, use));
}

void Viewer::draw_scene(glm::ivec2 viewport) {
    camera_.set_projection(state_.settings.straight_view ? Camera::Projection::straight
                                                         : Camera::Projection::perspective);
    scene_.draw(scene_content(state_, shown_), camera_, viewport);
}

void Viewer::draw_panels() {
    gui_.begin();
    if (state_.settings.panels_visible) {
        draw_panel_column(state_, player_);
        draw_transport_bar(state_, player_);
    }
    if (state_.touched) hint_alpha_ = std::max(0.0F, hint_alpha_ - 0.03F);
    if (hand_.mouse != nullptr && state_.message.empty()) draw_hint(state_, hint_alpha_);
    draw_overlay(state_, now_s());
    draw_help_sheet(state_);
    draw_message_box(state_);
    gui_.end();
}

void Viewer::carry_out_requests() {
    const Requests asked = std::exchange(state_.requests, {});
    if (asked.open && !opening_.start(*asked.open)) tell("Still opening the last files");
    if (asked.bump) load_bump(*asked.bump);
    if (asked.reset_view) frame_relief();
    if (asked.full_screen) window_.toggle_full_screen();
    if (asked.screenshot) save_screenshot();
    if (asked.quit) window_.close();
}

void Viewer::hand_over_settings() {
    SafetyLimits limits;
    limits.max_force_newton =
        std::min(state_.settings.max_force_newton, state_.device.max_force_newton);
    const bool same = handed_.version > 0 && handed_.parameters == state_.settings.touch &&
                      handed_.force_enabled == state_.force_enabled &&
                      handed_.bump == state_.bump &&
                      !(std::abs(handed_.limits.max_force_newton - limits.max_force_newton) > 0.0);
    if (!same) {
        handed_ = {state_.settings.touch, limits, state_.force_enabled, state_.bump,
                   handed_.version + 1};
        haptic_settings_.publish(handed_);
    }
    if (!(cleaning_handed_ == state_.settings.cleaning)) {
        cleaning_handed_ = state_.settings.cleaning;
        player_.set_cleaning(cleaning_handed_);
    }
}

void Viewer::keep_settings() {
    const glm::ivec2 size = window_.window_size();
    state_.settings.width = size.x;
    state_.settings.height = size.y;
    try {
        keeper_.look(state_.settings, now_s());
    } catch (const InputError& error) {
        state_.message = error.what();
    }
}

void Viewer::show_media(std::unique_ptr<Media> media) {
    state_.media = media->description();
    frame_relief();
    window_.set_title(state_.media.colour_path.filename().string() + " - dibhr");
    player_.play_media(std::move(media));
}

void Viewer::frame_relief() {
    camera_.frame_relief(state_.media.depth_columns, state_.media.depth_rows,
                         state_.settings.touch.shape.relief_px);
}

void Viewer::load_bump(const std::filesystem::path& file) {
    try {
        state_.bump = file.empty() ? nullptr : std::make_shared<const BumpMap>(read_bump_map(file));
        state_.bump_file = file;
    } catch (const Error& error) {
        state_.message = error.what();
    }
}

void Viewer::save_screenshot() {
    const auto write = [picture = read_framebuffer(window_.framebuffer_size()),
                        file = screenshot_name()] {
        write_png(picture, file);
        return "Saved " + file;
    };
    screenshots_.push_back(std::async(std::launch::async, write));
}

void Viewer::collect_screenshots() {
    std::erase_if(screenshots_, [this](auto& screenshot) {
        if (screenshot.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        try {
            tell(screenshot.get());
        } catch (const InputError& error) {
            state_.message = error.what();
        }
        return true;
    });
}

void Viewer::write_last_picture() {
    if (options_.screenshot.empty()) return;
    // Drawn again: what a buffer holds after it was shown is up to the driver.
    draw_scene(relief_viewport());
    draw_panels();
    write_png(read_framebuffer(window_.framebuffer_size()), options_.screenshot);
}

void Viewer::tell_once(const std::string& failure, std::string& told) {
    if (failure == told) return;
    told = failure;
    if (!failure.empty()) state_.message = failure;
}

void Viewer::tell(const std::string& notice) {
    state_.notice = notice;
    state_.notice_until_s = now_s() + kNoticeTime_s;
}

double Viewer::now_s() const {
    return std::chrono::duration<double>(steady_clock::now() - start_).count();
}

bool Viewer::over() {
    return signals_.arrived() || window_.wants_to_close() ||
           (options_.seconds && now_s() >= *options_.seconds);
}

glm::ivec2 Viewer::relief_viewport() const {
    glm::ivec2 size = window_.framebuffer_size();
    size.x -= static_cast<int>(panel_column_width(state_));
    return glm::max(size, glm::ivec2(1));
}

}  // namespace dibhr
