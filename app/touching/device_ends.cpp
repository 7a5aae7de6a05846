// The window thread's ends of the force devices.
#include "app/touching/device_ends.hpp"

#include "device/falcon/firmware_image.hpp"

namespace dibhr {

namespace {

inverse3::Tuning inverse3_tuning(const Settings& settings, const TouchState& touch) {
    return tuning_of(settings.inverse3, settings.max_force_newton, touch.centred);
}

}  // namespace

FalconEnd::FalconEnd(const HandDevice& hand, const Settings& settings, TouchState& touch)
    : device_(hand.falcon) {
    if (device_ == nullptr) return;
    FalconNews& news = touch.falcon.emplace();
    news.firmware = hand.firmware;
    news.firmware_trouble = hand.firmware_trouble;
    publish(settings, touch);
}

std::optional<std::string> FalconEnd::poll(TouchState& touch) {
    if (device_ == nullptr) return {};
    FalconNews& news = *touch.falcon;
    news.status = device_->status();
    news.asked = true;
    return stages_.take(news.status.stage, "Falcon", news.was_ready, touch);
}

void FalconEnd::take_presses(const Settings& settings, const TouchState& touch,
                             std::vector<GripPress>& into) {
    if (device_ == nullptr) return;
    const falcon::Status& status = touch.falcon->status;
    presses_.take(status.presses, status.pressed_at, settings.falcon.buttons, into);
}

bool FalconEnd::is_retuned(const Settings& settings, const TouchState& touch) const {
    return device_ != nullptr && !(published_ == tuning_of(settings.falcon, touch.centred));
}

void FalconEnd::publish(const Settings& settings, const TouchState& touch) {
    if (device_ == nullptr) return;
    published_ = tuning_of(settings.falcon, touch.centred);
    device_->tuning().publish(published_);
}

std::string FalconEnd::use_firmware(const std::filesystem::path& file, TouchState& touch) {
    falcon::FirmwareImage image = falcon::keep_firmware(file);
    std::string kept = "Kept for the Falcon: " + image.name;
    if (device_ == nullptr) return kept;
    touch.falcon->firmware = image.name;
    touch.falcon->firmware_trouble.clear();
    device_->use_firmware(std::move(image));
    return kept;
}

Inverse3End::Inverse3End(const HandDevice& hand, const Settings& settings, TouchState& touch)
    : device_(hand.inverse3) {
    if (device_ == nullptr) return;
    touch.inverse3.emplace();
    publish(settings, touch);
}

std::optional<std::string> Inverse3End::poll(TouchState& touch) {
    if (device_ == nullptr) return {};
    Inverse3News& news = *touch.inverse3;
    news.status = device_->status();
    news.asked = true;
    take_ages(news);
    return stages_.take(news.status.stage, "Inverse3", news.was_ready, touch);
}

void Inverse3End::take_ages(Inverse3News& news) {
    news.ages = device_->pose_ages();
    const auto now = std::chrono::steady_clock::now();
    if (now - second_begin_ < std::chrono::seconds(1)) return;
    second_begin_ = now;
    news.recent_ages = news.ages.since(told_ages_);
    told_ages_ = news.ages;
}

void Inverse3End::take_presses(const Settings& settings, const TouchState& touch,
                               std::vector<GripPress>& into) {
    if (device_ == nullptr) return;
    const inverse3::Status& status = touch.inverse3->status;
    presses_.take(status.presses, status.pressed_at, settings.inverse3.buttons, into);
}

bool Inverse3End::is_retuned(const Settings& settings, const TouchState& touch) const {
    return device_ != nullptr && !(published_ == inverse3_tuning(settings, touch));
}

void Inverse3End::publish(const Settings& settings, const TouchState& touch) {
    if (device_ == nullptr) return;
    published_ = inverse3_tuning(settings, touch);
    device_->tuning().publish(published_);
}

}  // namespace dibhr
