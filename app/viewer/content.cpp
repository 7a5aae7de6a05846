// What the viewer shows: a video to touch or a session to replay, and the files that go with it.
#include <filesystem>
#include <memory>
#include <utility>

#include "app/panels/widgets.hpp"
#include "app/viewer/viewer.hpp"

namespace dibhr {

void Viewer::take_opened() {
    if (auto opened = opening_.take()) {
        if (opened->media) show_media(std::move(opened->media));
        if (opened->session) replay_session(std::move(opened->session));
        if (!opened->failure.empty()) state_.message = opened->failure;
    }
    state_.opening = opening_.under_way();
}

void Viewer::take_dropped(const std::vector<std::filesystem::path>& files) {
    if (files.size() == 1 && named_firmware(files.front())) {
        state_.requests.firmware = files.front();
    } else if (const auto dropped = dropped_request(files)) {
        state_.requests.open = dropped;
    } else if (!files.empty()) {
        state_.message = "drop one colour file, or a colour and a depth file together";
    }
}

void Viewer::show_media(std::unique_ptr<Media> media) {
    replay_.end(state_);
    state_.media = media->description();
    frame_relief();
    show_title(state_.media.colour_path);
    player_.play_media(std::move(media), recording_.opened(state_.media));
    if (!loop_) start_loop();
}

void Viewer::replay_session(std::unique_ptr<OpenedSession> session) {
    if (recording_.active()) tell(recording_.stop(state_));
    if (!session->frames.warning().empty()) tell(capitalised(session->frames.warning()));
    loop_.reset();  // the force goes to zero, and nobody touches
    player_.pause();
    show_title(session->session.file());
    replay_.begin(std::move(session), std::exchange(options_.given, {}), state_);
    frame_relief();
}

void Viewer::show_title(const std::filesystem::path& file) {
    window_.set_title(file.filename().string() + " - dibhr");
}

void Viewer::frame_relief() {
    camera_.frame_relief(state_.media.depth_columns, state_.media.depth_rows,
                         state_.settings.touch.shape.relief_px);
}

void Viewer::load_bump(const std::filesystem::path& file) {
    attempt([&] {
        state_.bump = file.empty() ? nullptr : std::make_shared<const BumpMap>(read_bump_map(file));
        state_.bump_file = file;
    });
}

void Viewer::start_loop() {
    hand_over_settings();
    loop_ = std::make_unique<HapticLoop>(HapticConnections{
        *hand_.device, player_.haptics(), haptic_settings_, haptic_state_, *forces_, *ticks_});
}

}  // namespace dibhr
