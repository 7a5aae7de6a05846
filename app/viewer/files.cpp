// Names and pictures in the current folder, and when settings are written.
#include "app/viewer/files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "app/settings/settings_list.hpp"

namespace dibhr {

namespace {

constexpr double kSettleTime_s = 2.0;

}  // namespace

std::string new_file_name(const char* ending) {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm local{};
    localtime_r(&seconds, &local);
    char date[32];
    std::strftime(date, sizeof date, "%Y%m%d-%H%M%S", &local);
    char name[64];
    std::snprintf(name, sizeof name, "dibhr-%s-%03d.%s", date, static_cast<int>(ms.count() % 1000),
                  ending);
    return std::filesystem::absolute(name).string();
}

void Screenshots::save(ColourImage picture) {
    const auto write = [picture = std::move(picture), file = new_file_name("png")] {
        write_png(picture, file);
        return "Saved " + file;
    };
    writing_.push_back(std::async(std::launch::async, write));
}

std::optional<std::string> Screenshots::take() {
    const auto done = std::find_if(writing_.begin(), writing_.end(), [](const auto& picture) {
        return picture.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (done == writing_.end()) return {};
    std::future<std::string> picture = std::move(*done);
    writing_.erase(done);
    return picture.get();
}

void Screenshots::finish() {
    for (auto& picture : std::exchange(writing_, {})) picture.get();
}

SettingsKeeper::SettingsKeeper(Settings in_file, Settings started, std::filesystem::path file)
    : in_file_(std::move(in_file)),
      started_(std::move(started)),
      wanted_(in_file_),
      written_(in_file_),
      file_(std::move(file)) {}

void SettingsKeeper::look(const Settings& now, double now_s) {
    const Settings wanted = changes_kept(in_file_, started_, now);
    if (!same_settings(wanted, wanted_)) {
        wanted_ = wanted;
        changed_s_ = now_s;
    }
    if (now_s - changed_s_ >= kSettleTime_s) save();
}

void SettingsKeeper::finish(const Settings& now) {
    wanted_ = changes_kept(in_file_, started_, now);
    save();
}

void SettingsKeeper::save() {
    if (same_settings(wanted_, written_)) return;
    written_ = wanted_;
    save_settings(wanted_, file_);
}

}  // namespace dibhr
