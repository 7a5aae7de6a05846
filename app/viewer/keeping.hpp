// Saves the settings a person changed in the window, a little after each change and at the end.
#pragma once

#include <filesystem>

#include "app/settings/settings.hpp"

namespace dibhr {

class SettingsKeeper {
  public:
    /// `in_file`: as read; `started`: as the window started, the command line's values on top. A
    /// value that still is what it started as stays in the file as it was.
    SettingsKeeper(Settings in_file, Settings started, std::filesystem::path file);

    /// Once a picture. Writes when a change is two seconds old. Throws InputError, once for a
    /// change.
    void look(const Settings& now, double now_s);

    /// At the end: writes what is not yet written. Throws InputError.
    void finish(const Settings& now);

  private:
    void save();

    Settings in_file_;
    Settings started_;
    Settings wanted_;  // for the file
    Settings written_;
    std::filesystem::path file_;
    double changed_s_{0.0};
};

}  // namespace dibhr
