// Opens files away from the window's thread, so that neither pictures nor ticks wait for a disk.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// What came of it: media, a session, or a plain sentence.
struct Opened {
    std::unique_ptr<Media> media{};
    std::unique_ptr<OpenedSession> session{};
    std::string failure{};
};

/// Opens what a person dropped or typed. Dropped pairs are told apart by name, else by which one is
/// grey. Throws InputError.
[[nodiscard]] std::unique_ptr<Media> open_request(const OpenRequest& request);

/// Whether a session is asked for, and nothing else.
[[nodiscard]] bool asks_for_session(const OpenRequest& request);

/// One or two dropped files as a request; nothing for none or more than two.
[[nodiscard]] std::optional<OpenRequest> dropped_request(
    const std::vector<std::filesystem::path>& files);

class Opening {
  public:
    /// Begins, unless one is under way: then false.
    bool start(const OpenRequest& request);
    [[nodiscard]] bool under_way() const { return result_.valid(); }
    /// The result, once.
    [[nodiscard]] std::optional<Opened> take();

  private:
    std::future<Opened> result_{};
};

}  // namespace dibhr
