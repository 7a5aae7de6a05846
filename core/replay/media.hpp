// Which files are sessions; where those are that one was recorded over, and whether they are the
// same.
#pragma once

#include <filesystem>
#include <string>

#include "core/session/session.hpp"

namespace dibhr {

/// Whether a file is a session: by its name, or by how it begins.
[[nodiscard]] bool names_session(const std::filesystem::path& file);

/// Where to look for a recorded file: in its place, then beside the session.
class SessionMediaFinder {
  public:
    /// `any_content`: a file that has changed since is taken too.
    SessionMediaFinder(std::filesystem::path session, bool any_content);

    /// The file with the recorded content; `what` ("depth video") names it in messages. Reads it to
    /// its end. Throws InputError when there is none: which, and where to put it.
    [[nodiscard]] std::filesystem::path find(const SessionMedia& media, const std::string& what);

    /// What was taken although it is not known to be the same, one sentence a file.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

  private:
    void warn(const std::string& sentence);

    std::filesystem::path session_;
    bool any_content_;
    std::string warning_{};
};

}  // namespace dibhr
