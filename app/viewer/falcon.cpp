// The window thread's end of the Falcon.
#include "app/viewer/falcon.hpp"

#include <utility>

#include "device/falcon/firmware_image.hpp"

namespace dibhr {

ViewerFalcon::ViewerFalcon(const HandDevice& hand, ViewerState& state)
    : device_(hand.find<falcon::FalconDevice>()) {
    if (device_ == nullptr) return;
    FalconNews& news = state.touch.falcon.emplace();
    news.firmware = device_->firmware();
    news.firmware_trouble = device_->firmware_trouble();
    hand_over(state);
}

std::optional<std::string> ViewerFalcon::take_news(ViewerState& state) {
    if (device_ == nullptr) return {};
    FalconNews& news = *state.touch.falcon;
    news.status = device_->status();
    news.asked = true;
    return stages_.take(news.status.stage, "Falcon", news.was_ready, state);
}

std::vector<Action> ViewerFalcon::take_presses(const ViewerState& state) {
    if (device_ == nullptr) return {};
    return presses_.take(state.touch.falcon->status.presses, state.settings.falcon.buttons);
}

bool ViewerFalcon::tuning_changed(const ViewerState& state) const {
    return device_ != nullptr && !(handed_ == tuning_of(state.settings.falcon, state.touch.centred));
}

void ViewerFalcon::hand_over(const ViewerState& state) {
    if (device_ == nullptr) return;
    handed_ = tuning_of(state.settings.falcon, state.touch.centred);
    device_->tuning().publish(handed_);
}

std::string ViewerFalcon::use_firmware(const std::filesystem::path& file, ViewerState& state) {
    falcon::FirmwareImage image = falcon::keep_firmware(file);
    std::string kept = "Kept for the Falcon: " + image.name;
    if (device_ == nullptr) return kept;
    state.touch.falcon->firmware = image.name;
    state.touch.falcon->firmware_trouble.clear();
    device_->use_firmware(std::move(image));
    return kept;
}

bool named_firmware(const std::filesystem::path& file) {
    // .h: the image as an installed libnifalcon has it.
    const std::string ending = file.extension().string();
    return ending == ".bin" || ending == ".BIN" || ending == ".h";
}

}  // namespace dibhr
