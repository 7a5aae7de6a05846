// When settings are written.
#include "app/viewer/keeping.hpp"

#include <utility>

#include "app/settings/settings_list.hpp"

namespace dibhr {

namespace {

constexpr double kSettleTime_s = 2.0;

}  // namespace

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
